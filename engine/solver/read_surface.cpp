#include "engine/solver/gi_engine.h"

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

} // namespace

SensorReading read_surface(const Scene& scene, const Solution& solution, const dvec3& point, const dvec3& normal) {
    SensorReading out;
    double best = kReach;
    for (const auto& layer : solution.surfaces) {
        const DBox3 box = scene.world_bounds(layer->node);
        const Node* node = scene.nodes.find(layer->node);
        if (node == nullptr || box.empty() || glm::length(point - glm::clamp(point, box.min, box.max)) > kReach) {
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
            const double cosine = glm::dot(face, normal);
            const bool back = cosine < 0.0;
            if (std::abs(cosine) < 0.7 || (back && layer->irradiance_back.empty())) {
                continue;
            }
            const dvec2 w = closest_on_triangle(point, a, b, c);
            const dvec3 nearest = a * (1.0 - w.x - w.y) + b * w.x + c * w.y;
            const double distance = glm::length(nearest - point);
            if (distance < best) {
                best = distance;
                out.irradiance = irradiance_at(*layer, {v[0], v[1], v[2]}, vec3(dvec3(1.0 - w.x - w.y, w.x, w.y)), back);
                out.on_surface = true;
            }
        }
    }
    if (out.on_surface) {
        out.standard_error = double(luminance(out.irradiance)) * solution.statistics.error_estimate;
    }
    return out;
}

} // namespace atrium
