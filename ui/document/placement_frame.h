// Where nodes are, in metres whatever the scales of the groups above them, and how to put them elsewhere.
#pragma once

#include "engine/scene/scene_edit.h"

#include <functional>
#include <vector>

namespace atrium::ui {

/// The axes and the origin that a placement is told from.
enum class PlacementFrame : std::uint8_t {
    World, ///< the scene's origin and axes
    Parent ///< origin and axes of the group that the node is in; the scene's for a root
};

/// Lengths are world metres in both frames: those of the parent's frame run along its axes.
struct FramedPlacement {
    dvec3 position{0.0};
    dquat rotation{1.0, 0.0, 0.0, 0.0};
};

/// The node must exist. Below a group of uneven scales the rotation is that of the nearest unsheared one.
FramedPlacement placement_in(const Scene& scene, NodeId id, PlacementFrame frame);

/// Gives every node what `change` makes of its placement. A node whose group is among them, too, is placed after it, so
/// that all stand where they were put. What `change` leaves alone stays to the last bit.
SceneEdit place_nodes(const Scene& scene, const std::vector<NodeId>& nodes, PlacementFrame frame,
                      const std::function<void(FramedPlacement&, NodeId)>& change);

} // namespace atrium::ui
