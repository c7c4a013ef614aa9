// Lines and coloured triangles that lie in the scene, over its picture and behind what hides them.
#pragma once

#include "ui/viewport/gl.h"
#include "ui/viewport/gpu_scene.h"

#include <array>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace atrium::ui {

/// Display values in bytes.
struct FigureColor {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;
    friend bool operator==(const FigureColor&, const FigureColor&) = default;
};
FigureColor figure_color(const Rgb& display, float alpha = 1.0F);

/// A line; one without length is a square.
struct FigureLine {
    vec3 from{0.0F};
    vec3 to{0.0F};
    FigureColor color;
    std::uint32_t normal = 0; ///< pack_normal() of the side that it lies on: not drawn from behind; 0 = seen from all sides
    float width = 1.0F;       ///< logical pixels
};
struct FigureCorner {
    vec3 position{0.0F};
    FigureColor color;
};
/// Figures on one (node, part), in its own coordinates: they go where it goes and vanish with it.
struct FigureGroup {
    NodeId node; ///< none: world coordinates less `origin`
    std::uint32_t part = 0;
    dvec3 origin{0.0};
    std::vector<FigureCorner> corners; ///< three a triangle, drawn from the side that they go round counter-clockwise
    std::vector<FigureLine> lines;
};
struct FigureSet {
    std::vector<FigureGroup> groups;
};
/// What a frame draws: a set and how opaque it is.
struct ShownFigures {
    std::shared_ptr<const FigureSet> set;
    float alpha = 1.0F;
};

/// Context current in every function but the constructor. UI thread only. Without figures it has nothing on the GPU.
class SceneFigures {
public:
    bool initialize(Gl& gl);
    void release();
    /// Draws over the picture in the bound target of this size, pixels, with its depths. What is not in `shown` is freed.
    void draw(const ViewScene& view, const DrawView& from, std::span<const ShownFigures> shown, const vec2& size,
              float pixel_ratio);

private:
    struct Buffers {
        std::shared_ptr<const FigureSet> set;
        struct Group {
            std::array<unsigned, 2> array{}; ///< of triangles, of lines
            std::array<unsigned, 2> buffer{};
        };
        std::vector<Group> groups;
    };
    const Buffers& buffers_of(const std::shared_ptr<const FigureSet>& set);
    void forget(const Buffers& buffers);

    Gl* gl_ = nullptr;
    std::unique_ptr<QOpenGLShaderProgram> fill_;
    std::unique_ptr<QOpenGLShaderProgram> line_;
    std::map<const FigureSet*, Buffers> uploaded_;
};

} // namespace atrium::ui
