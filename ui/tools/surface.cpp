#include "ui/tools/surface.h"

#include "ui/tools/gizmo.h"

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr double kFarGround = 50.0; ///< metres
constexpr double kMostSunk = 0.3;   ///< metres that an object may stick in the floor and is lifted out
constexpr int kUndersideLines = 12; ///< in each direction
constexpr std::size_t kMostVertices = 600;
const dvec3 kUp(0, 1, 0);

/// Along one vertical line: heights where `item` is met, from `top` downwards or from `bottom` upwards.
std::optional<double> meet_vertical(const ViewItem& item, const dmat4& inverse, const dvec3& from, const dvec3& direction) {
    const auto hit = item.bvh->nearest(dvec3(inverse * dvec4(from, 1.0)), dvec3(inverse * dvec4(direction, 0.0)),
                                       std::numeric_limits<double>::infinity(), RaySides::Both);
    return hit ? std::optional(from.y + direction.y * hit->t) : std::nullopt;
}

} // namespace

std::optional<dmat4> placement_under(const ViewScene& view, const Ray& ray, Mount mount, const DBox3& bounds,
                                     const std::unordered_set<NodeId>& skip, double grid) {
    const PickRules rules{&skip, false};
    const PickRules all{&skip, true}; // a ceiling that is cut away is still there
    const double far = std::numeric_limits<double>::infinity();
    dvec3 point(0.0);
    dvec3 normal = kUp;
    if (const auto hit = view.pick(ray, far, rules)) {
        point = hit->point;
        normal = hit->normal;
    } else if (const auto ground = meet_plane(ray, dvec3(0.0), kUp);
               ground && glm::length(*ground - ray.origin) < kFarGround) {
        point = *ground;
    } else {
        return std::nullopt;
    }
    const auto stepped = [&](dvec3 p) {
        if (grid > 0 && std::abs(normal.y) > 0.99) {
            p.x = std::round(p.x / grid) * grid;
            p.z = std::round(p.z / grid) * grid;
        }
        return p;
    };
    if (mount == Mount::Ceiling && normal.y > -0.7) {
        const auto above = view.pick({point + normal * 0.05, kUp}, far, all);
        if (above && above->normal.y < -0.7) {
            point = above->point;
            normal = above->normal;
        }
    }
    if (mount == Mount::Stand && normal.y < 0.5 && !bounds.empty()) {
        // Against a wall, or under a ceiling: down to what is below its middle.
        const dvec3 half = 0.5 * (bounds.max - bounds.min);
        const dvec3 level(normal.x, 0.0, normal.z);
        const dvec3 away = glm::length(level) > 0.5 ? glm::normalize(level) : dvec3(0.0);
        const dvec3 middle = point + away * (glm::dot(half, glm::abs(away)) + 1e-3);
        const auto floor = view.pick({middle + normal * 1e-3, -kUp}, far, all);
        if (!floor) {
            return place_on(bounds, mount, point, normal);
        }
        return place_on(bounds, mount, floor->point, kUp);
    }
    if (mount == Mount::Stand) {
        normal = kUp; // on a slope it stands upright, its middle on the point
    }
    return place_on(bounds, mount, stepped(point), normal);
}

std::optional<double> fall_distance(const ViewScene& view, const Scene& scene, NodeId node) {
    std::unordered_set<NodeId> own;
    for (const NodeId id : scene.in_tree_order(node)) {
        own.insert(id);
    }
    DBox3 box;
    std::vector<std::pair<const ViewItem*, dmat4>> mine;
    for (const ViewItem& item : view.items()) {
        if (own.contains(item.node) && !item.flattened) {
            box.add(item.bounds);
            mine.emplace_back(&item, glm::inverse(item.world));
        }
    }
    if (mine.empty()) {
        return std::nullopt;
    }
    std::vector<std::pair<const ViewItem*, dmat4>> below;
    const double start = std::min(0.25 * (box.max.y - box.min.y), kMostSunk);
    for (const ViewItem& item : view.items()) {
        const bool beside = item.bounds.max.x < box.min.x || item.bounds.min.x > box.max.x ||
                            item.bounds.max.z < box.min.z || item.bounds.min.z > box.max.z;
        if (!own.contains(item.node) && !item.flattened && !beside && item.bounds.min.y < box.min.y + start) {
            below.emplace_back(&item, glm::inverse(item.world));
        }
    }
    // Points of the underside: vertices near the lowest one, which are legs and feet, and a grid of lines for what
    // lies between them.
    std::vector<dvec3> points;
    const double low = box.min.y + std::max(0.05 * (box.max.y - box.min.y), 1e-4);
    for (const auto& [item, inverse] : mine) {
        const auto& positions = item->mesh->positions;
        const std::size_t step = 1 + positions.size() / kMostVertices;
        for (std::size_t i = 0; i < positions.size(); i += step) {
            const dvec3 p(item->world * dvec4(dvec3(positions[i]), 1.0));
            if (p.y <= low) {
                // A hair towards the middle: feet that end where a table does still stand on it.
                const dvec3 inwards = glm::mix(p, box.centre(), 1e-4);
                points.emplace_back(inwards.x, p.y, inwards.z);
            }
        }
    }
    for (int i = 0; i < kUndersideLines; ++i) {
        for (int k = 0; k < kUndersideLines; ++k) {
            const dvec3 from(glm::mix(box.min.x, box.max.x, (i + 0.5) / kUndersideLines), box.min.y - 1.0,
                             glm::mix(box.min.z, box.max.z, (k + 0.5) / kUndersideLines));
            std::optional<double> lowest;
            for (const auto& [item, inverse] : mine) {
                const auto y = meet_vertical(*item, inverse, from, kUp);
                if (y && (!lowest || *y < *lowest)) {
                    lowest = y;
                }
            }
            if (lowest) {
                points.emplace_back(from.x, *lowest, from.z);
            }
        }
    }
    std::optional<double> fall;
    for (const dvec3& p : points) {
        for (const auto& [item, inverse] : below) {
            // Lines start a little above the point, for what sticks in the floor.
            const auto y = meet_vertical(*item, inverse, p + kUp * start, -kUp);
            if (y && (!fall || p.y - *y < *fall)) {
                fall = p.y - *y;
            }
        }
    }
    return fall;
}

} // namespace atrium::ui
