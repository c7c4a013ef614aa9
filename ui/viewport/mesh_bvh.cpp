#include "ui/viewport/mesh_bvh.h"

#include <algorithm>
#include <array>

namespace atrium::ui {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;

/// Gap between triangles that a ray does not slip through, relative to the mesh's size: a closed shape's seam has its
/// vertices twice, and their single-precision positions differ in the last place.
constexpr double kGap = 1e-6;

/// Entry distance of a ray into a box, or infinity.
double enter_box(const Box3& box, double gap, const dvec3& origin, const dvec3& inverse, double t_max) {
    const dvec3 a = (dvec3(box.min) - gap - origin) * inverse;
    const dvec3 b = (dvec3(box.max) + gap - origin) * inverse;
    double lo = 0;
    double hi = t_max;
    for (int i = 0; i < 3; ++i) {
        // fmin and fmax drop the NaN of 0 * infinity (a ray inside a slab's plane).
        lo = std::fmax(lo, std::fmin(a[i], b[i]));
        hi = std::fmin(hi, std::fmax(a[i], b[i]));
    }
    // Rounding must not lose a triangle on the box's face.
    return lo <= hi * (1.0 + 1e-9) + 1e-12 ? lo : std::numeric_limits<double>::infinity();
}

} // namespace

MeshBvh::MeshBvh(std::shared_ptr<const DisplayMesh> mesh) : mesh_(std::move(mesh)) {
    for (const vec3& p : mesh_->positions) {
        bounds_.add(p);
    }
    gap_ = bounds_.empty() ? 0.0 : kGap * double(bounds_.diagonal());
}

void MeshBvh::build() const {
    std::call_once(once_, [this] {
        const auto count = std::uint32_t(mesh_->indices.size() / 3);
        order_.resize(count);
        std::vector<vec3> centres(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            order_[i] = i;
            const std::uint32_t* t = &mesh_->indices[std::size_t(i) * 3];
            centres[i] = (mesh_->positions[t[0]] + mesh_->positions[t[1]] + mesh_->positions[t[2]]) / 3.0F;
        }
        nodes_.reserve(count);
        nodes_.emplace_back();
        split(0, 0, count, centres);
    });
}

void MeshBvh::split(std::uint32_t node, std::uint32_t begin, std::uint32_t end, std::vector<vec3>& centres) const {
    Box3 box;
    Box3 spread;
    for (std::uint32_t i = begin; i < end; ++i) {
        const std::uint32_t* t = &mesh_->indices[std::size_t(order_[i]) * 3];
        for (int corner = 0; corner < 3; ++corner) {
            box.add(mesh_->positions[t[corner]]);
        }
        spread.add(centres[order_[i]]);
    }
    nodes_[node].box = box;
    if (end - begin <= kLeafTriangles) {
        nodes_[node].first = begin;
        nodes_[node].count = end - begin;
        return;
    }
    const vec3 size = spread.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return centres[a][axis] < centres[b][axis]; });
    const auto child = std::uint32_t(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = child;
    split(child, begin, middle, centres);
    split(child + 1, middle, end, centres);
}

std::optional<MeshHit> MeshBvh::nearest(const dvec3& origin, const dvec3& direction, double t_max, RaySides sides) const {
    if (mesh_->indices.empty()) {
        return std::nullopt;
    }
    const dvec3 inverse = 1.0 / direction;
    if (!(enter_box(bounds_, gap_, origin, inverse, t_max) < t_max)) {
        return std::nullopt;
    }
    build();
    std::optional<MeshHit> best;
    std::array<std::uint32_t, 64> stack{};
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const NodeBox& node = nodes_[stack[--depth]];
        if (!(enter_box(node.box, gap_, origin, inverse, t_max) < t_max)) {
            continue;
        }
        if (node.count == 0) {
            const double a = enter_box(nodes_[node.first].box, gap_, origin, inverse, t_max);
            const double b = enter_box(nodes_[node.first + 1].box, gap_, origin, inverse, t_max);
            // The nearer child is looked at first: it is pushed last.
            stack[depth++] = node.first + (a <= b ? 1U : 0U);
            stack[depth++] = node.first + (a <= b ? 0U : 1U);
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const std::uint32_t* t = &mesh_->indices[std::size_t(order_[i]) * 3];
            const dvec3 p(mesh_->positions[t[0]]);
            const dvec3 e1 = dvec3(mesh_->positions[t[1]]) - p;
            const dvec3 e2 = dvec3(mesh_->positions[t[2]]) - p;
            const dvec3 q = glm::cross(direction, e2);
            const double det = glm::dot(e1, q);
            const bool front = det > 0;
            if (det == 0 || (!front && sides == RaySides::Front)) {
                continue;
            }
            const dvec3 s = origin - p;
            const double u = glm::dot(s, q) / det;
            const dvec3 r = glm::cross(s, e1);
            const double v = glm::dot(direction, r) / det;
            const double hit = glm::dot(e2, r) / det;
            if (!(hit >= 0 && hit < t_max)) {
                continue;
            }
            // An edge reaches outwards by the gap: that share of the height above it, but no more than a little of slivers.
            const double twice_area = glm::length(glm::cross(e1, e2));
            const auto slack = [&](const dvec3& edge) { return std::min(gap_ * glm::length(edge) / twice_area, 0.01); };
            if (u >= -slack(e2) && v >= -slack(e1) && u + v <= 1 + slack(e2 - e1)) {
                t_max = hit;
                best = MeshHit{hit, order_[i], front};
            }
        }
    }
    return best;
}

} // namespace atrium::ui
