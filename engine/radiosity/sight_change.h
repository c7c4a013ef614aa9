// What surfaces see otherwise than before, once something has moved: changed sight between surfaces.
#pragma once

#include "engine/base/run_context.h"
#include "engine/radiosity/hierarchy.h"
#include "engine/radiosity/leaf_exchange.h"
#include "engine/radiosity/light_split.h"

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace atrium {

/// Bounds of one thing that moved, engine coordinates.
struct Displacement {
    Box3 before; ///< where it stood when all sight was last known
    Box3 now;    ///< empty = it is hidden or removed
};

/// Radiosity that a hit sends back along its ray, lumen per square metre. Called from many threads.
using RadiosityAtHit = std::function<Rgb(const Hit&)>;

/// Change of transport operators: E' = K B' + dK B', where dK is sampled by rays into the solid angle of what moved, before
/// and now, and nowhere else. A ray counts what it ends on now and takes off what it ended on before, so that what both see
/// cancels to the bit, and a thing that came back leaves nothing. Seen over mirrors and through panes as far as these stand
/// between the point and what moved; what moved and is a mirror or glass itself changes nothing here. Needs
/// RayScene::look_back(); immutable, safe from any thread.
class SightChange {
public:
    /// `moved` = per surface of the ray scene, not 0 where it moved. What is `carried` by particles is no part of points'
    /// irradiance.
    SightChange(const Hierarchy& hierarchy, const RayScene& rays, std::span<const Displacement> displaced,
                std::span<const std::uint8_t> moved, CarriedByParticles carried = {});

    /// An upper bound of the share of the hemisphere's light (form factor) that comes from where something moved, for a
    /// point or any within `radius`; a zero normal stands for all directions.
    [[nodiscard]] float share(const vec3& point, const vec3& normal, float radius = 0.0F) const;

    /// How many rays a point is worth.
    struct Effort {
        float rays = 256.0F; ///< for a whole hemisphere that changes; in proportion to share() below
        unsigned least = 2;  ///< towards each box
        unsigned most = 128;
    };
    /// Change of the irradiance at a point, lux.
    [[nodiscard]] Rgb irradiance(const SurfacePoint& at, const Effort& effort, const RadiosityAtHit& radiosity) const;

    /// What changes of the rows of K: sums over leaves.
    struct Rows {
        struct Entry {
            std::uint32_t other; ///< place in the list of leaves
            float weight;
        };
        std::vector<std::size_t> first; ///< per leaf of the list, into `entries`; one more at the end
        std::vector<Entry> entries;
        std::vector<std::uint8_t> whole;   ///< per leaf: its row is all new and not what comes on top of that of K
        std::vector<std::uint8_t> carried; ///< per entry, not 0: particles bring it where light is shown; or empty
        /// What the rows make of irradiances that K alone gives.
        void apply(const std::vector<Rgb>& radiosity, std::vector<Rgb>& irradiance) const;
        /// What carried entries make of it at a leaf of the list.
        [[nodiscard]] Rgb carried_light(const Hierarchy& hierarchy, std::span<const std::uint32_t> leaves,
                                        std::size_t leaf) const;
    };
    /// `anew(element)`: leaves whose row is made anew, of `rays` rays all round from points that are not `covered`.
    [[nodiscard]] Rows rows(const Hierarchy& hierarchy, std::span<const std::uint32_t> leaves, const Effort& effort,
                            const std::function<bool(std::uint32_t)>& anew, const LookSettings& look,
                            const RunContext& context) const;

private:
    /// What a ray ends on or passes, with the sign of what it adds.
    struct Met {
        Hit hit;
        Rgb weight;
        bool carried = false; ///< see CarriedByParticles
    };
    /// Few surfaces pass light on; what is seen over more of them is left to the next complete solution.
    static constexpr std::size_t kMostMet = 12;
    struct Ray1 {
        std::array<Met, kMostMet> met;
        std::size_t count = 0;
    };
    /// Bounds as a ball and a box.
    struct Target {
        Box3 box;
        vec3 centre;
        float radius;
    };
    [[nodiscard]] float share_of(const Target& target, const vec3& point, const vec3& normal, float radius) const;
    [[nodiscard]] unsigned rays_for(float share, const Effort& effort) const;
    /// The ray for `u` in [0,1)^2 of `rays` from a point towards target `index`.
    void shoot(std::size_t index, const SurfacePoint& from, const vec2& u, float rays, std::uint64_t seed, Ray1& out) const;
    bool follow(const Ray& ray, bool before, float weight, std::uint64_t seed, Ray1& out) const;

    const Hierarchy& h_;
    const RayScene& rays_;
    std::vector<Target> targets_;
    std::vector<std::uint8_t> moved_;
    CarriedByParticles carried_;
};

/// Solves B = M + rho (D + (K + dK) B) on the leaves from their present radiosities, by minimal residuals: K + dK is not
/// symmetric. Leaves B and E in the hierarchy, pulled to all levels; returns, per leaf, what of E is not K B.
std::vector<Rgb> solve_with_changed_sight(Hierarchy& hierarchy, const LeafExchange& exchange, const SightChange::Rows& rows,
                                          double tolerance, int max_iterations, const RunContext& context);

} // namespace atrium
