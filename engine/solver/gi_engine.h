// The engine's facade: a scene in, a Solution out. Runs on the calling thread plus workers; knows nothing of queues.
#pragma once

#include "engine/base/result.h"
#include "engine/base/run_context.h"
#include "engine/solver/solution.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace atrium {

class SightChange;
struct LayerSet;
struct LayerSettings;
struct LightChange;
struct Hit;
struct VertexChange;

struct SolveOptions {
    SolverSettings::Quality quality = SolverSettings::Quality::Normal;
    std::uint32_t seed = 1;
    double target_error = 0; ///< relative; 0 = what the quality stands for
    std::uint64_t revision = 0;
    bool paper_mode = false;     ///< the algorithms of 2001 where ours differ
    std::uint32_t particles = 0; ///< emitted at most; 0 = what the quality stands for
    /// update() will follow: the complete solution keeps what that needs, and stays in place until the next is complete.
    bool keep_for_updates = false;
    /// Solutions tell where particles landed. Asked for afterwards, with keep_for_updates, nothing is computed anew.
    bool keep_landings = false;
    /// Likewise of Solution::insides, of complete solutions and of updates that are not in a hurry; needs keep_for_updates.
    bool keep_insides = false;
    bool hurried = false; ///< solve() hands on to update()
    bool settle = false;  ///< likewise, and that is not in a hurry: as exact as a new solution, or nearly
    /// Light is on show that is better than a first, coarse picture: none is made.
    bool skip_first_picture = false;
};

/// Irradiance at a free sensor, lux, with the program's own estimate of its standard error.
struct SensorReading {
    Rgb irradiance{0.0F};
    double standard_error = 0; ///< of E, lux
    bool on_surface = false;
};

/// Keeps what a solved scene needs for further questions (ray scene, hierarchy). One engine thread at a time.
class GiEngine {
public:
    GiEngine();
    ~GiEngine();
    GiEngine(GiEngine&&) noexcept;
    GiEngine& operator=(GiEngine&&) noexcept;

    /// Phases in order: ray_scene, hierarchy, links, gather, layers. `on_snapshot` gets every picture worth showing, the
    /// last one with final = true. Where only Node::caustics differ from the last complete solution of a solve with
    /// keep_for_updates, its textures alone are made anew, to the same result. Stopped by context.stop or its deadline:
    /// returns the last snapshot (final = false, statistics.converged = false), or an error "stopped before the first
    /// picture". Stop points: every chunk of 64 elements or 256 vertices (a few milliseconds).
    Result<std::shared_ptr<const Solution>>
    solve(const Scene& scene, const SolveOptions& options, const RunContext& context,
          const std::function<void(std::shared_ptr<const Solution>)>& on_snapshot = {});

    /// Light after objects were moved, scaled, added, hidden or removed (and came back), lamps moved, turned or took another
    /// shape, they or the sky changed their brightness, or matt surfaces their colour, in a hurry or (SolveOptions::settle)
    /// nearly as exact as a new solution, starting from the last complete solution (of a solve with keep_for_updates) and
    /// the updates since: direct light, caustics and sight between surfaces are looked at again where a move reaches, and
    /// weighted anew without rays where brightness changed. Never `final`. Marked in Solution::statistics.update. An error
    /// where more than that changed, shining surfaces, windows or mirrors came or went, or there is no complete solution:
    /// then only solve() helps. Stopped by the context: an error too; what was left undone is remembered and done by the
    /// next update.
    Result<std::shared_ptr<const Solution>> update(const Scene& scene, const SolveOptions& options,
                                                   const RunContext& context);
    /// A complete solution is there for update() to start from.
    [[nodiscard]] bool can_update() const;

    /// Irradiance on a virtual sensor at a world point with unit normal, from the hierarchy of the last solve.
    [[nodiscard]] SensorReading gather_free(const dvec3& point, const dvec3& normal) const;
    [[nodiscard]] bool has_solution() const;

private:
    struct Impl;
    struct Relight;
    struct LampMoves;
    static void reflect_change(Impl& impl, bool in_a_hurry, const RunContext& context);
    static void cover_vertices(Impl& impl, const RunContext& context);
    static Rgb sent_back(const Impl& impl, const Hit& hit);
    static std::vector<Rgb> solve_with_new_sight(Impl& impl, const SightChange& sight, bool in_a_hurry,
                                                 std::vector<Rgb>& carried, const RunContext& context);
    static std::vector<std::vector<VertexChange>> look_from_vertices(Impl& impl, const SightChange& sight, bool in_a_hurry,
                                                                     const RunContext& context);
    static Result<void> trace_again(Impl& impl, const Scene& scene, bool moves, UpdateStatistics& report,
                                    const RunContext& context);
    static std::vector<std::uint32_t> surfaces_with_new_caustics(const Impl& impl);
    static void take_in(Impl& impl, std::uint32_t first_surface);
    static LayerSet lay_out(const Impl& impl, std::uint32_t first, std::uint32_t last, LayerSettings settings,
                            const RunContext& context);
    static bool lay_out_anew(Impl& impl, const std::vector<std::uint8_t>& wanted, const LayerSettings& settings,
                             const RunContext& context);
    static bool map_added(Impl& impl, const std::vector<std::uint8_t>& wanted, const RunContext& context);
    static void forget_added_maps(Impl& impl);
    static bool finish_layers(Impl& impl, const RunContext& context);
    static std::vector<std::shared_ptr<const SurfaceLayer>> shown_surfaces(const Impl& impl);
    static void show_direct_light(Impl& impl, const LightChange& change, const RunContext& context);
    static void light_leaves_again(Impl& impl, const LightChange& change, const RunContext& context);
    static void keep_question(Impl& impl, const Scene& scene, const SolveOptions& options);
    // The new solution where nothing but wishes about caustics (or that landings are asked for) differs from the last
    // complete one; else null.
    std::shared_ptr<const Solution> follow_wishes(const Scene& scene, const SolveOptions& options,
                                                  const RunContext& context);
    std::unique_ptr<Impl> impl_;
};

/// Irradiance read from a solution's own layers at a world point: the diffuse surface within 1 cm that faces the same way
/// as `normal`; on_surface = false when there is none.
SensorReading read_surface(const Scene& scene, const Solution& solution, const dvec3& point, const dvec3& normal);

/// A place to read: a world point and the unit normal of the side that is meant.
struct SensorPlace {
    dvec3 point{0.0};
    dvec3 normal{0.0, 1.0, 0.0};
};
/// read_surface() for many points at once, in one pass over the layers.
std::vector<SensorReading> read_surfaces(const Scene& scene, const Solution& solution, std::span<const SensorPlace> places);

} // namespace atrium
