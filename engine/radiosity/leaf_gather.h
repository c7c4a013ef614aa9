// Irradiance of leaves by rays over their hemisphere: a second, unbiased look at what the links say.
#pragma once

#include "engine/base/run_context.h"
#include "engine/radiosity/hierarchy.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace atrium {

/// Where rays from every leaf land, kept: one row of the transport per leaf. Links average visibility and form factors over
/// whole elements; a row of rays knows what stands close by. Engine thread; parallel inside.
class LeafGather {
public:
    /// Shoots `rays` (a power of two) cosine-weighted rays from points spread over each leaf. Points that `covered` says no
    /// to are passed over; leaves with none left receive nothing. Incomplete when stopped: complete() is false.
    /// Leaves before element `first` are left out.
    LeafGather(const Hierarchy& hierarchy, const RayScene& rays, unsigned rays_per_leaf, std::size_t first,
               const std::function<bool(const SurfacePoint&)>& covered, const RunContext& context);

    [[nodiscard]] bool complete() const { return complete_; }
    [[nodiscard]] const std::vector<std::uint32_t>& leaves() const { return leaves_; }
    /// Share of each leaf's light that lands on surfaces again (leaves() order): 1 in a closed room.
    [[nodiscard]] const std::vector<float>& row_sums() const { return row_sums_; }
    /// Iterates B = M + rho (D + T B) from the present radiosities to a relative change of `tolerance` (area-weighted
    /// 2-norm) and leaves B and E in the hierarchy, pulled to all levels. Number of sweeps.
    int solve(Hierarchy& hierarchy, double tolerance, int max_sweeps, const RunContext& context) const;
    /// Splits patches whose parts see different light, judged by the rays that start in each quarter: by more than
    /// `contrast` of the leaf's irradiance (at least `floor`, lux) and by more than chance. The foot of a cupboard, the
    /// mouth of a gap. Number of leaves split; the rows are of no more use then.
    std::size_t split_uneven(Hierarchy& hierarchy, const RayScene& rays, float contrast, float floor) const;
    [[nodiscard]] std::size_t memory_bytes() const {
        return entries_.capacity() * sizeof(Entry) + first_.capacity() * sizeof(std::size_t);
    }

private:
    struct Entry {
        std::uint32_t leaf;
        float weight; ///< through / rays
    };
    static constexpr std::size_t kGroups = 4; ///< of origins on a leaf
    struct Group {
        Rgb light{0.0F}; ///< sum of what its rays brought
        float light2 = 0.0F;
        float rays = 0.0F;
    };
    std::vector<std::uint32_t> leaves_;
    std::vector<std::size_t> first_;
    std::vector<Entry> entries_;
    std::vector<float> row_sums_;
    std::vector<std::array<Group, kGroups>> groups_; ///< per leaf, with the radiosities of the time of construction
    bool complete_ = false;
};

} // namespace atrium
