#include "engine/raycast/slabs.h"

#include "engine/base/rng.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::uint32_t kProbes = 48;
constexpr float kThickest = 0.06F;         // metres
constexpr float kThickestShare = 0.25F;    // of the root of the area: beyond it is a block
constexpr float kCosParallel = 0.9993908F; // 2 degrees
constexpr std::uint32_t kFacing = (kProbes * 4 + 4) / 5;
constexpr std::size_t kMostDirections = kProbes / 8; // of panes in one surface; a curved shell has as many as probes

struct Probe {
    vec3 point{0.0F};
    vec3 normal{0.0F};
};

vec3 area_vector(const RaySurface& s, const uvec3& t) {
    const auto& p = *s.positions;
    return 0.5F * glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
}

/// Distance at which a ray straight in from the probe meets the inside of a parallel face first; infinite where what it
/// meets first is not one.
float behind(const RaySurface& s, const Probe& probe, float farthest, StopCheck& stop) {
    const vec3 direction = -probe.normal;
    float nearest = std::numeric_limits<float>::infinity();
    bool parallel = false;
    const vec3 size = glm::abs(probe.point);
    const float clear =
        std::max(1e-4F, 1e-6F * max_component(size)); // the probe's own face, and its neighbours in its plane
    for (const uvec3& t : s.triangles) {
        if (stop()) {
            break;
        }
        const auto& p = *s.positions;
        const vec3 a = p[t.x];
        const vec3 e1 = p[t.y] - a;
        const vec3 e2 = p[t.z] - a;
        const vec3 across = glm::cross(direction, e2);
        const float det = glm::dot(e1, across);
        const vec3 from = probe.point - a;
        const float u = glm::dot(from, across);
        const vec3 up = glm::cross(from, e1);
        const float v = glm::dot(direction, up);
        const float sign = det < 0.0F ? -1.0F : 1.0F;
        if (det == 0.0F || u * sign < 0.0F || v * sign < 0.0F || (u + v) * sign > det * sign) {
            continue;
        }
        const float distance = glm::dot(e2, up) / det;
        if (distance > clear && distance < nearest && distance <= farthest) {
            nearest = distance;
            parallel = glm::dot(glm::normalize(glm::cross(e1, e2)), direction) > kCosParallel;
        }
    }
    return parallel ? nearest : std::numeric_limits<float>::infinity();
}

} // namespace

float slab_thickness(const RaySurface& surface, const RunContext& context) {
    StopCheck stop(context, kMeshStride);
    double area = 0.0;
    for (const uvec3& t : surface.triangles) {
        area += double(glm::length(area_vector(surface, t)));
    }
    const float farthest = std::min(kThickest, kThickestShare * float(std::sqrt(area)));
    std::uint32_t missed = 0;
    double sum = 0.0;
    std::vector<vec3> directions;
    double passed = 0.0;
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < kProbes; ++i) { // at even steps of the area, in the order of the triangles
        const double wanted = (double(i) + 0.5) / double(kProbes) * area;
        while (next + 1 < surface.triangles.size()) {
            const double own = double(glm::length(area_vector(surface, surface.triangles[next])));
            if (passed + own >= wanted) {
                break;
            }
            passed += own;
            ++next;
        }
        const uvec3& t = surface.triangles[next];
        const auto& p = *surface.positions;
        const vec2 u = sobol_owen2(i, 0, 0x51ABU);
        const float root = std::sqrt(u.x);
        const Probe probe{p[t.x] * (1.0F - root) + p[t.y] * (root * (1.0F - u.y)) + p[t.z] * (root * u.y),
                          glm::normalize(area_vector(surface, t))};
        const float distance = behind(surface, probe, farthest, stop);
        if (stop()) {
            return 0.0F;
        }
        if (!std::isfinite(distance)) {
            if (++missed > kProbes - kFacing) {
                return 0.0F;
            }
            continue;
        }
        sum += double(distance);
        if (std::none_of(directions.begin(), directions.end(),
                         [&](const vec3& d) { return std::abs(glm::dot(d, probe.normal)) > kCosParallel; })) {
            if (directions.size() == kMostDirections) {
                return 0.0F;
            }
            directions.push_back(probe.normal);
        }
    }
    return float(sum / double(kProbes - missed));
}

} // namespace atrium
