#include "engine/radiosity/light_shafts.h"

#include <algorithm>
#include <queue>

namespace atrium {
namespace {

// What fills less of the hemisphere than a cone of this half angle (tangent), or hides less than this share of one source,
// is left for the full solution.
constexpr float kSmallestCone = 0.1F;
constexpr float kSmallestShare = 0.05F;

// The part of a ray up to `end` crosses a box that is `swell` larger all round.
bool crosses(const vec3& origin, const vec3& direction, float end, const Box3& box, float swell) {
    float t0 = 0.0F, t1 = end;
    for (int k = 0; k < 3; ++k) {
        const float lo = box.min[k] - swell - origin[k], hi = box.max[k] + swell - origin[k];
        if (std::abs(direction[k]) < 1e-12F) {
            if (lo > 0.0F || hi < 0.0F) {
                return false;
            }
            continue;
        }
        const float a = lo / direction[k], b = hi / direction[k];
        t0 = std::max(t0, std::min(a, b));
        t1 = std::min(t1, std::max(a, b));
    }
    return t0 <= t1;
}

// Distance of the farthest corner.
float farthest(const vec3& point, const Box3& box) {
    return glm::length(glm::max(glm::abs(box.min - point), glm::abs(box.max - point)));
}

constexpr float kRounding = 1e-3F; // metres: rays start a little off their surface

Box3 mirrored(const Box3& box, const PlanarMirror& mirror) {
    Box3 out;
    for (int k = 0; k < 8; ++k) {
        const vec3 corner((k & 1) != 0 ? box.max.x : box.min.x, (k & 2) != 0 ? box.max.y : box.min.y,
                          (k & 4) != 0 ? box.max.z : box.min.z);
        out.add(mirror.reflect_point(corner));
    }
    return out;
}

} // namespace

bool shaft_to_sun_touches(const vec3& point, float from, const vec3& direction, float spread, const Box3& box) {
    return crosses(point, direction, std::numeric_limits<float>::infinity(), box,
                   kRounding + from + spread * farthest(point, box));
}

bool shaft_to_ball_touches(const vec3& point, float from, const vec3& centre, float radius, const Box3& box) {
    const vec3 d = centre - point;
    const float distance = glm::length(d);
    if (!(distance > radius + from)) {
        return true; // inside or beside it: all round
    }
    const float far = farthest(point, box);
    return crosses(point, d / distance, distance + radius, box, kRounding + from + radius * std::min(far / distance, 1.0F));
}

void LightShafts::add_lamps(const DirectLight& lights) {
    for (const PlacedLight& l : lights.lights()) {
        if (l.light.kind == Light::Kind::Directional) {
            suns_.push_back({-l.axis, std::tan(float(radians_from_degrees(0.5 * l.light.angular_diameter_degrees)))});
        } else {
            balls_.push_back({l.position, 0.0F});
        }
    }
}

void LightShafts::add_emitters(const Hierarchy& h, std::size_t most) {
    if (h.empty()) {
        return;
    }
    // The largest balls that hold light are opened until there are enough.
    const auto smaller = [&](std::uint32_t a, std::uint32_t b) { return h.elements[a].radius < h.elements[b].radius; };
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, decltype(smaller)> open(smaller);
    std::vector<std::uint32_t> done;
    const auto add = [&](std::uint32_t i) {
        if (h.elements[i].power > 0.0F) {
            if (h.elements[i].leaf()) {
                done.push_back(i);
            } else {
                open.push(i);
            }
        }
    };
    add(0);
    while (!open.empty() && open.size() + done.size() < most) {
        const std::uint32_t i = open.top();
        open.pop();
        const Element& e = h.elements[i];
        for (std::uint32_t c = e.first_child; c < e.first_child + e.child_count; ++c) {
            add(c);
        }
    }
    for (; !open.empty(); open.pop()) {
        done.push_back(open.top());
    }
    for (const std::uint32_t i : done) {
        balls_.push_back({h.elements[i].centre, h.elements[i].radius});
    }
}

void LightShafts::add_sky(const SkyLight& sky) {
    if (sky.empty()) {
        return;
    }
    for (const SkyWindow& w : sky.windows()) {
        vec3 centre(0.0F);
        for (const vec3& c : w.outline()) {
            centre += c / float(w.corner_count);
        }
        float radius = 0.0F;
        for (const vec3& c : w.outline()) {
            radius = std::max(radius, glm::length(c - centre));
        }
        balls_.push_back({centre, radius});
    }
    all_round_ = sky.elsewhere();
}

bool LightShafts::straight(const vec3& point, float radius, const Box3& box) const {
    const vec3 to = 0.5F * (box.min + box.max) - point;
    const float half = 0.5F * glm::length(box.max - box.min);
    const float near = std::max(glm::length(to) - radius, 1e-6F);
    if (all_round_ && half > kSmallestCone * near) {
        return true;
    }
    // What the box may hide of a ball is at most the ratio of the solid angles that they fill.
    const auto worth = [&](const Ball& b) {
        const float seen = b.radius / std::max(glm::length(b.centre - point) - radius, 1e-6F);
        return half > near || half * half >= kSmallestShare * seen * seen * near * near;
    };
    return std::any_of(suns_.begin(), suns_.end(),
                       [&](const Sun& s) { return shaft_to_sun_touches(point, radius, s.direction, s.spread, box); }) ||
           std::any_of(balls_.begin(), balls_.end(), [&](const Ball& b) {
               // Most are far off: the box's ball against the shaft as a capsule.
               const vec3 d = b.centre - point;
               const float along = std::clamp(glm::dot(to, d) / std::max(glm::dot(d, d), 1e-12F), 0.0F, 1.0F);
               const vec3 off = to - along * d;
               const float reach = half + b.radius + radius + kRounding;
               return glm::dot(off, off) <= reach * reach && worth(b) &&
                      shaft_to_ball_touches(point, radius, b.centre, b.radius, box);
           });
}

bool LightShafts::touched(const vec3& point, float radius, const Box3& box) const {
    if (mirrors_.empty()) {
        return straight(point, radius, box);
    }
    // From the image the way to the mirror meets mirrored things, the way on from it real ones.
    return std::any_of(mirrors_.begin(), mirrors_.end(), [&](const PlanarMirror& mirror) {
        if (!mirror.both_sides && mirror.height(point) <= -radius) {
            return false;
        }
        const vec3 image = mirror.reflect_point(point);
        return straight(image, radius, box) || straight(image, radius, mirrored(box, mirror));
    });
}

} // namespace atrium
