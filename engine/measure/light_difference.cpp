#include "engine/measure/light_difference.h"

#include "engine/measure/compare.h"
#include "engine/raycast/ray_scene.h"
#include "engine/reference/lit_places.h"

#include <cmath>

namespace atrium {
namespace {

/// Steps of the additive sequence R2 (Roberts 2018): powers of the inverse of the plastic number.
constexpr double kStepU = 0.7548776662466927;
constexpr double kStepV = 0.5698402909980532;

struct Face {
    dvec3 corner[3];
    dvec3 normal; ///< unit, of the side that is meant
    double summed_area;
};

std::vector<Face> faces_of(const Scene& scene, const Solution& solution) {
    std::vector<Face> out;
    double area = 0;
    for (const auto& layer : solution.surfaces) {
        const Node* node = scene.nodes.find(layer->node);
        if (node == nullptr) {
            continue;
        }
        const Material* material = scene.material_of(*node, layer->part);
        if (classify(material != nullptr ? *material : default_material()) != MaterialKind::Diffuse) {
            continue;
        }
        const dmat4 to_world = scene.world_matrix(layer->node);
        const bool mirrored = glm::determinant(dmat3(to_world)) < 0.0;
        const DisplayMesh& mesh = *layer->mesh;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            Face face;
            for (std::size_t k = 0; k < 3; ++k) {
                face.corner[k] = dvec3(to_world * dvec4(dvec3(mesh.positions[mesh.indices[i + k]]), 1.0));
            }
            const dvec3 cross = glm::cross(face.corner[1] - face.corner[0], face.corner[2] - face.corner[0]);
            const double twice = glm::length(cross);
            if (!(twice > 0.0)) {
                continue;
            }
            for (const bool back : {false, true}) {
                if (back && !layer->has_back()) {
                    continue;
                }
                area += twice / 2.0;
                face.normal = cross * ((mirrored != back ? -1.0 : 1.0) / twice);
                face.summed_area = area;
                out.push_back(face);
            }
        }
    }
    return out;
}

} // namespace

std::vector<SensorPlace> spread_places(const Scene& scene, const Solution& solution, std::size_t count) {
    const std::vector<Face> faces = faces_of(scene, solution);
    std::vector<SensorPlace> out;
    for (std::size_t i = 0, at = 0; i < count && !faces.empty(); ++i) {
        const double wanted = faces.back().summed_area * (double(i) + 0.5) / double(count);
        while (at + 1 < faces.size() && faces[at].summed_area < wanted) {
            ++at;
        }
        const double n = double(i) + 1.0;
        double u = n * kStepU - std::floor(n * kStepU);
        double v = n * kStepV - std::floor(n * kStepV);
        if (u + v > 1.0) { // fold the square onto the triangle
            u = 1.0 - u;
            v = 1.0 - v;
        }
        const Face& face = faces[at];
        out.push_back({face.corner[0] * (1.0 - u - v) + face.corner[1] * u + face.corner[2] * v, face.normal});
    }
    return out;
}

std::vector<SensorPlace> seen_places(const Scene& scene, std::size_t count, std::uint32_t seed, const RunContext& context) {
    const RayScene rays(scene, context);
    if (context.should_stop()) {
        return {};
    }
    const PathTracer tracer(scene, rays);
    std::vector<SensorPlace> out;
    for (const LitPlace& place : lit_places(rays, tracer, count, seed, context)) {
        if (place.seen()) {
            out.push_back({place.position, place.normal});
        }
    }
    return out;
}

LightDifference light_difference(const Scene& scene, const Solution& solution, const Solution& reference,
                                 std::size_t count) {
    return light_difference(scene, solution, reference, spread_places(scene, reference, count));
}

LightDifference light_difference(const Scene& scene, const Solution& solution, const Solution& reference,
                                 std::span<const SensorPlace> places) {
    const std::vector<SensorReading> ours = read_surfaces(scene, solution, places);
    const std::vector<SensorReading> theirs = read_surfaces(scene, reference, places);
    std::vector<double> a;
    std::vector<double> b;
    LightDifference out;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (ours[i].on_surface && theirs[i].on_surface) {
            ++out.points;
            for (int k = 0; k < 3; ++k) {
                a.push_back(double(ours[i].irradiance[k]));
                b.push_back(double(theirs[i].irradiance[k]));
            }
        }
    }
    const Difference d = difference(a, b);
    out.rel_rms = d.rel_rmse;
    out.rel_max = d.max;
    out.energy_rel = std::abs(d.mean_relative_bias);
    return out;
}

} // namespace atrium
