// Rays through the pixels of a camera.
#pragma once

#include "engine/base/parallel.h"
#include "engine/raycast/ray_scene.h"
#include "engine/view/still.h"

#include <algorithm>
#include <optional>

namespace atrium {

/// A camera's rays in engine coordinates.
class CameraRays {
public:
    CameraRays(const ViewCamera& camera, const dvec3& origin, int width, int height);
    /// `x`, `y` in pixels from the upper left corner.
    [[nodiscard]] Ray through(float x, float y) const;
    /// Where a point of the scene appears, pixels from the upper left corner, also beside the picture; none behind the eye.
    [[nodiscard]] std::optional<vec2> pixel_of(const vec3& point) const;
    /// Metres before the eye along the camera's axis; what is closer than kNearest is not seen in perspective.
    [[nodiscard]] float depth_of(const vec3& point) const;
    static constexpr float kNearest = 1e-4F;

private:
    vec3 eye_, right_, up_, forward_;
    float aspect_, half_height_, width_, height_;
    bool perspective_;
};

/// Calls sample(pixel, index of the sample within it, ray) for n x n samples of all pixels, in parallel over pixels. Stops
/// within some milliseconds when the context says so.
template <class Sample>
void look_through(const ViewCamera& camera, const dvec3& origin, int width, int height, int n, const RunContext& context,
                  Sample&& sample) {
    const CameraRays rays(camera, origin, width, height);
    constexpr std::size_t kBand = 8; // rows between two reports
    const auto columns = std::size_t(width);
    const auto rows = std::size_t(height);
    for (std::size_t first = 0; first < rows && !context.should_stop(); first += kBand) {
        const std::size_t count = std::min(kBand, rows - first) * columns;
        parallel_chunks(count, 64, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
                const std::size_t pixel = first * columns + i;
                for (int s = 0; s < n * n; ++s) {
                    sample(pixel, s,
                           rays.through(float(pixel % columns) + (float(s % n) + 0.5F) / float(n),
                                        float(pixel / columns) + (float(s / n) + 0.5F) / float(n)));
                }
            }
        });
        context.progress("render", double(std::min(first + kBand, rows)) / double(rows));
    }
}

} // namespace atrium
