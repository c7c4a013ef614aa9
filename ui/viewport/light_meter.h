// Reads the light of what the view shows: at a ray from the eye, and at points that stay where they were put.
#pragma once

#include "engine/measure/light_reading.h"
#include "engine/measure/local_error.h"
#include "ui/viewport/view_scene.h"

#include <string>

namespace atrium::ui {

/// A place on a matt surface and its light.
struct MeterReading {
    NodeId node;
    std::uint32_t part = 0;
    dvec3 point{0.0};            ///< world, metres
    dvec3 normal{0.0, 1.0, 0.0}; ///< world, unit: of the side that is read
    LightReading light;
};

/// The light on the first surface that a ray meets, glass looked through; none where that is no matt surface or has no
/// light yet. As quick as a pick. With `error`, the standard error is what is likely at that place, not that of the whole
/// scene. UI thread.
std::optional<MeterReading> read_along(const ViewScene& view, const Scene& scene, const Solution& solution, const Ray& ray,
                                       const LocalError* error = nullptr);

/// "312 lx \u00b1 6", "98 cd/m\u00b2" and what came which way: the lines of a label.
QStringList reading_lines(const LightReading& light);

/// Points that keep to the surfaces they were put on and are read again whenever something changes. UI thread only.
class MeasuringPoints {
public:
    struct Point {
        int number = 0; ///< from 1, never used twice in a session
        NodeId node;
        std::uint32_t part = 0;
        dvec3 place{0.0};                    ///< in the node's own coordinates
        dvec3 normal{0.0, 1.0, 0.0};         ///< likewise, of the side that is read
        std::optional<MeterReading> reading; ///< none while there is no light or the surface is gone
        bool hidden = false;                 ///< something stands between it and the eye
    };
    void add(const Scene& scene, const MeterReading& reading);
    void remove(int number);
    void clear() { points_.clear(); }
    /// Brings the readings up to date; `error` as for read_along().
    void read(const ViewScene& view, const Scene& scene, const std::shared_ptr<const Solution>& solution,
              const LocalError* error = nullptr);
    /// Finds out what is in sight.
    void look(const ViewScene& view, const CameraController& camera);
    [[nodiscard]] const std::vector<Point>& points() const { return points_; }
    /// The point whose mark is at a place on the screen; null for none.
    [[nodiscard]] const Point* at(const CameraController& camera, const dvec2& position) const;
    /// The columns of `atrium-cli measure` with the point's number before and luminance and shares behind them; points
    /// without a reading are left out.
    [[nodiscard]] std::string csv() const;

private:
    std::vector<Point> points_;
    int next_number_ = 1;
};

} // namespace atrium::ui
