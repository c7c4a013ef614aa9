#include "engine/solver/gi_engine.h"

#include <algorithm>
#include <numeric>

namespace atrium {
namespace {

constexpr double kReach = 0.01; // metres: CONTRACTS, --on-surface

// Closest point of a triangle to p as barycentric weights of corners 1 and 2 (Ericson, Real-Time Collision Detection 5.1.5).
dvec2 closest_on_triangle(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c) {
    const dvec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) {
        return {0.0, 0.0};
    }
    const dvec3 bp = p - b;
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) {
        return {1.0, 0.0};
    }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        return {d1 / (d1 - d3), 0.0};
    }
    const dvec3 cp = p - c;
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) {
        return {0.0, 1.0};
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        return {0.0, d2 / (d2 - d6)};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {1.0 - w, w};
    }
    const double sum = va + vb + vc;
    return sum > 0.0 ? dvec2(vb / sum, vc / sum) : dvec2(0.0);
}

/// Points in a balanced tree of boxes: finds those in a box in logarithmic time.
class PointTree {
public:
    explicit PointTree(std::span<const SensorPlace> places) : places_(places), order_(places.size()) {
        std::iota(order_.begin(), order_.end(), 0U);
        if (!order_.empty()) {
            build(0, order_.size());
        }
    }
    /// Calls visit(index) for every point in the box.
    template <class F> void find(const DBox3& box, F&& visit) const {
        if (!nodes_.empty()) {
            find(0, box, visit);
        }
    }

private:
    struct Branch {
        DBox3 box;
        std::size_t begin = 0;
        std::size_t end = 0;
        std::size_t second = 0; ///< index of the second child, the first follows its parent; 0 = leaf
    };
    void build(std::size_t begin, std::size_t end) {
        const std::size_t index = nodes_.size();
        nodes_.push_back({{}, begin, end, 0});
        for (std::size_t i = begin; i < end; ++i) {
            nodes_[index].box.add(places_[order_[i]].point);
        }
        if (end - begin <= 8) {
            return;
        }
        const dvec3 size = nodes_[index].box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const std::size_t middle = (begin + end) / 2;
        const auto at = [&](std::size_t i) { return order_.begin() + std::ptrdiff_t(i); };
        std::nth_element(at(begin), at(middle), at(end),
                         [&](std::uint32_t a, std::uint32_t b) { return places_[a].point[axis] < places_[b].point[axis]; });
        build(begin, middle);
        nodes_[index].second = nodes_.size();
        build(middle, end);
    }
    template <class F> void find(std::size_t index, const DBox3& box, F& visit) const {
        const Branch& branch = nodes_[index];
        for (int k = 0; k < 3; ++k) {
            if (branch.box.min[k] > box.max[k] || branch.box.max[k] < box.min[k]) {
                return;
            }
        }
        if (branch.second != 0) {
            find(index + 1, box, visit);
            find(branch.second, box, visit);
            return;
        }
        for (std::size_t i = branch.begin; i < branch.end; ++i) {
            const dvec3& p = places_[order_[i]].point;
            if (p == glm::clamp(p, box.min, box.max)) {
                visit(order_[i]);
            }
        }
    }

    std::span<const SensorPlace> places_;
    std::vector<std::uint32_t> order_;
    std::vector<Branch> nodes_;
};

} // namespace

std::vector<SensorReading> read_surfaces(const Scene& scene, const Solution& solution, std::span<const SensorPlace> places) {
    std::vector<SensorReading> out(places.size());
    std::vector<double> best(places.size(), kReach);
    const PointTree tree(places);
    const auto grown = [](DBox3 box) {
        box.min -= dvec3(kReach);
        box.max += dvec3(kReach);
        return box;
    };
    for (const auto& layer : solution.surfaces) {
        const DBox3 bounds = scene.world_bounds(layer->node);
        const Node* node = scene.nodes.find(layer->node);
        if (node == nullptr || bounds.empty()) {
            continue;
        }
        bool any = false;
        tree.find(grown(bounds), [&](std::uint32_t) { any = true; });
        if (!any) {
            continue;
        }
        const Material* material = scene.material_of(*node, layer->part);
        const MaterialKind kind = classify(material != nullptr ? *material : default_material());
        if (kind != MaterialKind::Diffuse) {
            continue; // illuminance meters lie on what scatters light
        }
        const dmat4 world = scene.world_matrix(layer->node);
        const bool mirrored = glm::determinant(dmat3(world)) < 0.0;
        const DisplayMesh& mesh = *layer->mesh;
        std::vector<dvec3> position(mesh.positions.size());
        for (std::size_t i = 0; i < position.size(); ++i) {
            position[i] = dvec3(world * dvec4(dvec3(mesh.positions[i]), 1.0));
        }
        for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
            const std::uint32_t* v = &mesh.indices[t];
            const dvec3 &a = position[v[0]], &b = position[v[1]], &c = position[v[2]];
            dvec3 face = glm::cross(b - a, c - a);
            const double length = glm::length(face);
            if (!(length > 0.0)) {
                continue;
            }
            face *= (mirrored ? -1.0 : 1.0) / length;
            DBox3 box;
            box.add(a);
            box.add(b);
            box.add(c);
            tree.find(grown(box), [&](std::uint32_t i) {
                const double cosine = glm::dot(face, places[i].normal);
                const bool back = cosine < 0.0;
                if (std::abs(cosine) < 0.7 || (back && !layer->has_back())) {
                    return;
                }
                const dvec2 w = closest_on_triangle(places[i].point, a, b, c);
                const dvec3 nearest = a * (1.0 - w.x - w.y) + b * w.x + c * w.y;
                const double distance = glm::length(nearest - places[i].point);
                if (distance < best[i]) {
                    best[i] = distance;
                    out[i].irradiance =
                        irradiance_at(*layer, {v[0], v[1], v[2]}, vec3(dvec3(1.0 - w.x - w.y, w.x, w.y)), back);
                    out[i].on_surface = true;
                }
            });
        }
    }
    for (SensorReading& reading : out) {
        if (reading.on_surface) {
            reading.standard_error = double(luminance(reading.irradiance)) * solution.statistics.error_estimate;
        }
    }
    return out;
}

SensorReading read_surface(const Scene& scene, const Solution& solution, const dvec3& point, const dvec3& normal) {
    const SensorPlace place{point, normal};
    return read_surfaces(scene, solution, {&place, 1}).front();
}

} // namespace atrium
