#include "engine/reference/lit_places.h"

#include "engine/base/rng.h"
#include "engine/raycast/ray_scene.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr float kNear = 1e-3F; // metres: what lies closer covers a place

struct Side {
    std::uint32_t surface = 0;
    std::uint32_t triangle = 0;
    bool back = false;
};

constexpr std::uint32_t kTries = 48;
constexpr std::uint32_t kGiveUp = 256; // places tried without any light
constexpr float kGap = 0.01F;          // metres

/// Of what a place sees, the share that is farther than `gap`; negative where all is within a millimetre.
float openness(const RayScene& rays, const vec3& position, const vec3& normal, float gap) {
    vec3 t;
    vec3 b;
    make_frame(normal, t, b);
    bool covered = true;
    unsigned far = 0;
    for (std::uint32_t i = 0; i < kTries; ++i) {
        const vec2 u = sobol_owen2(i, 0, 77U);
        const float r = std::sqrt(u.x);
        const float angle = 2.0F * kPi * u.y;
        const vec3 d = glm::normalize(r * std::cos(angle) * t + r * std::sin(angle) * b + std::sqrt(1.0F - u.x) * normal);
        const Hit hit = rays.nearest({clear_of(position, normal), d});
        covered = covered && hit && hit.t < kNear;
        far += hit && hit.t < gap ? 0U : 1U;
    }
    return covered ? -1.0F : float(far) / float(kTries);
}

/// False where light does not get in: of 48 paths of up to 48 bounces none finds any.
bool light_can_reach(const PathTracer& tracer, const vec3& position, const vec3& normal) {
    for (std::uint32_t i = 0; i < kTries; ++i) {
        PathSampler sampler(99, i);
        if (tracer.finds_light({clear_of(position, normal), normal}, sampler, kTries)) {
            return true;
        }
    }
    return false;
}

/// No other surface lies in the very plane of this one. Of two that do a ray may meet either, by the rounding of its
/// numbers: so some at different slants, from both sides.
bool alone_in_its_plane(const RayScene& rays, NodeId node, const vec3& p, const vec3& n) {
    constexpr int kRays = 16;
    vec3 t;
    vec3 b;
    make_frame(n, t, b);
    for (int i = 0; i < kRays; ++i) {
        const float angle = 2.4F * float(i); // the golden angle
        const float slant = 0.1F * float(i);
        const vec3 d = glm::normalize(n + slant * (std::cos(angle) * t + std::sin(angle) * b));
        const float way = kNear / glm::dot(d, n);
        for (const vec3& from : {d, -d}) {
            const Hit hit = rays.nearest({p + from * way, -from, 2.0F * way});
            const bool in_plane = hit && std::abs(hit.t - way) < 0.1F * way;
            const bool own = in_plane && rays.surfaces()[hit.surface].node == node;
            // From before it is seen, or something lies on it; from behind the back of a solid may be in the way.
            if (in_plane ? !own : glm::dot(from, n) > 0.0F) {
                return false;
            }
        }
    }
    return true;
}

} // namespace

std::vector<LitPlace> lit_places(const RayScene& rays, const PathTracer& tracer, std::size_t count, std::uint32_t seed,
                                 const RunContext& context) {
    StopCheck stop(context, kMeshStride);
    std::vector<Side> sides;
    std::vector<double> cumulative;
    double total = 0.0;
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        if (classify(rays.material(s)) != MaterialKind::Diffuse) {
            continue;
        }
        for (std::uint32_t t = 0; t < rays.surfaces()[s].triangles.size() && !stop(); ++t) {
            const auto p = rays.triangle(s, t);
            const double area = 0.5 * double(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
            for (int side = 0; side < (rays.surfaces()[s].back_side ? 2 : 1); ++side) {
                total += area;
                sides.push_back({s, t, side == 1});
                cumulative.push_back(total);
            }
        }
    }
    std::vector<LitPlace> out;
    for (std::uint32_t i = 0; out.size() < count && i < 20 * count && total > 0.0 && !context.should_stop(); ++i) {
        if (i == kGiveUp && out.empty()) {
            break; // a scene without light
        }
        const double at = double(sobol_owen(i, 2, seed)) * total;
        const auto found = std::upper_bound(cumulative.begin(), cumulative.end(), at) - cumulative.begin();
        const Side& side = sides[std::min(std::size_t(found), sides.size() - 1)];
        const vec2 u = sobol_owen2(i, 0, seed);
        const float root = std::sqrt(u.x);
        Hit hit;
        hit.surface = side.surface;
        hit.triangle = side.triangle;
        hit.barycentric = {root * (1.0F - u.y), root * u.y};
        const auto p = rays.triangle(side.surface, side.triangle);
        const vec3 face = glm::cross(p[1] - p[0], p[2] - p[0]);
        if (!(glm::length(face) > 0.0F)) {
            continue;
        }
        hit.geometric_normal = glm::normalize(face);
        const vec3 position = p[0] + (p[1] - p[0]) * hit.barycentric.x + (p[2] - p[0]) * hit.barycentric.y;
        const Material& m = rays.material(side.surface);
        if (m.alpha_mode == Material::Alpha::Mask &&
            rays.base_color(hit.surface, hit.triangle, hit.barycentric).a < m.alpha_cutoff) {
            continue;
        }
        vec3 normal = rays.shading_normal(hit);
        normal = glm::dot(normal, hit.geometric_normal) >= 0.75F ? normal : hit.geometric_normal;
        const float sign = side.back ? -1.0F : 1.0F;
        const NodeId node = rays.surfaces()[side.surface].node;
        const vec3 face_up = hit.geometric_normal * sign;
        const float open = openness(rays, position, face_up, kGap * rays.bounds().diagonal());
        if (open >= 0.0F && alone_in_its_plane(rays, node, position, face_up) &&
            light_can_reach(tracer, position, face_up)) {
            out.push_back({dvec3(position) + rays.origin(), dvec3(normal * sign), node, open});
        }
    }
    return out;
}

} // namespace atrium
