// What has no surface of its own: lights, cameras, the axes in the corner, the grid of an empty document.
#pragma once

#include "ui/viewport/overlay_batch.h"
#include "ui/viewport/view_scene.h"

#include <functional>
#include <vector>

namespace atrium::ui {

/// A light or camera of the scene, drawn as a small figure that can be picked.
struct Marker {
    enum class Kind : std::uint8_t { Point, Spot, Sun, Camera };
    NodeId node;
    Kind kind = Kind::Point;
    dvec3 position{0.0};
    dmat3 axes{1.0};    ///< shines or looks along -axes[2]
    double angle = 0.0; ///< spot: outer half angle; camera: half the vertical field of view
    vec3 color{1.0F};
    Photometry photometry; ///< drawn as a small solid while the lamp is selected
    bool enabled = true;
    bool hidden_behind = false; ///< a surface lies between it and the eye
};

/// Markers of all shown light and camera nodes.
std::vector<Marker> find_markers(const Scene& scene);
/// Fills in what lies behind surfaces, seen from the camera.
void find_hidden(std::vector<Marker>& markers, const ViewScene& view, const CameraController& camera);
/// Marker under a screen point, nearest first; one behind a surface only counts while selected.
const Marker* marker_at(const std::vector<Marker>& markers, const CameraController& camera, const dvec2& point,
                        const std::function<bool(NodeId)>& selected);
void draw_markers(OverlayBatch& batch, const std::vector<Marker>& markers, const CameraController& camera,
                  const std::function<bool(NodeId)>& selected, NodeId hovered);
/// Directions of x, y and z in the lower left corner.
void draw_axes(OverlayBatch& batch, const CameraController& camera);
/// Metre grid on y = 0 for an empty document.
void draw_grid(OverlayBatch& batch, const CameraController& camera);

} // namespace atrium::ui
