#include "ui/panels/thumbnail.h"

#include "ui/panels/raster_picture.h"

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr int kOversampling = 2;

Rgb shaded(const Material& material, const dvec3& normal) {
    if (material.emits()) {
        const Rgb light = material.emitted_radiance();
        return glm::mix(light / max_component(light), Rgb(1.0F), 0.4F);
    }
    static const dvec3 kKey = glm::normalize(dvec3(0.5, 0.9, 0.7));
    const double lit = 0.35 + 0.6 * std::max(0.0, glm::dot(normal, kKey)) + 0.15 * std::max(0.0, normal.y);
    return material.base_color * float(lit);
}

/// What a ray into the little world of the material balls meets when nothing is in its way.
Rgb surroundings(const dvec3& from, const dvec3& direction) {
    if (direction.y < -1e-6) {
        const dvec3 p = from + direction * ((-1.0 - from.y) / direction.y);
        const bool odd = ((int(std::floor(p.x * 1.6)) + int(std::floor(p.z * 1.6))) & 1) != 0;
        const double far = std::exp(-0.12 * glm::length(p));
        return glm::mix(Rgb(0.45F), odd ? Rgb(0.75F) : Rgb(0.2F), float(far));
    }
    const bool window = direction.y > 0.45 && direction.y < 0.8 && direction.x < -0.15 && direction.x > -0.6;
    return window ? Rgb(2.5F) : Rgb(0.45F + 0.3F * float(direction.y));
}

Rgb ball(const Material& material, const dvec3& eye, const dvec3& ray, const dvec3& point) {
    const dvec3& n = point; // unit ball about the origin
    const double cosine = std::max(0.0, -glm::dot(n, ray));
    const dvec3 mirrored = ray + n * (2.0 * cosine);
    const float edge = std::pow(1.0F - float(cosine), 5.0F);
    const float blur = std::clamp(material.roughness * 2.0F, 0.0F, 1.0F);
    const Rgb seen = glm::mix(surroundings(point, mirrored), Rgb(0.55F), blur);
    if (material.metallic > 0.5F) {
        const Rgb f = material.base_color + (Rgb(1.0F) - material.base_color) * edge;
        return f * glm::mix(seen, Rgb(float(0.3 + 0.8 * std::max(0.0, glm::dot(n, glm::normalize(dvec3(-0.4, 0.8, 0.6)))))),
                            blur * 0.6F);
    }
    const float fresnel = 0.04F + 0.96F * edge;
    Rgb body = shaded(material, n) * (1.0F - material.transmission);
    if (material.transmission > 0.0F) {
        // A pane goes straight on; a solid ball turns the picture upside down.
        const dvec3 on = material.thickness > 0.0F ? glm::normalize(ray - n * 0.75 * cosine - point * 0.4) : ray;
        body += material.transmission * material.base_color * glm::mix(surroundings(eye, on), Rgb(0.6F), blur);
    }
    return body + fresnel * seen * (1.0F - 0.7F * blur);
}

} // namespace

QImage material_thumbnail(const Material& material, int size) {
    const int side = size * kOversampling;
    QImage image(side, side, QImage::Format_ARGB32);
    const dvec3 eye(0.0, 0.9, 5.0);
    const dvec3 forward = glm::normalize(-eye);
    const dvec3 right(1, 0, 0);
    const dvec3 up = glm::cross(right, forward);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double u = (x + 0.5) / side * 2 - 1;
            const double v = 1 - (y + 0.5) / side * 2;
            const dvec3 ray = glm::normalize(forward + 0.235 * (u * right + v * up));
            const double b = glm::dot(eye, ray);
            const double c = glm::dot(eye, eye) - 1.0;
            const double d = b * b - c;
            image.setPixel(
                x, y,
                display_rgb(d > 0 ? ball(material, eye, ray, eye + ray * (-b - std::sqrt(d))) : surroundings(eye, ray)));
        }
    }
    return image.scaled(size, size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

QImage object_thumbnail(const Scene& scene, int size) {
    const DBox3 bounds = scene.bounds();
    if (bounds.empty()) {
        QImage nothing(size, size, QImage::Format_ARGB32_Premultiplied);
        nothing.fill(Qt::transparent);
        return nothing;
    }
    const dvec3 towards = glm::normalize(dvec3(0.55, 0.5, 1.0)); // from the object to the eye
    const dvec3 right = glm::normalize(glm::cross(dvec3(0, 1, 0), towards));
    const dvec3 up = glm::cross(towards, right);
    const dvec3 half = 0.5 * (bounds.max - bounds.min);
    const double reach = std::max({glm::dot(half, glm::abs(right)), glm::dot(half, glm::abs(up)), 1e-6}) * 1.08;
    RasterCamera camera;
    camera.perspective = false;
    camera.pixels = 0.5 * size / reach;
    camera.to_view = glm::inverse(dmat4(dvec4(right, 0), dvec4(up, 0), dvec4(towards, 0), dvec4(bounds.centre(), 1)));
    return raster_picture(scene, camera, {size, size}, qRgba(0, 0, 0, 0),
                          [](const Material& material, const dvec3& normal, const dvec3& to_eye) {
                              return display_rgb(shaded(material, glm::dot(normal, to_eye) < 0 ? -normal : normal),
                                                 1.0F - 0.6F * material.transmission);
                          });
}

} // namespace atrium::ui
