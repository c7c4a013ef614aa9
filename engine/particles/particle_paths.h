// Where particles went, kept so that what a moved object touches can be found without tracing anything.
#pragma once

#include "engine/base/math.h"
#include "engine/raycast/ray_scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace atrium {

/// Polylines of particles by their number, side by side in memory: 12 bytes a vertex, 8 bytes a particle.
class ParticlePaths {
public:
    /// Vertices of a particle's rays as trace_particle() tells them: where each starts, and where the last ends. One that
    /// never ends goes on to kFar metres.
    static void add_vertices(std::span<const Ray> rays, std::vector<vec3>& out);
    static constexpr float kFar = 1e6F;

    /// Room for so many particles without a path and vertices to come.
    void reset(std::size_t particles, std::size_t vertices);
    /// Room for so many more particles behind those there are, without a path.
    void add(std::size_t particles);
    /// Gives a particle a new path (may be empty). What is longer than before goes to the end of the store; compact() gets
    /// rid of the holes.
    void set(std::size_t particle, std::span<const vec3> path);
    /// Tidies up when more than a quarter of the store is holes.
    void compact();

    [[nodiscard]] std::size_t size() const { return first_.size(); }
    [[nodiscard]] std::size_t vertices() const { return x_.size() - holes_; }
    [[nodiscard]] std::vector<vec3> path(std::size_t particle) const;
    [[nodiscard]] std::size_t memory_bytes() const;

    /// Boxes as mark_crossing() takes them: larger by what rays are rounded by that start within `reach` metres of (0,0,0)
    /// or twice that, without those that are empty.
    static std::vector<Box3> widened(std::span<const Box3> boxes, float reach);
    /// True where a particle's path meets one of some boxes, which are taken as they are.
    [[nodiscard]] bool crosses(std::size_t particle, std::span<const Box3> boxes) const;
    /// Marks the particles whose path meets one of the boxes (1 in `marks`, one for each particle; the others are left as
    /// they are); boxes are taken as they are. Parallel.
    void mark_crossing(std::span<const Box3> boxes, std::span<std::uint8_t> marks) const;

private:
    std::vector<float> x_, y_, z_;
    std::vector<std::uint32_t> first_; ///< of a particle
    std::vector<std::uint32_t> count_;
    std::size_t holes_ = 0;
};

} // namespace atrium
