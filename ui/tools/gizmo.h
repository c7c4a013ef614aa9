// The move, rotate and scale handles: where they are on the screen and what dragging one means. Pure, no GL, no document.
#pragma once

#include "ui/viewport/overlay_batch.h"

#include <optional>

namespace atrium::ui {

enum class GizmoKind : std::uint8_t { Move, Rotate, Scale };

/// Part of a gizmo. A plane handle is named after its normal.
enum class Handle : std::uint8_t {
    None,
    AxisX,
    AxisY,
    AxisZ,
    PlaneX,
    PlaneY,
    PlaneZ,
    Centre,
    RingX,
    RingY,
    RingZ,
    RingView
};

/// 0, 1, 2 for the axis that a handle belongs to; -1 for Centre and RingView.
int handle_axis(Handle handle);
/// The handle between two arrows.
bool is_plane(Handle handle);

/// Where a gizmo stands; columns of `axes` are unit and orthogonal. Constant size on the screen.
struct Gizmo {
    GizmoKind kind = GizmoKind::Move;
    dvec3 origin{0.0};
    dmat3 axes{1.0};

    static constexpr double kLength = 86.0;   ///< of an axis, logical pixels
    static constexpr double kTolerance = 8.0; ///< around a handle, logical pixels

    /// Handle under a screen point, the nearest where several overlap.
    [[nodiscard]] Handle at(const CameraController& camera, const dvec2& point) const;
    void draw(OverlayBatch& batch, const CameraController& camera, Handle highlighted, bool dragging) const;
};

/// Parameter t of the point origin + t * axis that is nearest to the ray; none when they are nearly parallel.
std::optional<double> nearest_on_axis(const Ray& ray, const dvec3& origin, const dvec3& axis);
/// Where the ray meets a plane in front of its origin; none when it (nearly) runs along it.
std::optional<dvec3> meet_plane(const Ray& ray, const dvec3& origin, const dvec3& normal);
/// Angle from a to b about a unit axis, radians in (-pi, pi].
double angle_about(const dvec3& axis, const dvec3& a, const dvec3& b);

} // namespace atrium::ui
