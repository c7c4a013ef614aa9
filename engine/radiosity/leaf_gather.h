// Which leaves see different light from place to place: a look at what links and elements average away.
#pragma once

#include "engine/base/run_context.h"
#include "engine/radiosity/hierarchy.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace atrium {

/// What rays from every leaf bring it, apart for each quarter of it. Engine thread; parallel inside.
class LeafGather {
public:
    /// Shoots `rays` (a power of two) cosine-weighted rays from points spread over each leaf. Points that `covered` says no
    /// to are passed over; leaves with none left receive nothing. Incomplete when stopped: complete() is false.
    /// Leaves before element `first` are left out.
    LeafGather(const Hierarchy& hierarchy, const RayScene& rays, unsigned rays_per_leaf, std::size_t first,
               const std::function<bool(const SurfacePoint&)>& covered, const RunContext& context);

    [[nodiscard]] bool complete() const { return complete_; }
    /// Splits patches whose parts see different light, judged by the rays that start in each quarter: by more than
    /// `contrast` of the leaf's irradiance (at least `floor`, lux) and by more than chance. The foot of a cupboard, the
    /// mouth of a gap. Number of leaves split; nothing here is of use any more then.
    std::size_t split_uneven(Hierarchy& hierarchy, const RayScene& rays, float contrast, float floor) const;

private:
    static constexpr std::size_t kGroups = 4; ///< of origins on a leaf
    struct Group {
        Rgb light{0.0F}; ///< sum of what its rays brought
        float light2 = 0.0F;
        float rays = 0.0F;
    };
    std::vector<std::uint32_t> leaves_;
    std::vector<std::array<Group, kGroups>> groups_; ///< per leaf, with the radiosities of the time of construction
    bool complete_ = false;
};

} // namespace atrium
