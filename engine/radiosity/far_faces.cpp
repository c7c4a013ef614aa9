#include "engine/radiosity/far_faces.h"

#include "engine/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace atrium {
namespace {

constexpr std::uint32_t kFewest = 64;           // faces that are worth a table
constexpr std::uint32_t kMostFaces = 64 * 1024; // in all tables: some tenths of a second of one core
constexpr float kFar = 16.0F;                   // radii from which on groups have one look for each direction
// Directions on the octahedron, unfolded to a square: nodes on its border too, where they lie twice.
constexpr std::size_t kCells = 32, kRow = kCells + 1, kNodes = kRow * kRow;

vec3 direction_of(std::size_t node) {
    const vec2 at = vec2(float(node % kRow), float(node / kRow)) * (2.0F / float(kCells)) - 1.0F;
    vec3 d(at, 1.0F - std::abs(at.x) - std::abs(at.y));
    if (d.z < 0.0F) {
        const vec2 folded = vec2(1.0F) - glm::abs(vec2(d.y, d.x));
        d.x = std::copysign(folded.x, at.x);
        d.y = std::copysign(folded.y, at.y);
    }
    return glm::normalize(d);
}

vec2 square_of(const vec3& direction) {
    const float sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    vec2 at = vec2(direction) / sum;
    if (direction.z < 0.0F) {
        const vec2 folded = vec2(1.0F) - glm::abs(vec2(at.y, at.x));
        at = {std::copysign(folded.x, direction.x), std::copysign(folded.y, direction.y)};
    }
    return at;
}

} // namespace

FarFaces::FarFaces(const Hierarchy& h, const RayScene& rays) {
    for (std::uint32_t i = 0; i < h.elements.size(); ++i) {
        const Element& e = h.elements[i];
        if (e.kind == Element::Kind::Faces && e.power > 0.0F && e.face_count >= kFewest) {
            groups_.push_back(i);
        }
    }
    std::stable_sort(groups_.begin(), groups_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return h.elements[a].power > h.elements[b].power; });
    std::size_t faces = 0, kept = 0;
    for (; kept < groups_.size() && faces + h.elements[groups_[kept]].face_count <= kMostFaces; ++kept) {
        faces += h.elements[groups_[kept]].face_count;
    }
    groups_.resize(kept);
    std::sort(groups_.begin(), groups_.end());
    views_.resize(groups_.size() * kNodes);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const Element& e = h.elements[groups_[g]];
        std::vector<vec4> middles; // from the group's centre; area
        for (std::uint32_t f = e.triangle; f < e.triangle + e.face_count; ++f) {
            const auto corner = rays.triangle(h.faces[f].surface, h.faces[f].triangle);
            middles.emplace_back((corner[0] + corner[1] + corner[2]) * (1.0F / 3.0F) - e.centre, h.faces[f].area);
        }
        parallel_chunks(kNodes, 32, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t n = begin; n < end; ++n) {
                const vec3 d = direction_of(n);
                const float least = kFar * e.radius;
                View view;
                for (std::uint32_t f = 0; f < e.face_count; ++f) {
                    const vec3& normal = h.faces[e.triangle + f].normal;
                    const vec3 place(middles[f]), to_eye = least * d - place;
                    const float far = middles[f].w * std::max(glm::dot(normal, d), 0.0F);
                    const float r = glm::length(to_eye);
                    const float near = middles[f].w * std::max(glm::dot(normal, to_eye), 0.0F) * least * least / (r * r * r);
                    view.infinity += vec4(place * far, far);
                    view.least += vec4(place * near, near);
                }
                views_[g * kNodes + n] = view;
            }
        });
    }
}

float FarFaces::factor(const Hierarchy& h, std::uint32_t element, const SurfacePoint& from) const {
    const auto found = std::lower_bound(groups_.begin(), groups_.end(), element);
    if (found == groups_.end() || *found != element) {
        return -1.0F;
    }
    const Element& e = h.elements[element];
    const vec3 out = from.position - e.centre;
    const float r2 = glm::dot(out, out);
    if (r2 < kFar * kFar * e.radius * e.radius || glm::dot(out, from.normal) > -e.radius) {
        return -1.0F;
    }
    const vec2 at = glm::clamp((square_of(out) + 1.0F) * (0.5F * float(kCells)), 0.0F, float(kCells) - 1e-3F);
    const vec2 cell = glm::floor(at), f = at - cell;
    const View* view =
        &views_[std::size_t(found - groups_.begin()) * kNodes + std::size_t(cell.y) * kRow + std::size_t(cell.x)];
    const float nearness = kFar * e.radius / std::sqrt(r2);
    const auto at_node = [&](std::size_t i) { return glm::mix(view[i].infinity, view[i].least, nearness); };
    const vec4 seen = glm::mix(glm::mix(at_node(0), at_node(1), f.x), glm::mix(at_node(kRow), at_node(kRow + 1), f.x), f.y);
    if (!(seen.w > 0.0F)) {
        return 0.0F;
    }
    const vec3 d = vec3(seen) / seen.w - out; // from the point to the middle of what is seen
    return std::max(glm::dot(d, from.normal), 0.0F) / glm::length(d) * seen.w / (kPi * r2);
}

} // namespace atrium
