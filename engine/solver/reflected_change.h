// How reflected light changes while objects move: what the leaves of the hierarchy say of it, on the vertices that are
// shown.
#pragma once

#include "engine/layers/layer_builder.h"
#include "engine/particles/particle_map.h"
#include "engine/radiosity/hierarchy.h"
#include "engine/raycast/ray_scene.h"

#include <memory>
#include <vector>

namespace atrium {

/// What is known of one vertex itself.
struct VertexChange {
    std::uint32_t vertex = 0;
    bool back = false;
    enum class Kind : std::uint8_t {
        Sight,  ///< `light` is what changed sight makes of its reflected light
        Whole,  ///< `light` is all of its reflected light
        Covered ///< something came to lie on it: it takes its neighbours' light
    };
    Kind kind = Kind::Sight;
    Rgb light{0.0F}; ///< lux
};

/// Starts from a complete solution, in which vertices are more exact than leaves: only differences of leaves are added to
/// them. Engine thread; parallel inside.
class ReflectedChange {
public:
    /// `hierarchy` solved, `layers` as they are shown (LayerSet::places kept). Both and `rays` are read here and in
    /// add_to().
    ReflectedChange(const Hierarchy& hierarchy, const RayScene& rays, const LayerSet& layers);

    /// Puts base irradiance + change of the leaves' irradiance on layers where it is more than a trace; the number of these.
    /// `beside` = per element, what of its leaves' irradiance changed sight made (empty: none); `known` = per layer,
    /// vertices that know better (empty: none), in order of vertex and side; `elsewhere` = what
    /// of the leaves' irradiance caustics show and vertices do not.
    std::size_t add_to(const Hierarchy& hierarchy, const std::vector<Rgb>& beside,
                       const std::vector<std::vector<VertexChange>>& known,
                       std::vector<std::shared_ptr<const SurfaceLayer>>& layers, const MattLight& elsewhere = {}) const;
    /// Elements and layers that are new stand at the end of `hierarchy` and `layers`, those from `first_layer` on, and no
    /// reflected light is known of them.
    void append(const Hierarchy& hierarchy, const RayScene& rays, const LayerSet& layers, std::size_t first_layer);
    /// Layers of such things, from `first` up to `last`, have another mesh now.
    void take_layers(const Hierarchy& hierarchy, const RayScene& rays, const LayerSet& layers, std::size_t first,
                     std::size_t last);
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    struct Side {
        std::vector<std::uint32_t> leaf; ///< element under each triangle's middle; kNone where there is none
        std::vector<Rgb> base;           ///< lux per vertex
    };
    struct Surface {
        Side front, back;
    };
    /// What the leaves say of the vertices of a layer's side, lux.
    struct OfVertex {
        Rgb before{0.0F}, now{0.0F};
        Rgb sight{0.0F};   ///< what of `now` comes from changed sight
        float area = 0.0F; ///< of the triangles around; 0 = nothing is known, or nothing changed
    };
    void take_layer(const Hierarchy& hierarchy, const RayScene& rays, const LayerSet& layers, std::size_t index);
    /// Per element: what changed sight makes of irradiance, and what is shown elsewhere; see add_to().
    struct OfLeaves {
        const std::vector<Rgb>& beside;
        const MattLight& elsewhere;
    };
    [[nodiscard]] std::vector<OfVertex> of_vertices(const Hierarchy& hierarchy, const OfLeaves& leaves,
                                                    const DisplayMesh& mesh, std::size_t layer, bool back) const;
    void changed(const Hierarchy& hierarchy, const OfLeaves& leaves, const DisplayMesh& mesh, std::size_t layer,
                 const std::vector<VertexChange>& known, bool back, std::vector<Rgb>& out) const;

    std::vector<Rgb> before_; ///< irradiance per element
    std::vector<Surface> surfaces_;
    float trace_ = 0.0F; ///< lux: less than this changes no picture
};

} // namespace atrium
