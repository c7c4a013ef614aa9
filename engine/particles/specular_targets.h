// What particles are aimed at: mirrors, polished metal and glass, in compact pieces.
#pragma once

#include "engine/raycast/ray_scene.h"

#include <vector>

namespace atrium {

/// A compact piece of specular surface with the bounds that particles are aimed at.
struct SpecularTarget {
    Box3 bounds; ///< engine coordinates
    float area = 0.0F;
    std::uint32_t surface = 0; ///< of RayScene::surfaces(): of one surface only, so that it keeps its place in every edit
    std::uint32_t piece = 0;   ///< among the surface's targets
};

/// Every query is safe from any thread. Empty (and without memory) where nothing is specular.
class SpecularTargets {
public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    explicit SpecularTargets(const RayScene& rays);

    /// Gives the pieces of surfaces that moved their new bounds; what triangles they are of stays. Surfaces that are new are
    /// none of mirrors, metals or glass.
    void follow(const RayScene& rays, std::span<const std::uint32_t> moved_surfaces);

    [[nodiscard]] bool empty() const { return targets_.empty(); }
    [[nodiscard]] const std::vector<SpecularTarget>& targets() const { return targets_; }
    /// The target that a triangle belongs to; kNone where it is not specular.
    [[nodiscard]] std::uint32_t target_of(std::uint32_t surface, std::uint32_t triangle) const {
        return of_triangle_[surface].empty() ? kNone : of_triangle_[surface][triangle];
    }

private:
    std::vector<SpecularTarget> targets_;
    std::vector<std::vector<std::uint32_t>> of_triangle_; ///< per surface; empty where it is not specular
};

} // namespace atrium
