#include "engine/radiosity/lamp_reach.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr float kRounding = 1e-3F; // metres and radians

// Half angle of the cone from a point around a ball, radians; pi from within it.
float half_angle(float radius, float distance) {
    return distance > radius ? std::asin(std::min(radius / distance, 1.0F)) : kPi;
}

float angle_between(const vec3& a, const vec3& b) {
    const float length = glm::length(a) * glm::length(b);
    return length > 0.0F ? std::acos(std::clamp(glm::dot(a, b) / length, -1.0F, 1.0F)) : 0.0F;
}

} // namespace

float most_light(const PlacedLight& lamp, const vec3& point, float radius, const vec3& normal) {
    const Light& light = lamp.light;
    const float full = max_component(light.color) * light.intensity;
    const bool plane = normal != vec3(0.0F);
    if (light.kind == Light::Kind::Directional) {
        const float spread = std::tan(float(radians_from_degrees(0.5 * light.angular_diameter_degrees)));
        return plane && -glm::dot(normal, lamp.axis) < -spread - kRounding ? 0.0F : full;
    }
    const vec3 to_lamp = lamp.position - point;
    const float distance = glm::length(to_lamp);
    const float height = plane ? glm::dot(normal, to_lamp) : distance;
    if (height < -kRounding) {
        return 0.0F;
    }
    if (light.kind == Light::Kind::Spot && light_distribution(light) == nullptr &&
        angle_between(lamp.axis, -to_lamp) > light.outer_cone + half_angle(radius, distance) + kRounding) {
        return 0.0F;
    }
    const float near = std::max(distance - radius, kRounding);
    const float cosine = plane ? std::min(std::max(height, kRounding) / near, 1.0F) : 1.0F;
    return full * cosine / (near * near);
}

float most_light_over(const PlanarMirror& mirror, const PlacedLight& lamp, const vec3& point, float radius,
                      const vec3& normal) {
    vec3 centre(0.0F);
    for (const vec3& c : mirror.corner) {
        centre += 0.25F * c;
    }
    float size = 0.0F;
    for (const vec3& c : mirror.corner) {
        size = std::max(size, glm::length(c - centre));
    }
    if (!mirror.both_sides && mirror.height(point) < -radius) {
        return 0.0F;
    }
    PlacedLight image = lamp;
    image.position = mirror.reflect_point(lamp.position);
    image.axis = mirror.reflect_direction(lamp.axis);
    if (lamp.light.kind == Light::Kind::Directional) {
        const vec3 d = point - centre;
        const float along = glm::dot(d, image.axis);
        const float spread = std::tan(float(radians_from_degrees(0.5 * lamp.light.angular_diameter_degrees)));
        const float off = glm::length(d - along * image.axis);
        if (along < -radius - size || off > radius + size + spread * (std::abs(along) + radius) + kRounding) {
            return 0.0F;
        }
        return most_light(image, point, radius, normal);
    }
    // The image shines through the mirror as through a window.
    const vec3 to_window = centre - image.position, to_point = point - image.position;
    if (angle_between(to_window, to_point) >
        half_angle(size, glm::length(to_window)) + half_angle(radius, glm::length(to_point)) + kRounding) {
        return 0.0F;
    }
    return most_light(image, point, radius, normal);
}

} // namespace atrium
