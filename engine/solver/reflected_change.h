// How reflected light changes while objects move: what the leaves of the hierarchy say of it, on the vertices that are
// shown.
#pragma once

#include "engine/layers/layer_builder.h"
#include "engine/radiosity/hierarchy.h"
#include "engine/raycast/ray_scene.h"

#include <memory>
#include <vector>

namespace atrium {

/// Starts from a complete solution, in which vertices are more exact than leaves: only differences of leaves are added to
/// them. Engine thread; parallel inside.
class ReflectedChange {
public:
    /// `hierarchy` solved, `layers` as they are shown (LayerSet::places kept). Both and `rays` are read here and in
    /// add_to().
    ReflectedChange(const Hierarchy& hierarchy, const RayScene& rays, const LayerSet& layers);

    /// Puts base irradiance + change of the leaves' irradiance on layers where it is more than a trace; the number of these.
    std::size_t add_to(const Hierarchy& hierarchy, std::vector<std::shared_ptr<const SurfaceLayer>>& layers) const;
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    struct Side {
        std::vector<std::uint32_t> leaf; ///< element under each triangle's middle; kNone where there is none
        std::vector<Rgb> base;           ///< lux per vertex
    };
    struct Surface {
        Side front, back;
    };
    static bool changed(const Hierarchy& hierarchy, const std::vector<Rgb>& before, const DisplayMesh& mesh,
                        const Side& side, float trace, std::vector<Rgb>& out);

    std::vector<Rgb> before_; ///< irradiance per element
    std::vector<Surface> surfaces_;
    float trace_ = 0.0F; ///< lux: less than this changes no picture
};

} // namespace atrium
