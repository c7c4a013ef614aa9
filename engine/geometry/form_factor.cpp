#include "engine/geometry/form_factor.h"

#include "engine/base/checks.h"

#include <algorithm>
#include <array>

namespace atrium {
namespace {

// Angle between a and b over the length of their cross product; `inverse` = 1 / (|a| |b|).
double angle_over_cross(const dvec3& a, const dvec3& b, const dvec3& cross, double inverse) {
    constexpr double kSmall = 0.06; // squared sine: the series is off by less than 1e-9 of the angle below it
    const double length2 = glm::dot(cross, cross), along = glm::dot(a, b);
    const double q = length2 * inverse * inverse;
    if (along > 0.0 && q < kSmall) {
        // Most edges of most polygons: the arc sine's series needs no arc tangent.
        return inverse *
               (1.0 + q * (1.0 / 6 +
                           q * (3.0 / 40 + q * (5.0 / 112 + q * (35.0 / 1152 + q * (63.0 / 2816 + q * 231.0 / 13312))))));
    }
    const double length = std::sqrt(length2);
    return length > 0.0 ? std::atan2(length, along) / length : 0.0;
}

} // namespace

double form_factor_to_polygon(const vec3& point, const vec3& normal, std::span<const vec3> polygon) {
    constexpr std::size_t kMaxCorners = 12;
    ATRIUM_CHECK(polygon.size() <= kMaxCorners);
    const dvec3 n(normal);
    std::array<dvec3, kMaxCorners> corner;
    std::array<double, kMaxCorners> height{};
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        corner[i] = dvec3(polygon[i]) - dvec3(point);
        height[i] = glm::dot(corner[i], n);
    }
    // Sutherland-Hodgman against the horizon; a convex polygon gains at most one corner.
    std::array<dvec3, kMaxCorners + 1> clipped;
    std::size_t count = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t j = (i + 1) % polygon.size();
        if (height[i] >= 0.0) {
            clipped[count++] = corner[i];
        }
        if ((height[i] > 0.0 && height[j] < 0.0) || (height[i] < 0.0 && height[j] > 0.0)) {
            clipped[count++] = corner[i] + (corner[j] - corner[i]) * (height[i] / (height[i] - height[j]));
        }
        if (count == clipped.size()) {
            break;
        }
    }
    if (count < 3) {
        return 0.0;
    }
    std::array<double, kMaxCorners + 1> inverse; // of the corners' distances
    for (std::size_t i = 0; i < count; ++i) {
        inverse[i] = 1.0 / glm::length(clipped[i]);
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t j = (i + 1) % count;
        const dvec3 c = glm::cross(clipped[i], clipped[j]);
        sum += glm::dot(n, c) * angle_over_cross(clipped[i], clipped[j], c, inverse[i] * inverse[j]);
    }
    // Orientation of the corners only decides the sign.
    return std::clamp(std::abs(sum) / (2.0 * kPiD), 0.0, 1.0);
}

} // namespace atrium
