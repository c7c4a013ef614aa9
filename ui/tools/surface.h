// Where on the shown surfaces an object goes: under a ray, or straight down.
#pragma once

#include "ui/document/placement.h"
#include "ui/viewport/view_scene.h"

#include <optional>
#include <unordered_set>

namespace atrium::ui {

/// World placement of an object with these bounds (its own coordinates, +y away from the surface) at what the ray meets,
/// `skip` left out: ceiling lamps go to the ceiling above, what stands goes to the floor below or to the foot of a wall.
/// The ground y = 0 counts where nothing is met. `grid` above 0 rounds the place on floors and ceilings to its steps.
std::optional<dmat4> placement_under(const ViewScene& view, const Ray& ray, Mount mount, const DBox3& bounds,
                                     const std::unordered_set<NodeId>& skip, double grid);

/// Metres that a node with all below it falls until it rests on something else; negative where its lowest part sticks in
/// a surface. None with nothing below. Looks along vertical lines from its lowest vertices and from its underside.
std::optional<double> fall_distance(const ViewScene& view, const Scene& scene, NodeId node);

} // namespace atrium::ui
