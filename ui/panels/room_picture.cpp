#include "ui/panels/room_picture.h"

#include "ui/panels/raster_picture.h"

#include <cmath>

namespace atrium::ui {
namespace {

constexpr float kPane = 0.5F; ///< how much of a pane is seen, and not what is behind it

QRgb shaded(const Material& material, const dvec3& normal, const dvec3& to_eye) {
    const float alpha = material.transmission > kPane ? kPane : 1.0F;
    if (material.emits()) {
        const Rgb light = material.emitted_radiance();
        return display_rgb(glm::mix(light / max_component(light), Rgb(1.0F), 0.5F), alpha);
    }
    static const dvec3 kKey = glm::normalize(dvec3(0.45, 0.8, 0.6));
    const double lit = 0.42 + 0.22 * std::abs(glm::dot(normal, kKey)) + 0.26 * std::abs(glm::dot(normal, to_eye)) +
                       0.1 * std::max(0.0, normal.y);
    return display_rgb(material.base_color * float(lit), alpha);
}

} // namespace

QImage room_picture(const Scene& scene, const ViewCamera& camera, QSize size) {
    RasterCamera view;
    view.to_view = glm::inverse(camera.to_world);
    view.pixels = 0.5 * size.height() / std::tan(0.5 * double(camera.lens.yfov));
    constexpr QRgb kOutOfTheWindow = qRgb(206, 214, 224);
    return raster_picture(scene, view, size, kOutOfTheWindow, shaded);
}

} // namespace atrium::ui
