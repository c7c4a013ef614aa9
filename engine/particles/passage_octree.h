// The paper's dynamic octree: which particles pass near an object that is being moved.
#pragma once

#include "engine/particles/particle_paths.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace atrium {

/// Empty until something moves; then there are cells around that object, as small as it is, each with the particles that
/// cross it, and as it moves on those behind it go. Its answers are those of ParticlePaths::mark_crossing().
class PassageOctree {
public:
    /// `reach` as scene_reach() tells it: what lies further away is looked for among all particles.
    explicit PassageOctree(float reach);

    /// See ParticlePaths::mark_crossing(). Cells are made around the boxes, those elsewhere are given up. Parallel.
    void mark_crossing(const ParticlePaths& paths, std::span<const Box3> boxes, std::span<std::uint8_t> marks);
    /// Some particles, ascending, have other paths now.
    void follow(const ParticlePaths& paths, std::span<const std::uint32_t> particles);

    [[nodiscard]] float reach() const { return reach_; }
    [[nodiscard]] std::size_t cells() const;
    /// A cell that is not divided.
    struct Leaf {
        Box3 box;                  ///< engine coordinates
        std::size_t particles = 0; ///< that cross it
    };
    [[nodiscard]] std::vector<Leaf> leaves() const; ///< without the root
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    struct Cell {
        Box3 box;
        bool used = false;
        std::array<std::uint32_t, 8> child{};  ///< 0 = none
        std::vector<std::uint32_t> crossing{}; ///< ascending; the root has all without a list
    };
    void refine(const ParticlePaths& paths, std::uint32_t cell, const Box3& box, float smallest);
    void simplify(std::uint32_t cell, std::span<const Box3> near);
    void release(std::uint32_t cell);
    void collect(std::uint32_t cell, const Box3& box, std::vector<std::uint8_t>& marks, bool& all) const;
    [[nodiscard]] std::vector<std::uint32_t> crossing(const ParticlePaths& paths, std::uint32_t parent,
                                                      const Box3& box) const;

    float reach_;
    std::vector<Cell> cells_; ///< [0] is the root
};

} // namespace atrium
