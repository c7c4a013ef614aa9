#include "ui/viewport/look_at.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace atrium::ui {
namespace {

constexpr double kUse = 0.9;      ///< of the view, for the box
constexpr double kGrazing = 0.25; ///< cosine to the normal below which a surface is hardly seen
constexpr double kUpright = 0.97; ///< of a direction's height, beyond which the camera has no horizon
constexpr double kStay = 1.3;     ///< what the present direction counts more
constexpr double kNearest = 0.05; ///< metres

/// As far away along `to_eye` as it takes to see the whole box.
double distance_for(const CameraController& now, const DBox3& box, const dvec3& focus, const dvec3& to_eye) {
    const dvec3 right = glm::normalize(glm::cross(dvec3(0, 1, 0), to_eye));
    const dvec3 up = glm::cross(to_eye, right);
    const double y = kUse * std::tan(0.5 * now.yfov()), x = y * now.width() / now.height();
    double out = kNearest;
    for (int i = 0; i < 8; ++i) {
        const dvec3 corner((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                           (i & 4) != 0 ? box.max.z : box.min.z);
        const dvec3 p = corner - focus;
        const double beside = std::max(std::abs(glm::dot(p, right)) / x, std::abs(glm::dot(p, up)) / y);
        out = std::max(out, beside + glm::dot(p, to_eye));
    }
    return out;
}

/// The present direction, then slants around the normal.
std::vector<dvec3> directions(const CameraController& now, const dvec3& normal) {
    std::vector<dvec3> out{-now.forward()};
    const dvec3 side = glm::normalize(glm::cross(normal, std::abs(normal.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
    const dvec3 other = glm::cross(normal, side);
    for (const double tilt : {0.5, 0.9}) {
        for (int i = 0; i < 8; ++i) {
            const double turn = 0.25 * kPiD * i;
            out.push_back(std::cos(tilt) * normal + std::sin(tilt) * (std::cos(turn) * side + std::sin(turn) * other));
        }
    }
    return out;
}

} // namespace

std::optional<ViewCamera> camera_towards(const CameraController& now, const ViewScene& view, const DBox3& box,
                                         const dvec3& focus, const dvec3& normal) {
    if (box.empty() || glm::length(normal) < 0.5) {
        return std::nullopt;
    }
    const dvec3 start = focus + normal * 1e-3 * std::max(box.diagonal(), 0.1); // clear of the surface itself
    const std::vector<dvec3> ways = directions(now, normal);
    dvec3 best(0.0);
    double best_distance = 0.0, best_score = 0.0;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const dvec3 way = glm::normalize(ways[i]);
        if (glm::dot(way, normal) < kGrazing || std::abs(way.y) > kUpright) {
            continue;
        }
        const double wanted = distance_for(now, box, focus, way);
        const auto hit = view.pick({start, way}, wanted);
        const double distance = hit ? 0.9 * hit->distance : wanted;
        // Little is gained by turning round further than one has to.
        const double score = distance / wanted * (i == 0 ? kStay : 0.8 - 0.2 * glm::dot(way, now.forward()));
        if (score > best_score) {
            best_score = score;
            best_distance = std::max(distance, kNearest);
            best = way;
        }
    }
    if (!(best_score > 0.0)) {
        return std::nullopt;
    }
    ViewCamera out = now.camera();
    out.to_world = glm::inverse(glm::lookAt(focus + best * best_distance, focus, dvec3(0, 1, 0)));
    return out;
}

} // namespace atrium::ui
