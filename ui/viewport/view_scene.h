// What the viewport shows, without GL: every shown (node, part) with its mesh, light and place. Also answers picks.
#pragma once

#include "engine/scene/scene_edit.h"
#include "engine/solver/solution.h"
#include "ui/viewport/camera_controller.h"
#include "ui/viewport/cutaway.h"
#include "ui/viewport/mesh_bvh.h"

#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace atrium::ui {

/// One surface to draw.
struct ViewItem {
    NodeId node;
    std::uint32_t part = 0;
    ShapeId shape;
    std::shared_ptr<const DisplayMesh> mesh;   ///< never null, may be empty
    std::shared_ptr<const SurfaceLayer> layer; ///< null = not lit yet
    std::shared_ptr<const MeshBvh> bvh;
    const Material* material = nullptr; ///< never null; owned by the scene, good until the next edit
    dmat4 world{1.0};
    DBox3 bounds;           ///< of the mesh in the world
    bool mirrored = false;  ///< the world matrix turns the winding round
    bool flattened = false; ///< the world matrix has no inverse: cannot be picked
};

/// What a ray met.
struct PickHit {
    NodeId node;
    std::uint32_t part = 0;
    double distance = 0; ///< metres along the ray
    dvec3 point{0.0};
    dvec3 normal{0.0, 1.0, 0.0}; ///< geometric, unit, towards the ray's origin
    std::uint32_t triangle = 0;  ///< of the item's mesh
    bool front = true;           ///< its front side was met
};

/// What a pick leaves out.
struct PickRules {
    const std::unordered_set<NodeId>* skip = nullptr; ///< nodes that rays go through; may be null
    bool through_cutaway = false;                     ///< also hit what is cut away from the picture
};

/// UI thread only (hierarchies are built on pool threads).
class ViewScene {
public:
    /// Forgets everything: another document.
    void clear();
    /// Notes an edit that was just applied as document revision `revision`: shapes that changed are shown unlit until a
    /// solution of that revision comes.
    void note_edit(const Scene& scene, const SceneEdit& edit, std::uint64_t revision);
    /// Brings the items up to date with scene and solution (may be null). Meshes, layers and hierarchies are shared while
    /// their pointers stay the same.
    void sync(const Scene& scene, const std::shared_ptr<const Solution>& solution);

    /// What pick() and the picture leave out; good until the next call.
    void set_cutaway(const Cutaway& cutaway) { cutaway_ = cutaway; }
    [[nodiscard]] const Cutaway& cutaway() const { return cutaway_; }

    /// Shows only these nodes from the next sync() on; none = everything. The light stays that of the whole scene.
    void set_isolated(std::optional<std::unordered_set<NodeId>> nodes) { isolated_ = std::move(nodes); }
    [[nodiscard]] const std::optional<std::unordered_set<NodeId>>& isolated() const { return isolated_; }

    [[nodiscard]] const std::vector<ViewItem>& items() const { return items_; }
    /// Nearest visible surface; back sides of single-sided materials are not drawn and not hit. Blended and cut-out parts
    /// count as solid.
    [[nodiscard]] std::optional<PickHit> pick(const Ray& ray, double max_distance = std::numeric_limits<double>::infinity(),
                                              const PickRules& rules = {}) const;

private:
    struct CachedMesh {
        std::shared_ptr<const DisplayMesh> mesh;
        std::shared_ptr<const MeshBvh> bvh;
    };
    std::shared_ptr<const MeshBvh> bvh_of(const std::shared_ptr<const DisplayMesh>& mesh);
    void forget_shape(const Scene& scene, ShapeId shape, std::uint64_t revision);

    std::vector<ViewItem> items_;
    Cutaway cutaway_;
    std::optional<std::unordered_set<NodeId>> isolated_;
    std::map<std::pair<ShapeId, std::uint32_t>, CachedMesh> unlit_;
    std::unordered_map<const DisplayMesh*, std::shared_ptr<const MeshBvh>> bvhs_;
    std::unordered_map<NodeId, std::uint64_t> valid_from_; ///< layers of older solutions show an older shape
};

} // namespace atrium::ui
