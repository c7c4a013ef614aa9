#include "engine/radiosity/light_shafts.h"

#include <algorithm>
#include <array>
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

namespace {

// What a box may hide of a ball is at most the ratio of the solid angles that they fill.
bool worth(const vec3& point, float radius, const vec3& centre, float ball, float half, float near) {
    const float seen = ball / std::max(glm::length(centre - point) - radius, 1e-6F);
    return half > near || half * half >= kSmallestShare * seen * seen * near * near;
}

// Whether anything of a ball lies within reach of the way from a point to another, which ends where that is.
bool beside_way(const vec3& centre, float reach, const vec3& point, const vec3& end) {
    const vec3 d = end - point, to = centre - point;
    const float along = std::clamp(glm::dot(to, d) / std::max(glm::dot(d, d), 1e-12F), 0.0F, 1.0F);
    const vec3 off = to - along * d;
    return glm::dot(off, off) <= reach * reach;
}

} // namespace

bool LightShafts::straight(const vec3& point, float radius, const Box3& box) const {
    const vec3 centre = box.centre();
    const float half = 0.5F * box.diagonal();
    const float near = std::max(glm::length(centre - point) - radius, 1e-6F);
    if (all_round_ && half > kSmallestCone * near) {
        return true;
    }
    return std::any_of(suns_.begin(), suns_.end(),
                       [&](const Sun& s) { return shaft_to_sun_touches(point, radius, s.direction, s.spread, box); }) ||
           std::any_of(balls_.begin(), balls_.end(), [&](const Ball& b) {
               // Most are far off: the box's ball against the shaft as a capsule.
               return beside_way(centre, half + b.radius + radius + kRounding, point, b.centre) &&
                      worth(point, radius, b.centre, b.radius, half, near) &&
                      shaft_to_ball_touches(point, radius, b.centre, b.radius, box);
           });
}

// From the image the way to the mirror meets mirrored things, the way on from it real ones; only sources count that are
// seen past the mirror's ball.
bool LightShafts::over_mirror(const PlanarMirror& mirror, const vec3& point, float radius, const Box3& box) const {
    if (!mirror.both_sides && mirror.height(point) <= -radius) {
        return false;
    }
    const vec3 image = mirror.reflect_point(point);
    const vec3 middle = 0.5F * (mirror.corner[0] + mirror.corner[2]);
    const float size = 0.5F * glm::length(mirror.corner[2] - mirror.corner[0]) + kRounding;
    const Box3 image_of_box = mirrored(box, mirror);
    const std::array<const Box3*, 2> boxes{&box, &image_of_box};
    const auto any_box = [&](const auto& touches) {
        return std::any_of(boxes.begin(), boxes.end(), [&](const Box3* b) { return touches(*b); });
    };
    return std::any_of(suns_.begin(), suns_.end(),
                       [&](const Sun& s) {
                           const float far = glm::length(middle - image) + size;
                           return beside_way(middle, size + radius + s.spread * far, image, image + far * s.direction) &&
                                  any_box([&](const Box3& b) {
                                      return shaft_to_sun_touches(image, radius, s.direction, s.spread, b);
                                  });
                       }) ||
           std::any_of(balls_.begin(), balls_.end(), [&](const Ball& b) {
               return beside_way(middle, size + std::max(radius, b.radius), image, b.centre) && any_box([&](const Box3& of) {
                          const float half = 0.5F * of.diagonal();
                          const float near = std::max(glm::length(of.centre() - image) - radius, 1e-6F);
                          return worth(image, radius, b.centre, b.radius, half, near) &&
                                 shaft_to_ball_touches(image, radius, b.centre, b.radius, of);
                      });
           });
}

bool LightShafts::touched(const vec3& point, float radius, const Box3& box) const {
    if (mirrors_.empty()) {
        return straight(point, radius, box);
    }
    return std::any_of(mirrors_.begin(), mirrors_.end(),
                       [&](const PlanarMirror& mirror) { return over_mirror(mirror, point, radius, box); });
}

namespace {

constexpr unsigned kMostScouts = 32;

// Even points about the middle of a disc of radius sqrt(n), for the first n.
const std::array<vec2, kMostScouts> kSpiral = [] {
    std::array<vec2, kMostScouts> out;
    for (unsigned k = 0; k < kMostScouts; ++k) {
        const float r = std::sqrt(float(k) + 0.5F), angle = 2.39996323F * float(k); // the golden angle
        out[k] = {r * std::cos(angle), r * std::sin(angle)};
    }
    return out;
}();

} // namespace

/// Rays of one point that are only asked whether they meet what moved, straight or over a mirror.
class LightShafts::Scout {
public:
    Scout(const RayScene& rays, const SurfacePoint& at, const PlanarMirror* mirror, bool closely)
        : rays_(rays), point_(at.position), normal_(at.normal), mirror_(mirror),
          from_(mirror != nullptr ? mirror->reflect_point(at.position) : at.position), most_blocked_(closely ? 8 : 4) {}
    /// Where rays seem to start.
    [[nodiscard]] const vec3& from() const { return from_; }
    [[nodiscard]] bool straight() const { return mirror_ == nullptr; }

    /// A ray that ends where the source does, which begins at `near`, meets what moved with nothing else in the way.
    [[nodiscard]] bool meets(const vec3& direction, float near, float end) const {
        if (mirror_ == nullptr) {
            return above(direction) && rays_.meets_moved({point_, direction, end}) && free(point_, direction, near);
        }
        const auto slope = float(glm::dot(mirror_->normal, dvec3(direction)));
        const float t = slope != 0.0F ? -float(mirror_->height(from_)) / slope : -1.0F;
        if (!(t > 0.0F) || t > end) {
            return false;
        }
        const vec3 at = from_ + t * direction, to = at - point_;
        const vec3 u = mirror_->corner[1] - mirror_->corner[0], v = mirror_->corner[3] - mirror_->corner[0];
        const float x = glm::dot(at - mirror_->corner[0], u), y = glm::dot(at - mirror_->corner[0], v);
        const bool crosses = x >= 0.0F && y >= 0.0F && x <= glm::dot(u, u) && y <= glm::dot(v, v);
        const float length = glm::length(to);
        return crosses && length > 0.0F && above(to) &&
               (rays_.meets_moved({point_, to / length, length}) || rays_.meets_moved({at, direction, end - t})) &&
               free(point_, to / length, length) && free(at, direction, near - t);
    }
    /// One of `count` rays into the cone of a ball meets what moved, of those that pass within another (radius 0: its
    /// middle). Where the first that do are all blocked by other things, so are all.
    [[nodiscard]] bool meets_in_cone(const vec3& centre, float radius, unsigned count, const Ball* within, float near,
                                     float end) const {
        const vec3 d = centre - from_;
        const float distance = std::max(glm::length(d), 1e-6F);
        const vec3 axis = d / distance;
        vec3 t;
        vec3 b;
        make_frame(axis, t, b);
        const float sine = radius / distance;
        if (sine > kAllRound) {
            return true;
        }
        const float wide = sine / std::sqrt(1.0F - sine * sine);
        blocked_ = 0;
        for (unsigned k = 0; k < count && blocked_ < most_blocked_; ++k) {
            const vec2 at = kSpiral[k] * (wide / std::sqrt(float(count)));
            const vec3 direction = glm::normalize(axis + at.x * t + at.y * b);
            if (within != nullptr && !beside_way(within->centre, within->radius, from_, from_ + end * direction)) {
                continue;
            }
            if (meets(direction, near, end)) {
                return true;
            }
        }
        return false;
    }

private:
    static constexpr float kAllRound = 0.9F; // sine: a ball that all but holds the point is as good as met

    [[nodiscard]] bool free(const vec3& from, const vec3& direction, float end) const {
        const bool blocked = rays_.still_blocks({from, direction, end - kRounding});
        blocked_ += blocked ? 1 : 0;
        return !blocked;
    }
    [[nodiscard]] bool above(const vec3& d) const { return normal_ == vec3(0.0F) || glm::dot(d, normal_) > 0.0F; }

    const RayScene& rays_;
    vec3 point_, normal_;
    const PlanarMirror* mirror_;
    vec3 from_;
    unsigned most_blocked_;
    mutable unsigned blocked_ = 0; ///< rays of a cone
};

bool LightShafts::meets_moved(const RayScene& rays, const SurfacePoint& at, std::span<const Box3> boxes,
                              bool closely) const {
    const vec3 &point = at.position, &normal = at.normal;
    const unsigned to_ball = closely ? kMostScouts : kMostScouts / 2;
    constexpr unsigned kToSun = 9;
    constexpr float kFar = 1e6F; // metres
    const auto any = [&](const Scout& scout) {
        const vec3& from = scout.from();
        const auto over = [&](const Sun& s) {
            const bool up = !scout.straight() || normal == vec3(0.0F) || glm::dot(normal, s.direction) > -s.spread;
            const bool near = up && (!scout.straight() || std::any_of(boxes.begin(), boxes.end(), [&](const Box3& box) {
                                  return shaft_to_sun_touches(from, 0.0F, s.direction, s.spread, box);
                              }));
            const float sine = s.spread / std::sqrt(1.0F + s.spread * s.spread);
            return near && scout.meets_in_cone(from + s.direction, sine, kToSun, nullptr, kFar, kFar);
        };
        const auto in = [&](const Ball& b) {
            const float distance = glm::length(b.centre - from);
            const float near = distance - b.radius, end = distance + b.radius;
            if (!scout.straight() || b.radius == 0.0F) {
                return scout.meets_in_cone(b.centre, b.radius, b.radius > 0.0F ? to_ball : 1, nullptr, near, end);
            }
            if (normal != vec3(0.0F) && glm::dot(b.centre - from, normal) <= -b.radius) {
                return false;
            }
            return std::any_of(boxes.begin(), boxes.end(), [&](const Box3& box) {
                if (!shaft_to_ball_touches(from, 0.0F, b.centre, b.radius, box)) {
                    return false;
                }
                // Into the smaller of both, as they look from there.
                const float half = 0.5F * box.diagonal(), to_box = glm::length(box.centre() - from);
                return half * distance < b.radius * to_box
                           ? scout.meets_in_cone(box.centre(), half, to_ball, &b, near, end)
                           : scout.meets_in_cone(b.centre, b.radius, to_ball, nullptr, near, end);
            });
        };
        return std::any_of(suns_.begin(), suns_.end(), over) || std::any_of(balls_.begin(), balls_.end(), in);
    };
    if (!mirrors_.empty()) {
        return std::any_of(mirrors_.begin(), mirrors_.end(), [&](const PlanarMirror& mirror) {
            return (mirror.both_sides || mirror.height(point) > 0.0) &&
                   std::any_of(boxes.begin(), boxes.end(),
                               [&](const Box3& box) { return over_mirror(mirror, point, 0.0F, box); }) &&
                   any(Scout(rays, at, &mirror, closely));
        });
    }
    const Scout scout(rays, at, nullptr, closely);
    return any(scout) || (all_round_ && std::any_of(boxes.begin(), boxes.end(), [&](const Box3& box) {
                              return scout.meets_in_cone(box.centre(), 0.5F * box.diagonal(), to_ball, nullptr, kFar, kFar);
                          }));
}

} // namespace atrium
