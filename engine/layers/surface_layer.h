// What is shown of one surface: a conforming triangle mesh in the node's own coordinates and the light on its vertices.
#pragma once

#include "engine/base/units.h"
#include "engine/caustics/caustic_texture.h"
#include "engine/layers/light_map.h"
#include "engine/scene/scene.h"

#include <array>

#include <cstdint>
#include <memory>
#include <vector>

namespace atrium {

/// Triangles to draw, in the shape's own (local) coordinates, so that a moved node is drawn at its new place at once.
/// No T-vertices: neighbours share vertices (or have equal ones across creases).
struct DisplayMesh {
    std::vector<vec3> positions;
    std::vector<vec3> normals;    ///< unit, one per vertex, on the front side
    std::vector<vec2> texcoords0; ///< empty or one per vertex
    std::vector<vec2> texcoords1;
    std::vector<vec3> colors; ///< linear vertex colours, empty or one per vertex
    /// Chart-space coordinates in the surface's light maps (LightMap), in tiles: empty (no light map), or one per vertex;
    /// negative where the vertex's triangles are uncharted and their direct light is on the vertices.
    std::vector<vec2> light_uv;
    std::vector<std::uint32_t> indices;
    friend bool operator==(const DisplayMesh&, const DisplayMesh&) = default;
};

/// Light on one (node, part). Irradiance at a point = diffuse (interpolated from the vertices) + direct (interpolated from
/// the vertices, empty = 0, + the light map where the triangle is charted) + caustic (vertices and textures alike). Radiance
/// seen = emitted + reflectance * irradiance / pi, textures applied by the viewer. Back sides have light of their own, or
/// none at all (solids, one-sided materials): then has_back() is false.
struct SurfaceLayer {
    NodeId node;
    std::uint32_t part = 0;
    std::shared_ptr<const DisplayMesh> mesh; ///< never null
    std::vector<Rgb> irradiance_front;       ///< lux per vertex: reflected by other surfaces
    std::vector<Rgb> irradiance_back;
    std::vector<Rgb> direct_front; ///< lux per vertex: straight from lamps, sun and sky; empty = none on vertices
    std::vector<Rgb> direct_back;
    std::shared_ptr<const LightMap> direct_map_front; ///< null where no triangle is charted or nothing shines straight on it
    std::shared_ptr<const LightMap> direct_map_back;
    std::vector<Rgb> caustic_front; ///< lux per vertex: over mirrors and glass, as far as no texture holds it; empty = none
    std::vector<Rgb> caustic_back;
    std::vector<std::shared_ptr<const CausticTexture>> caustic_textures_front; ///< added up, any number
    std::vector<std::shared_ptr<const CausticTexture>> caustic_textures_back;

    [[nodiscard]] bool has_back() const { return !irradiance_back.empty(); }
};

/// Which shares of the light to add up.
struct LightShares {
    bool diffuse = true;
    bool direct = true;
    bool caustic = true;
    friend bool operator==(const LightShares&, const LightShares&) = default;
};

/// Irradiance in a triangle of a layer's mesh, lux: `vertex` are three indices into it, `weight` their barycentric weights.
/// `back` asks for the back side, which must exist (has_back()).
Rgb irradiance_at(const SurfaceLayer& layer, const std::array<std::uint32_t, 3>& vertex, const vec3& weight, bool back,
                  const LightShares& shares = {});
/// Irradiance on a vertex without the light map: what a viewer interpolates and adds the map to.
Rgb vertex_irradiance(const SurfaceLayer& layer, std::uint32_t vertex, bool back, const LightShares& shares = {});

/// Unlit triangles of a node's part: what is drawn before (or without) a solution. Empty data for a part without area.
DisplayMesh make_display_mesh(const Shape& shape, std::size_t part);

} // namespace atrium
