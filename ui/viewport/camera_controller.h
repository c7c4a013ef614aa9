// Where the viewport looks from: turntable orbit, pan, dolly to the cursor, framing and walking. Pure logic, no GL.
#pragma once

#include "engine/view/still.h"

#include <optional>

namespace atrium::ui {

/// Half line in the world; direction is unit.
struct Ray {
    dvec3 origin{0.0};
    dvec3 direction{0.0, 0.0, -1.0};
    [[nodiscard]] dvec3 at(double t) const { return origin + direction * t; }
};

/// Keys held in walk mode.
struct WalkInput {
    double forward = 0; ///< -1 to 1
    double right = 0;
    double up = 0;
    bool fast = false;
    [[nodiscard]] bool any() const { return forward != 0 || right != 0 || up != 0; }
};

/// Camera with fixed up (+Y). Screen points are logical (device independent) pixels from the top left corner.
class CameraController {
public:
    static constexpr double kEyeHeight = 1.6;    ///< metres above the floor while walking
    static constexpr double kWalkSpeed = 1.4;    ///< m/s, a person's pace
    static constexpr double kFastFactor = 3.5;   ///< with Shift
    static constexpr double kOrbitSpeed = 0.006; ///< radians per pixel

    void set_viewport(double width, double height);
    /// What near and far planes and speeds adapt to; far outliers left out.
    void set_scene_bounds(const DBox3& bounds) { bounds_ = bounds; }

    [[nodiscard]] const DBox3& scene_bounds() const { return bounds_; }

    [[nodiscard]] ViewCamera camera() const;
    /// Takes eye, direction and lens; roll is dropped (turntable), an orthographic lens becomes a perspective one that
    /// shows the same height at the focus.
    void set_camera(const ViewCamera& camera);

    [[nodiscard]] dvec3 eye() const { return eye_; }
    [[nodiscard]] dvec3 forward() const;
    [[nodiscard]] dvec3 right() const;
    [[nodiscard]] dvec3 up() const;
    [[nodiscard]] double width() const { return width_; }
    [[nodiscard]] double height() const { return height_; }
    [[nodiscard]] double yfov() const { return yfov_; }
    [[nodiscard]] double focus_distance() const { return focus_distance_; }
    /// World to camera axes about the eye (no translation: geometry is drawn relative to the eye, so that survey
    /// coordinates keep their precision).
    [[nodiscard]] dmat4 rotation() const;
    [[nodiscard]] dmat4 projection() const;
    [[nodiscard]] double near_plane() const;
    [[nodiscard]] double far_plane() const;

    [[nodiscard]] Ray ray(const dvec2& point) const;
    /// Screen point of a world point; none behind the eye.
    [[nodiscard]] std::optional<dvec2> project(const dvec3& world) const;
    /// Metres in the world that one logical pixel covers at a point.
    [[nodiscard]] double pixel_size(const dvec3& world) const;

    /// Turns about `pivot`, which keeps its place on the screen. Pixels dragged.
    void orbit(const dvec2& delta, const dvec3& pivot);
    /// Turns the head: dragging right looks to the right.
    void look(const dvec2& delta);
    /// Shifts so that a point at `pivot`'s depth follows the cursor.
    void pan(const dvec2& delta, const dvec3& pivot);
    /// Moves towards `target` (steps > 0) by 15 % of the distance a step; never through it.
    void dolly(double steps, const dvec3& target);
    /// Moves straight back or forward until the box fills the view. Keeps the direction.
    void frame(const DBox3& box);

    /// One step of walking: keeps to the horizontal plane except for up/down.
    void walk(const WalkInput& input, double seconds);
    /// Eases the eye to `eye_height` above a floor found below, for `seconds`.
    void settle_on_floor(double floor_y, double seconds, double eye_height = kEyeHeight);
    void set_eye(const dvec3& eye) { eye_ = eye; }

private:
    void turn(double yaw, double pitch);

    dvec3 eye_{3.0, 2.0, 5.0};
    double yaw_ = 0;   ///< radians about +Y; 0 looks along -z
    double pitch_ = 0; ///< radians, positive up
    double yfov_ = 0.9;
    double focus_distance_ = 5;
    double width_ = 1;
    double height_ = 1;
    DBox3 bounds_;
};

/// Bounds of all shown shapes without far outliers: a node further from the median centre than ten times the median
/// spread of the nodes is left out. Empty for an empty scene.
DBox3 robust_bounds(const Scene& scene);

/// The view a file opens with: its first camera if that sees something of the scene, else one inside
/// the room; of a thing that is smaller than a room, one from outside.
ViewCamera initial_view(const Scene& scene);

} // namespace atrium::ui
