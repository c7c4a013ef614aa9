// Caustic light of all surfaces: textures where it has detail, the mesh's vertices elsewhere.
#pragma once

#include "engine/caustics/caustic_builder.h"
#include "engine/layers/surface_layer.h"
#include "engine/particles/particle_map.h"

namespace atrium {

/// Caustic light before there is a mesh to show it on. Empty where no particle landed.
struct CausticLight {
    /// One surface side that particles landed on.
    struct Side {
        std::uint32_t surface = 0; ///< of RayScene::surfaces()
        bool back = false;
        std::vector<std::shared_ptr<const CausticTexture>> textures;
        std::vector<std::uint32_t> on_mesh; ///< into ParticleMap::landings()
        std::vector<std::uint32_t> places;  ///< of these among the landings of this side: they stay when others change
        std::size_t first_record = 0;       ///< its records in CausticLight::records
        std::size_t record_count = 0;
        friend bool operator==(const Side&, const Side&) = default;
    };
    std::vector<Side> sides; ///< by surface, front before back
    std::vector<CausticRecord> records;

    [[nodiscard]] bool empty() const { return sides.empty(); }
    /// Bytes of the textures.
    [[nodiscard]] std::size_t memory_bytes() const;
    [[nodiscard]] std::size_t texture_count() const;
};

/// What may be taken over from caustic light as it was before an edit.
struct CausticReuse {
    const CausticLight& before; ///< of the same settings; its textures are shared
    /// Surfaces whose landings, power, place or charts are others now, ascending: see ParticleUpdate. The textures and
    /// records of all others stay.
    std::span<const std::uint32_t> changed;
};

/// What the nodes of `scene` wish, for every one of RayScene::surfaces(); empty where all of it is automatic.
std::vector<CausticWish> caustic_wishes(const Scene& scene, const RayScene& rays);

/// Decides, sizes and fills the textures of every side. `charts` as chart_surfaces() makes them, `wishes` as
/// caustic_wishes() does. Parallel; the same for any number of threads, and with `reuse` (may be null) as without: surfaces
/// whose wish changed count as changed. Empty when the context stopped.
CausticLight build_caustic_light(const RayScene& rays, std::span<const SurfaceCharts> charts, const ParticleMap& particles,
                                 const CausticSettings& settings, const CausticReuse* reuse = nullptr,
                                 std::span<const CausticWish> wishes = {}, const RunContext& context = {});

/// Puts the light on the layers in the place of what they had: textures are shared, landings without one are spread over the
/// vertices around them, so that what triangles interpolate holds their power exactly. `layers` are those of the same ray
/// scene. False when the context stopped: the layers are then as they were.
bool attach_caustics(std::vector<std::shared_ptr<const SurfaceLayer>>& layers, const RayScene& rays,
                     const ParticleMap& particles, const CausticLight& light, const RunContext& context = {});

} // namespace atrium
