#include "ui/tools/gizmo.h"

#include <algorithm>
#include <array>

namespace atrium::ui {
namespace {

constexpr double kPlaneNear = 0.28; ///< the plane handle's square, in axis lengths
constexpr double kPlaneFar = 0.52;
constexpr double kRing = 0.9;
constexpr double kViewRing = 1.12;
constexpr int kRingSides = 64;

constexpr std::array<Handle, 3> kAxes{Handle::AxisX, Handle::AxisY, Handle::AxisZ};
constexpr std::array<Handle, 3> kPlanes{Handle::PlaneX, Handle::PlaneY, Handle::PlaneZ};
constexpr std::array<Handle, 3> kRings{Handle::RingX, Handle::RingY, Handle::RingZ};

vec4 color_of(int axis) {
    constexpr std::array<std::array<float, 3>, 3> kColors{
        {{0.90F, 0.23F, 0.25F}, {0.33F, 0.70F, 0.18F}, {0.20F, 0.47F, 0.95F}}};
    const auto& c = kColors[std::size_t(axis)];
    return {c[0], c[1], c[2], 1.0F};
}

const vec4 kBright(1.0F, 0.82F, 0.20F, 1.0F);

double distance_to_segment(const dvec2& p, const dvec2& a, const dvec2& b) {
    const dvec2 d = b - a;
    const double square = glm::dot(d, d);
    const double t = square > 0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0.0;
    return glm::length(p - (a + d * t));
}

bool inside_convex(const dvec2& p, const std::array<dvec2, 4>& q) {
    int positive = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const dvec2 e = q[(i + 1) % 4] - q[i];
        const dvec2 d = p - q[i];
        positive += e.x * d.y - e.y * d.x > 0 ? 1 : 0;
    }
    return positive == 0 || positive == 4;
}

/// Everything that at() and draw() share.
struct Layout {
    const Gizmo& gizmo;
    const CameraController& camera;
    double size;  ///< metres of one axis
    dvec3 to_eye; ///< unit

    Layout(const Gizmo& g, const CameraController& c)
        : gizmo(g), camera(c), size(Gizmo::kLength * c.pixel_size(g.origin)), to_eye(glm::normalize(c.eye() - g.origin)) {}

    /// An axis that points at the eye is a dot: nothing to grab.
    [[nodiscard]] bool axis_usable(int i) const { return std::abs(glm::dot(gizmo.axes[i], to_eye)) < 0.985; }
    [[nodiscard]] bool plane_usable(int i) const { return std::abs(glm::dot(gizmo.axes[i], to_eye)) > 0.17; }
    [[nodiscard]] std::optional<dvec2> axis_end(int i, double share = 1.0) const {
        return camera.project(gizmo.origin + gizmo.axes[i] * (size * share));
    }
    [[nodiscard]] std::optional<std::array<dvec2, 4>> plane_square(int i) const {
        const dvec3 u = gizmo.axes[(i + 1) % 3] * size;
        const dvec3 v = gizmo.axes[(i + 2) % 3] * size;
        std::array<dvec2, 4> out;
        constexpr std::array<std::array<double, 2>, 4> kCorners{
            {{kPlaneNear, kPlaneNear}, {kPlaneFar, kPlaneNear}, {kPlaneFar, kPlaneFar}, {kPlaneNear, kPlaneFar}}};
        for (std::size_t c = 0; c < 4; ++c) {
            const auto p = camera.project(gizmo.origin + u * kCorners[c][0] + v * kCorners[c][1]);
            if (!p) {
                return std::nullopt;
            }
            out[c] = *p;
        }
        return out;
    }
    /// Calls f(a, b, facing) for every piece of a ring; facing = on the half towards the eye.
    template <class F> void each_ring_piece(int i, F&& f) const {
        const dvec3 u = gizmo.axes[(i + 1) % 3] * (size * kRing);
        const dvec3 v = gizmo.axes[(i + 2) % 3] * (size * kRing);
        for (int k = 0; k < kRingSides; ++k) {
            const double s = 2.0 * kPiD * k / kRingSides;
            const double t = 2.0 * kPiD * (k + 1) / kRingSides;
            const dvec3 p = u * std::cos(s) + v * std::sin(s);
            const dvec3 q = u * std::cos(t) + v * std::sin(t);
            const auto a = camera.project(gizmo.origin + p);
            const auto b = camera.project(gizmo.origin + q);
            if (a && b) {
                // Seen face on, all of the ring is in front.
                const bool facing = glm::dot(p + q, to_eye) > -0.12 * size;
                f(*a, *b, facing);
            }
        }
    }
};

} // namespace

bool is_plane(Handle handle) { return handle == Handle::PlaneX || handle == Handle::PlaneY || handle == Handle::PlaneZ; }

int handle_axis(Handle handle) {
    switch (handle) {
    case Handle::AxisX:
    case Handle::PlaneX:
    case Handle::RingX: return 0;
    case Handle::AxisY:
    case Handle::PlaneY:
    case Handle::RingY: return 1;
    case Handle::AxisZ:
    case Handle::PlaneZ:
    case Handle::RingZ: return 2;
    case Handle::None:
    case Handle::Centre:
    case Handle::RingView: break;
    }
    return -1;
}

Handle Gizmo::at(const CameraController& camera, const dvec2& point) const {
    const auto centre = camera.project(origin);
    if (!centre) {
        return Handle::None;
    }
    const Layout layout(*this, camera);
    Handle best = Handle::None;
    double nearest = kTolerance;
    const auto offer = [&](Handle handle, double distance) {
        if (distance < nearest) {
            nearest = distance;
            best = handle;
        }
    };
    if (kind == GizmoKind::Rotate) {
        for (int i = 0; i < 3; ++i) {
            layout.each_ring_piece(i, [&](const dvec2& a, const dvec2& b, bool facing) {
                if (facing) {
                    offer(kRings[std::size_t(i)], distance_to_segment(point, a, b));
                }
            });
        }
        offer(Handle::RingView, std::abs(glm::length(point - *centre) - kLength * kViewRing) + 1.0);
        return best;
    }
    if (glm::length(point - *centre) <= kTolerance) {
        return Handle::Centre;
    }
    for (int i = 0; i < 3; ++i) {
        const auto end = layout.axis_end(i, 1.05);
        if (end && layout.axis_usable(i)) {
            offer(kAxes[std::size_t(i)], distance_to_segment(point, *centre, *end));
        }
    }
    if (best == Handle::None && kind == GizmoKind::Move) {
        for (int i = 0; i < 3; ++i) {
            const auto square = layout.plane_square(i);
            if (square && layout.plane_usable(i) && inside_convex(point, *square)) {
                best = kPlanes[std::size_t(i)];
            }
        }
    }
    return best;
}

void Gizmo::draw(OverlayBatch& batch, const CameraController& camera, Handle highlighted, bool dragging) const {
    const auto centre = camera.project(origin);
    if (!centre) {
        return;
    }
    const Layout layout(*this, camera);
    const auto tint = [&](Handle handle, int axis) {
        vec4 color = highlighted == handle ? kBright : color_of(axis);
        if (dragging && highlighted != handle) {
            color.a = 0.25F;
        }
        return color;
    };
    const vec4 shadow(0.0F, 0.0F, 0.0F, dragging ? 0.1F : 0.35F);
    if (kind == GizmoKind::Rotate) {
        for (int i = 0; i < 3; ++i) {
            const vec4 color = tint(kRings[std::size_t(i)], i);
            layout.each_ring_piece(i, [&](const dvec2& a, const dvec2& b, bool facing) {
                if (facing) {
                    batch.line(a, b, 4.5, shadow);
                }
            });
            layout.each_ring_piece(i, [&](const dvec2& a, const dvec2& b, bool facing) {
                batch.line(a, b, facing ? 2.5 : 1.0, facing ? color : vec4(color.r, color.g, color.b, 0.25F * color.a));
            });
        }
        const vec4 outer = highlighted == Handle::RingView ? kBright : vec4(0.95F, 0.95F, 0.95F, dragging ? 0.2F : 0.7F);
        batch.circle(*centre, kLength * kViewRing, 3.5, shadow);
        batch.circle(*centre, kLength * kViewRing, 1.5, outer);
        return;
    }
    if (kind == GizmoKind::Move) {
        for (int i = 0; i < 3; ++i) {
            const auto square = layout.plane_square(i);
            if (!square || !layout.plane_usable(i)) {
                continue;
            }
            vec4 color = tint(kPlanes[std::size_t(i)], i);
            const vec4 border = color;
            color.a *= 0.4F;
            batch.polygon(*square, color);
            for (std::size_t c = 0; c < 4; ++c) {
                batch.line((*square)[c], (*square)[(c + 1) % 4], 1.2, border);
            }
        }
    }
    // Far axes first, so that the nearest one lies on top.
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return glm::dot(axes[a], layout.to_eye) < glm::dot(axes[b], layout.to_eye); });
    for (const int i : order) {
        const auto end = layout.axis_end(i);
        if (!end || !layout.axis_usable(i)) {
            continue;
        }
        const vec4 color = tint(kAxes[std::size_t(i)], i);
        batch.line(*centre, *end, 5.0, shadow);
        if (kind == GizmoKind::Move) {
            batch.arrow(*centre, *end, 3.0, 15.0, color);
        } else {
            batch.line(*centre, *end, 3.0, color);
            const dvec2 half(5.0, 5.0);
            batch.rectangle(*end - half, *end + half, color, color);
        }
    }
    const vec4 middle = highlighted == Handle::Centre ? kBright : vec4(0.95F, 0.95F, 0.95F, dragging ? 0.3F : 0.95F);
    batch.disc(*centre, 6.5, shadow);
    batch.disc(*centre, 5.0, middle);
}

std::optional<double> nearest_on_axis(const Ray& ray, const dvec3& origin, const dvec3& axis) {
    const dvec3 w = origin - ray.origin;
    const double b = glm::dot(axis, ray.direction);
    const double determinant = 1.0 - b * b;
    if (determinant < 1e-4) {
        return std::nullopt;
    }
    return (b * glm::dot(ray.direction, w) - glm::dot(axis, w)) / determinant;
}

std::optional<dvec3> meet_plane(const Ray& ray, const dvec3& origin, const dvec3& normal) {
    const double slope = glm::dot(ray.direction, normal);
    if (std::abs(slope) < 1e-3) {
        return std::nullopt;
    }
    const double t = glm::dot(origin - ray.origin, normal) / slope;
    return t > 0 ? std::optional(ray.at(t)) : std::nullopt;
}

double angle_about(const dvec3& axis, const dvec3& a, const dvec3& b) {
    return std::atan2(glm::dot(axis, glm::cross(a, b)), glm::dot(a, b));
}

} // namespace atrium::ui
