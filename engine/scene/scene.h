// The document's value: nodes, shapes, materials, lights, cameras with stable ids. No Qt, no threads.
#pragma once

#include "engine/base/ids.h"
#include "engine/base/math.h"
#include "engine/scene/caustic_wish.h"
#include "engine/scene/light.h"
#include "engine/scene/material.h"
#include "engine/scene/shape.h"
#include "engine/scene/solver_thresholds.h"

#include <memory>
#include <string>
#include <vector>

namespace atrium {

/// Placement in the parent's space: translate * rotate * scale. Doubles, so that survey coordinates survive.
struct Transform {
    dvec3 translation{0.0};
    dquat rotation{1.0, 0.0, 0.0, 0.0}; ///< w, x, y, z; unit
    dvec3 scale{1.0};
    [[nodiscard]] dmat4 matrix() const;
    friend bool operator==(const Transform&, const Transform&) = default;
};

struct Node;
using NodeId = Id<Node>;

/// One object of the scene tree. Order of children is the user's and is kept.
struct Node {
    std::string name;
    NodeId parent; ///< none = a root
    std::vector<NodeId> children;
    Transform transform;
    ShapeId shape;                     ///< none = a group, light or camera
    std::vector<MaterialId> materials; ///< one per part of the shape; none = the default material
    LightId light;
    CameraId camera;
    bool visible = true; ///< hidden nodes (and all below them) take no part in the light
    bool locked = false;
    std::string extras;   ///< JSON text of the file's own extras
    CausticWish caustics; ///< on its own shape
    friend bool operator==(const Node&, const Node&) = default;
};

/// Wishes about the solution that belong to the project (CONTRACTS: solver settings are edits and bump the revision).
struct SolverSettings {
    enum class Quality : std::uint8_t { Draft, Normal, Fine };
    Quality quality = Quality::Normal;
    std::uint32_t seed = 1;
    SolverThresholds thresholds; ///< set by hand; all automatic at first
    friend bool operator==(const SolverSettings&, const SolverSettings&) = default;
};

/// The whole document as a value. Meshes and images are shared, so a copy is cheap next to a solution.
/// Change it only through SceneEdit (scene_edit.h), or while building it before it is anyone's document.
struct Scene {
    std::string name;
    std::vector<NodeId> roots; ///< in file order
    SlotMap<Node> nodes;
    SlotMap<Shape> shapes;
    SlotMap<Material> materials;
    SlotMap<Texture> textures;
    SlotMap<Light> lights;
    SlotMap<Camera> cameras;
    Environment environment;
    SolverSettings settings;
    std::string extras;       ///< of the glTF root
    std::string asset_extras; ///< copyright, generator and extras of the file's `asset`, JSON text

    /// World matrix of a node (product of the transforms from its root); identity for none.
    [[nodiscard]] dmat4 world_matrix(NodeId id) const;
    /// True when the node and all its ancestors are visible.
    [[nodiscard]] bool shown(NodeId id) const;
    /// Material of a part, or nullptr for the default material.
    [[nodiscard]] const Material* material_of(const Node& node, std::size_t part) const;
    /// World bounds of a node's own shape; empty without one.
    [[nodiscard]] DBox3 world_bounds(NodeId id) const;
    /// World bounds of a node and everything below it.
    [[nodiscard]] DBox3 subtree_bounds(NodeId id) const;
    /// World bounds of all shown shapes.
    [[nodiscard]] DBox3 bounds() const;
    /// Depth-first list of nodes in tree order, starting below `root` (none = all roots), including `root` itself.
    [[nodiscard]] std::vector<NodeId> in_tree_order(NodeId root = {}) const;

    friend bool operator==(const Scene&, const Scene&) = default;
};

/// Material used where a part has none: glTF's default is white; diffuse, reflectance 0.8 here as everywhere in practice.
const Material& default_material();

/// Nearest TRS to a matrix. `exact` (may be null) tells whether the matrix had no shear, so nothing was lost.
Transform decompose(const dmat4& matrix, bool* exact = nullptr);

} // namespace atrium
