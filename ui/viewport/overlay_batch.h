// Flat figures over the picture (lines, discs, quads) as triangles in logical pixels. Pure geometry, no GL.
#pragma once

#include "ui/viewport/camera_controller.h"

#include <span>
#include <vector>

namespace atrium::ui {

struct OverlayVertex {
    vec2 position; ///< logical pixels from the top left corner
    vec4 color;    ///< display values with straight alpha
};

/// Core profiles promise no wide or smooth lines, so lines are quads with soft edges.
class OverlayBatch {
public:
    [[nodiscard]] const std::vector<OverlayVertex>& vertices() const { return vertices_; }
    void clear() { vertices_.clear(); }

    void line(const dvec2& a, const dvec2& b, double width, const vec4& color);
    void triangle(const dvec2& a, const dvec2& b, const dvec2& c, const vec4& color);
    void polygon(std::span<const dvec2> convex, const vec4& color);
    void disc(const dvec2& centre, double radius, const vec4& color);
    void circle(const dvec2& centre, double radius, double width, const vec4& color);
    void rectangle(const dvec2& a, const dvec2& b, const vec4& fill, const vec4& border);
    /// Line between world points, cut off at the eye.
    void line3(const CameraController& camera, const dvec3& a, const dvec3& b, double width, const vec4& color);
    /// Line with a head at b.
    void arrow(const dvec2& a, const dvec2& b, double width, double head, const vec4& color);

private:
    std::vector<OverlayVertex> vertices_;
};

} // namespace atrium::ui
