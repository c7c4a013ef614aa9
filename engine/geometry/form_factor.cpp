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

// For at most N corners: most polygons have three or four, and room for more would cost as much as the sum.
template <std::size_t N> double form_factor(const dvec3& point, const dvec3& n, std::span<const vec3> polygon) {
    std::array<dvec3, N + 1> corner;
    std::array<double, N + 1> height{};
    std::size_t count = polygon.size();
    bool cut = false;
    for (std::size_t i = 0; i < count; ++i) {
        corner[i] = dvec3(polygon[i]) - point;
        height[i] = glm::dot(corner[i], n);
        cut = cut || height[i] < 0.0;
    }
    if (cut) {
        // Sutherland-Hodgman against the horizon; a convex polygon gains at most one corner.
        std::array<dvec3, N + 1> clipped;
        count = 0;
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
        corner = clipped;
    }
    if (count < 3) {
        return 0.0;
    }
    std::array<double, N + 1> inverse; // of the corners' distances
    for (std::size_t i = 0; i < count; ++i) {
        inverse[i] = 1.0 / glm::length(corner[i]);
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t j = i + 1 < count ? i + 1 : 0;
        const dvec3 c = glm::cross(corner[i], corner[j]);
        sum += glm::dot(n, c) * angle_over_cross(corner[i], corner[j], c, inverse[i] * inverse[j]);
    }
    // Orientation of the corners only decides the sign.
    return std::clamp(std::abs(sum) / (2.0 * kPiD), 0.0, 1.0);
}

} // namespace

double form_factor_to_polygon(const vec3& point, const vec3& normal, std::span<const vec3> polygon) {
    constexpr std::size_t kMaxCorners = 12;
    ATRIUM_CHECK(polygon.size() <= kMaxCorners);
    return polygon.size() <= 4 ? form_factor<4>(dvec3(point), dvec3(normal), polygon)
                               : form_factor<kMaxCorners>(dvec3(point), dvec3(normal), polygon);
}

} // namespace atrium
