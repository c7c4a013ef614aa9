// A solution's display meshes as a scene that rays can meet and read light from.
#pragma once

#include "engine/raycast/ray_scene.h"
#include "engine/solver/solution.h"

#include <map>
#include <memory>
#include <vector>

namespace atrium {

/// Immutable; safe from any thread. Keeps shared references to the layers it was made from.
class LitScene {
public:
    LitScene(const Scene& scene, const Solution& solution);

    [[nodiscard]] const RayScene& rays() const { return *rays_; }
    /// Irradiance on the side of the surface that the ray met, lux; zero where the solution knows none.
    [[nodiscard]] Rgb irradiance(const Hit& hit, const LightShares& shares = {}) const;
    /// What the side that the ray met sends out by itself and by scattering the light on it, cd/m2; the same in all
    /// directions.
    [[nodiscard]] Rgb radiance(const Hit& hit) const;

private:
    struct Part {
        std::shared_ptr<const SurfaceLayer> layer;
        std::uint32_t first_vertex = 0;
    };
    std::map<NodeId, std::vector<Part>> parts_;
    std::unique_ptr<RayScene> rays_;
};

} // namespace atrium
