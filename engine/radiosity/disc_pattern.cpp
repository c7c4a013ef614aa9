#include "engine/radiosity/disc_pattern.h"

#include <algorithm>

namespace atrium {
namespace {

std::vector<vec2> make_pattern(unsigned count) {
    std::vector<vec2> points(count);
    for (unsigned i = 0; i < count; ++i) {
        const float r = std::sqrt((float(i) + 0.5F) / float(count));
        const float angle = 2.39996323F * float(i); // the golden angle
        points[i] = {r * std::cos(angle), r * std::sin(angle)};
    }
    // The outermost first; then always the one farthest from those taken.
    std::reverse(points.begin(), points.end());
    std::vector<float> distance(count, std::numeric_limits<float>::infinity());
    for (unsigned taken = 1; taken < count; ++taken) {
        unsigned best = taken;
        for (unsigned i = taken; i < count; ++i) {
            const vec2 d = points[i] - points[taken - 1];
            distance[i] = std::min(distance[i], glm::dot(d, d));
            best = distance[i] > distance[best] ? i : best;
        }
        std::swap(points[taken], points[best]);
        std::swap(distance[taken], distance[best]);
    }
    return points;
}

} // namespace

const std::vector<vec2>& disc_pattern(unsigned count) {
    thread_local std::vector<vec2> points;
    if (points.size() != count) {
        points = make_pattern(count);
    }
    return points;
}

} // namespace atrium
