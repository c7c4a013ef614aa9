// From a light field to what is shown: vertices where the light is sampled, more of them where it changes.
#pragma once

#include "engine/base/run_context.h"
#include "engine/geometry/surface_charts.h"
#include "engine/layers/surface_layer.h"
#include "engine/radiosity/direct_light.h"
#include "engine/radiosity/hierarchy.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace atrium {

struct LayerSettings {
    float base_edge = 0.5F;      ///< metres: longer edges are always split
    float smallest_edge = 0.04F; ///< edges are not split below this
    float contrast = 0.08F;      ///< relative deviation of a midpoint from its ends' mean that asks for a split
    float light_floor = 1.0F;    ///< lux: differences are judged against at least this irradiance
    float cover_reach = 0.01F;   ///< metres within which all ways out must be shut where something rests on a surface
    /// Light is looked at between vertices and at the borders of what covers them. Without, it is that of the vertices
    /// alone: a picture in half the time.
    bool look_between = true;
    bool keep_places = false;                 ///< LayerSet::places is wanted
    std::uint32_t first_surface = 0;          ///< of the ray scene: layers of those from here on are built
    std::uint32_t last_surface = 0xFFFFFFFFU; ///< and before this one
    std::size_t max_vertices = 600'000;       ///< added vertices at most; the strongest contrasts first
};

/// The light field that is sampled: irradiance at a point (engine coordinates) with unit normal. Called from many threads.
struct LightField {
    /// Told of the points before reflected() is asked for them, on the engine thread; false when stopped. May be empty.
    std::function<bool(std::span<const SurfacePoint> points)> prepare;
    std::function<DirectSample(const vec3& point, const vec3& normal)> reflected; ///< from other surfaces
    std::function<DirectSample(const vec3& point, const vec3& normal)> direct;    ///< from lamps, sun and sky
};

/// Light maps of all surfaces and what they belong to; spans are empty or have one entry per ray surface.
struct LightMaps {
    std::span<const SurfaceCharts> charts;
    std::span<const std::shared_ptr<const LightMap>> front;
    std::span<const std::shared_ptr<const LightMap>> back;
};

/// Where the vertices of a surface's layer took their light, for who wants to look again. Engine coordinates; a zero normal
/// marks vertices that show none (mirrors).
struct VertexPlaces {
    std::uint32_t surface = 0; ///< of RayScene::surfaces()
    std::vector<SurfacePoint> front;
    std::vector<SurfacePoint> back;             ///< empty without a back side
    std::vector<std::uint16_t> state;           ///< per vertex, of the following bits
    static constexpr std::uint8_t kCharted = 1; ///< direct light is in the light map and not on the vertex
    /// Something lies on it: it shows its neighbours' light. Front; the back's bit is twice that.
    static constexpr std::uint8_t kCovered = 2;
    static constexpr std::uint8_t kWasCovered = 8; ///< the same when all was built
    /// Direct light was left out or looked at in passing by an update in a hurry. Front; the back's bit is twice that.
    static constexpr std::uint8_t kStale = 32;
    /// Its direct light may not be that of when all was built. Front; the back's bit is twice that.
    static constexpr std::uint8_t kDiffers = 128;

    [[nodiscard]] const std::vector<SurfacePoint>& side(bool is_back) const { return is_back ? back : front; }
    [[nodiscard]] bool covered(std::size_t vertex, bool is_back) const {
        return (state[vertex] & (is_back ? 2U * kCovered : kCovered)) != 0;
    }
    [[nodiscard]] bool was_covered(std::size_t vertex, bool is_back) const {
        return (state[vertex] & (is_back ? 2U * kWasCovered : kWasCovered)) != 0;
    }
    [[nodiscard]] bool stale(std::size_t vertex, bool is_back) const {
        return (state[vertex] & (is_back ? 2U * kStale : kStale)) != 0;
    }
    void set_stale(std::size_t vertex, bool is_back, bool is_stale) {
        const unsigned bit = is_back ? 2U * kStale : kStale;
        state[vertex] = std::uint16_t(is_stale ? state[vertex] | bit : state[vertex] & ~bit);
    }
    [[nodiscard]] bool differs(std::size_t vertex, bool is_back) const {
        return (state[vertex] & (is_back ? 2U * kDiffers : kDiffers)) != 0;
    }
    void set_differs(std::size_t vertex, bool is_back, bool does) {
        const unsigned bit = is_back ? 2U * kDiffers : kDiffers;
        state[vertex] = std::uint16_t(does ? state[vertex] | bit : state[vertex] & ~bit);
    }
    /// The vertex has light of its own on this side.
    [[nodiscard]] bool shows(std::size_t vertex, bool is_back) const {
        return side(is_back)[vertex].normal != vec3(0.0F) && !covered(vertex, is_back);
    }
    /// It has direct light of its own there.
    [[nodiscard]] bool shows_direct(std::size_t vertex, bool is_back) const {
        return (state[vertex] & kCharted) == 0 && shows(vertex, is_back);
    }
};

/// What build_layers() makes.
struct LayerSet {
    std::vector<std::shared_ptr<const SurfaceLayer>> surfaces;
    std::vector<VertexPlaces> places; ///< per entry of `surfaces`; empty unless LayerSettings::keep_places
    double error_estimate = 0.0;      ///< area-weighted RMS of the vertices' relative standard errors
    double mean_radiance = 0.0;       ///< log-average of reflected radiance, cd/m2
    std::size_t vertices = 0;
    bool limited = false;  ///< LayerSettings::max_vertices was reached
    bool complete = false; ///< false when the context asked to stop
    [[nodiscard]] std::size_t memory_bytes() const;
};

/// Samples irradiance on the vertices of all surfaces: reflected light everywhere, direct light where no chart and so no
/// light map has it. Edges are split at their midpoint by a rule that looks at nothing but the edge, and coincident edges of
/// one node are split together, so no T-vertex arises; triangles with one, two or three split edges become two, three or
/// four. `back_lit(surface)` tells whether the back side can receive light at all.
LayerSet build_layers(const RayScene& rays, const LightField& field, const LightMaps& maps, const LayerSettings& settings,
                      const std::function<bool(std::uint32_t surface)>& back_lit, const RunContext& context,
                      double progress_from, double progress_to);

} // namespace atrium
