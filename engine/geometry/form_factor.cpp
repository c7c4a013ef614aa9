#include "engine/geometry/form_factor.h"

#include "engine/base/checks.h"

#include <algorithm>
#include <array>

namespace atrium {

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
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const dvec3& a = clipped[i];
        const dvec3& b = clipped[(i + 1) % count];
        const dvec3 c = glm::cross(a, b);
        const double length = glm::length(c);
        if (length > 0.0) {
            sum += std::atan2(length, glm::dot(a, b)) * glm::dot(n, c) / length;
        }
    }
    // Orientation of the corners only decides the sign.
    return std::clamp(std::abs(sum) / (2.0 * kPiD), 0.0, 1.0);
}

} // namespace atrium
