// Direct light at texel resolution: light maps that are fine along the edges of shadows and coarse elsewhere.
#pragma once

#include "engine/base/run_context.h"
#include "engine/geometry/surface_charts.h"
#include "engine/layers/light_map.h"
#include "engine/radiosity/direct_light.h"
#include "engine/radiosity/hierarchy.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace atrium {

/// Irradiance at a point of a surface, visibility included; engine coordinates, unit normal. Called from many threads at
/// once and must give the same for the same point whenever it is asked.
using DirectFunction = std::function<DirectSample(const vec3& point, const vec3& normal)>;

/// A part of the direct light; all parts add up.
struct DirectPart {
    DirectFunction light;
    /// From large sources only (sky through windows, panels): no streak is narrower than the first cells, so none is looked
    /// for between the samples, and texels of four times the finest size will do.
    bool soft = false;
    /// From sources without size or nearly so: a few rays a sample, and repairs follow its shadows as far as they go.
    bool sharp = false;
    /// A change within the box may change the light at the point, or at any within `radius` of it; anything may when empty.
    /// Called from many threads.
    std::function<bool(const vec3& point, float radius, const Box3& box)> touched = {};
    /// Where a change touches the point: rays towards the sources meet what moved since all was built, where it is now or
    /// where it stood. False: the point's light is what it was then. Anything may meet when empty. Called from many threads.
    /// `closely`: with more rays.
    std::function<bool(const SurfacePoint& at, std::span<const Box3> boxes, bool closely)> meets_moved = {};
    /// No more light than this (lux) reaches a place within `radius` of the point, whatever is in the way, in the plane
    /// across the unit `normal` through the point; 0 = any plane. Where it is empty nothing is known. Called from many
    /// threads.
    std::function<float(const vec3& point, float radius, const vec3& normal)> most = {};
    /// Of the mirrors that all of it comes over, where light is not seen straight; empty: unknown.
    std::vector<Box3> over = {};
    bool straight = true; ///< and not over mirrors: what a place does not see cannot come between
};

/// What moved: where to look for light that changed.
struct LightChange {
    std::vector<Box3> boxes;         ///< bounds before and after, engine coordinates
    std::vector<std::uint8_t> moved; ///< per surface of the ray scene: its own points moved
    /// Many samples, with all their rays, instead of those that count at a glance; what earlier repairs left out or looked
    /// at in passing is made good.
    bool exact = false;
    /// The ray scene tells what has not moved (RayScene::look_back()): places that cannot see the boxes are left out.
    bool looks_back = false;
    bool mirror_moved = false; ///< since all was built: DirectPart::over is no longer true
    /// A part that is looked at anew wherever it shines, since its sources themselves moved; kNone: none.
    std::size_t anew = kNone;
    static constexpr std::size_t kNone = SIZE_MAX;
};

/// What a repair did.
struct RepairReport {
    std::size_t samples = 0;             ///< calls of direct functions
    std::vector<std::uint32_t> surfaces; ///< whose maps are new, ascending
    bool complete = false;               ///< false when the context asked to stop: the maps are then partly old
};

/// Where one source of light shines: one of the parts that LiveDirectMaps was made with.
struct PartSource {
    std::size_t part = 0;
    DirectFunction light; ///< that source alone, over its brightness; empty: the part has no other source
};

/// What sources send that leave a part: see LiveDirectMaps::take_out().
struct LeavingLight {
    std::size_t part = 0;
    DirectFunction light; ///< of these sources alone; empty: the part has no others
};

/// What one source sends, over its brightness. Light is linear in it.
struct SourceLight {
    std::vector<std::pair<std::size_t, std::vector<Rgb>>> nodes; ///< by part, on the grid that LiveDirectMaps keeps
    /// Texel by texel beside the maps; null where the source does not shine.
    std::vector<std::shared_ptr<const LightMap>> front, back;
    [[nodiscard]] std::size_t memory_bytes() const;
};

/// How fine and how exact. Levels are for tiles of 0.32 m: at level k samples are 0.32 m / 2^k apart.
struct DirectMapSettings {
    unsigned first_level = 2;  ///< everywhere at least: 8 cm (draft 1, fine 3)
    unsigned max_level = 6;    ///< along sharp edges: 5 mm (draft 4, fine 7); 12 at most
    float contrast = 0.03F;    ///< error of the interpolation, relative to the light there, that asks for finer texels
    float light_floor = 1.0F;  ///< lux: errors are judged against at least this irradiance
    float cover_reach = 0.05F; ///< metres within which all ways out must be shut where something rests on a surface
    std::size_t max_samples = 16'000'000; ///< texels of all maps together at most (12 bytes each)
};

/// What build_direct_maps() makes.
struct DirectMaps {
    /// One per surface of the ray scene: null where nothing is charted, the side is not lit, or no light falls on it.
    std::vector<std::shared_ptr<const LightMap>> front;
    std::vector<std::shared_ptr<const LightMap>> back;
    double error_estimate = 0.0;   ///< area-weighted RMS of the samples' relative standard errors
    std::size_t samples = 0;       ///< texels in all maps
    std::size_t evaluations = 0;   ///< calls of direct functions
    std::size_t limited_tiles = 0; ///< tiles coarser than their light asks for because max_samples was reached
    bool complete = false;         ///< false when the context asked to stop: then there are no maps
    [[nodiscard]] std::size_t memory_bytes() const;
};

/// Light maps together with what is needed to repair them where something moved. Engine thread; parallel inside.
class LiveDirectMaps {
public:
    /// As build_direct_maps(); `rays` and `charts` must outlive it and may change between calls as their surfaces move.
    LiveDirectMaps(const RayScene& rays, std::span<const SurfaceCharts> charts, std::vector<DirectPart> parts,
                   const std::function<bool(std::uint32_t surface)>& back_lit, const DirectMapSettings& settings,
                   const RunContext& context);
    ~LiveDirectMaps();
    LiveDirectMaps(const LiveDirectMaps&) = delete;
    LiveDirectMaps& operator=(const LiveDirectMaps&) = delete;

    /// See build_direct_maps(); once.
    DirectMaps build(double progress_from, double progress_to);
    /// Looks again at the samples that a change touches, closer where edges of shadows come to lie, and replaces the maps of
    /// `maps` (what build() made) whose light changed. Cells are never joined again; soft parts are looked at on the
    /// coarsest grid where what moved looks largest, and finer samples follow by interpolation of the change. A part that is
    /// to be looked at anew starts from nothing: its cells are then those of a new map, coarser unless all is to be exact.
    RepairReport repair(const LightChange& change, DirectMaps& maps, const RunContext& context);
    /// The light of one source, from what is known of the parts that it shines in; rays are traced only where these have
    /// other sources. `brightness`: of the source now. Holds until the next repair. Nothing when asked to stop.
    [[nodiscard]] std::optional<SourceLight> light_of(std::span<const PartSource> source, const Rgb& brightness,
                                                      const RunContext& context);
    /// Takes light out of parts, whose functions give none of it any more: some other part has it from now on. False, and
    /// nothing has changed, when asked to stop. Maps show it until the next repair is complete.
    bool take_out(std::span<const LeavingLight> light, const RunContext& context);
    /// Adds a part without any light, for LightChange::anew to look at before all else; returns its number. One at most is
    /// looked at so.
    std::size_t add_part(DirectPart part, const RunContext& context);
    /// The charts lie elsewhere in memory now; those of new surfaces behind all others are not looked at.
    void charts_are(std::span<const SurfaceCharts> charts);
    /// Makes a source brighter by `change`, for repairs to start from; maps that show it already are the caller's.
    void add_light(const SourceLight& source, const Rgb& change);
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Builds the light maps of all charted surfaces from light in parts that add up; `charts` has one entry per surface of
/// `rays`. Samples start on a coarse grid with one more at a scattered place in each cell (not in soft parts), so that
/// narrow streaks of light are met somewhere; cells where the light differs from what its neighbours say are divided, and so
/// are those that an edge runs into. Everything else is interpolated, so the cost follows the length of the edges. Each part
/// is looked for by itself: where one has a sharp edge, the others need not be asked again. Errors are judged against the
/// light of the part and of those before it: the strongest and cheapest comes first. `back_lit(surface)` tells whether the
/// back side can receive light at all. Same result for any number of threads; when asked to stop it does so after the chunks
/// of samples or the steps of bookkeeping at hand: milliseconds in a room, tens of them in a house. Engine thread.
DirectMaps build_direct_maps(const RayScene& rays, std::span<const SurfaceCharts> charts, std::span<const DirectPart> parts,
                             const std::function<bool(std::uint32_t surface)>& back_lit, const DirectMapSettings& settings,
                             const RunContext& context, double progress_from, double progress_to);
/// The same for light in one part, not soft.
DirectMaps build_direct_maps(const RayScene& rays, std::span<const SurfaceCharts> charts, const DirectFunction& direct,
                             const std::function<bool(std::uint32_t surface)>& back_lit, const DirectMapSettings& settings,
                             const RunContext& context, double progress_from, double progress_to);

} // namespace atrium
