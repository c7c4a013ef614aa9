// Scenes as small pictures without GL and without light: triangles filled on the processor.
#pragma once

#include "engine/scene/scene.h"

#include <QImage>

#include <functional>

namespace atrium::ui {

/// Looks along -z of its own axes, x to the right.
struct RasterCamera {
    dmat4 to_view{1.0};      ///< from the world to the camera's axes
    double pixels = 1.0;     ///< of the picture to a metre: everywhere, or with perspective a metre before the eye
    bool perspective = true; ///< else all rays are parallel
};

/// Colour of one face for its material, its unit normal (as its corners turn) and the unit direction to the eye. Where its
/// alpha is below 255 what is behind shines through.
using FaceShader = std::function<QRgb(const Material& material, const dvec3& normal, const dvec3& to_eye)>;

/// The shown shapes of a scene. The same scene, camera and shader give the same picture. Any thread; time grows with the
/// number of triangles.
QImage raster_picture(const Scene& scene, const RasterCamera& camera, QSize size, QRgb background, const FaceShader& shader);

/// Linear colour as the screen shows it.
QRgb display_rgb(const Rgb& linear, float alpha = 1.0F);

} // namespace atrium::ui
