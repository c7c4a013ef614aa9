#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/raycast/ray_scene.h"
#include "engine/view/still.h"

#include <algorithm>
#include <charconv>

namespace atrium {

Result<ViewCamera> find_camera(const Scene& scene, const std::string& name_or_index) {
    std::vector<NodeId> cameras;
    for (const NodeId id : scene.in_tree_order()) {
        if (scene.cameras.contains(scene.nodes.find(id)->camera)) {
            cameras.push_back(id);
        }
    }
    const auto placed = [&](NodeId id) {
        return ViewCamera{scene.world_matrix(id), *scene.cameras.find(scene.nodes.find(id)->camera)};
    };
    if (name_or_index.empty()) {
        return cameras.empty() ? default_camera(scene) : placed(cameras.front());
    }
    for (const NodeId id : cameras) {
        const Node& node = *scene.nodes.find(id);
        if (node.name == name_or_index || scene.cameras.find(node.camera)->name == name_or_index) {
            return placed(id);
        }
    }
    std::size_t index = 0;
    const char* end = name_or_index.data() + name_or_index.size();
    if (const auto [at, error] = std::from_chars(name_or_index.data(), end, index);
        error == std::errc() && at == end && index < cameras.size()) {
        return placed(cameras[index]);
    }
    std::string known;
    for (const NodeId id : cameras) {
        known += (known.empty() ? "" : ", ") + scene.nodes.find(id)->name;
    }
    return fail("", "camera \"" + name_or_index + "\"", "there is no such camera",
                known.empty() ? "The file has no camera; leave the option out for a view from inside"
                              : "Cameras of the file: " + known + "; or their index from 0");
}

ViewCamera default_camera(const Scene& scene) {
    ViewCamera out;
    out.lens.yfov = 1.05F; // 60 degrees: an interior photographer's wide lens
    const RayScene rays(scene);
    const Box3 box = rays.bounds();
    if (box.empty()) {
        out.to_world[3] = dvec4(0.0, 1.6, 4.0, 1.0);
        return out;
    }
    // Candidate places on a grid at eye height; the best sees surfaces all round, far away but not beyond the walls.
    constexpr int kGrid = 12;
    constexpr unsigned kDirections = 64;
    const vec3 size = box.size();
    const float eye_height = std::min(1.6F, 0.6F * size.y);
    const auto direction = [](unsigned i) {
        const vec2 u = sobol_owen2(i, 0, 5U);
        const float y = (2.0F * u.x - 1.0F) * 0.7F; // mostly sideways
        const float r = std::sqrt(1.0F - y * y);
        return vec3(r * std::cos(2.0F * kPi * u.y), y, r * std::sin(2.0F * kPi * u.y));
    };
    struct Place {
        vec3 eye{0.0F};
        float score = -1.0F;
        vec3 look{0.0F, 0.0F, -1.0F};
    };
    std::vector<Place> places(std::size_t(kGrid) * kGrid);
    parallel_chunks(places.size(), 4, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t p = begin; p < end; ++p) {
            Place& place = places[p];
            place.eye = vec3(box.min.x + size.x * (float(p % kGrid) + 0.5F) / kGrid, box.min.y + 0.02F * size.y,
                             box.min.z + size.z * (float(p / kGrid) + 0.5F) / kGrid);
            // Stand on the floor below the middle of the height, not on the ground under the house.
            const vec3 middle(place.eye.x, box.min.y + std::min(0.5F * size.y, 1.2F), place.eye.z);
            const Hit floor = rays.nearest({middle, {0.0F, -1.0F, 0.0F}});
            place.eye.y = (floor ? middle.y - floor.t : box.min.y) + eye_height;
            float hits = 0.0F;
            float logs = 0.0F;
            float nearest = std::numeric_limits<float>::infinity();
            float best_view = -1.0F;
            for (unsigned i = 0; i < kDirections; ++i) {
                const vec3 d = direction(i);
                const Hit hit = rays.nearest({place.eye, d});
                const float reach = hit ? hit.t : 0.0F;
                hits += hit ? 1.0F : 0.0F;
                logs += std::log(std::max(reach, 0.05F));
                nearest = std::min(nearest, hit ? hit.t : nearest);
                if (std::abs(d.y) < 0.3F && reach > best_view) {
                    best_view = reach;
                    place.look = d;
                }
            }
            const float roof = rays.nearest({place.eye, {0.0F, 1.0F, 0.0F}}) ? 1.0F : 0.5F;
            place.score = roof * std::pow(hits / kDirections, 3.0F) * std::exp(logs / kDirections) *
                          std::clamp(nearest / 0.4F, 0.05F, 1.0F) * std::sqrt(std::max(best_view, 0.0F));
        }
    });
    const Place& best =
        *std::max_element(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.score < b.score; });
    const dvec3 back = -glm::normalize(dvec3(best.look.x, -0.08, best.look.z));
    const dvec3 right = glm::normalize(glm::cross(dvec3(0.0, 1.0, 0.0), back));
    out.to_world[0] = dvec4(right, 0.0);
    out.to_world[1] = dvec4(glm::cross(back, right), 0.0);
    out.to_world[2] = dvec4(back, 0.0);
    out.to_world[3] = dvec4(dvec3(best.eye) + rays.origin(), 1.0);
    return out;
}

} // namespace atrium
