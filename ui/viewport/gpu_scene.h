// The view's items on the GPU: uploads what changed, draws what is in sight.
#pragma once

#include "engine/view/false_color.h"
#include "ui/viewport/caustic_cache.h"
#include "ui/viewport/gl.h"
#include "ui/viewport/light_map_cache.h"
#include "ui/viewport/texture_cache.h"
#include "ui/viewport/view_scene.h"

#include <array>
#include <functional>
#include <map>
#include <unordered_map>
#include <unordered_set>

namespace atrium::ui {

/// From where and how to draw. Geometry is placed relative to the eye in double precision.
struct DrawView {
    dmat4 projection{1.0};
    dmat4 rotation{1.0};
    dvec3 eye{0.0};
    float exposure = 1.0F; ///< factor on radiance, exposure_scale()
    bool linear = false;   ///< write radiance instead of display values
    bool use_probe = true;
    vec3 background{0.0F};  ///< display values behind everything, also in flat mirrors
    bool reflected = false; ///< looks into a flat mirror: `rotation` reflects, and what lies behind the mirror is cut off
    vec4 clip{0.0F};        ///< the mirror's plane relative to the eye, positive in front
    vec4 window{-1.0F, -1.0F, 1.0F, 1.0F};                  ///< what of the view is of use: x and y from, x and y to
    Cutaway cutaway;                                        ///< what of the walls is left out
    vec3 filter{1.0F};                                      ///< the mirror's reflectance
    LightShares shares;                                     ///< of the light to show; what emits belongs to the direct share
    bool caustic_boxes = false;                             ///< outline the caustic textures
    const std::unordered_set<NodeId>* texel_grid = nullptr; ///< draw the caustic texels of these nodes; null = of none
    const FalseColor* false_color = nullptr;                ///< show amounts of light; null = the picture
    float line_width = 1.5F;                                ///< of contours, pixels of the target
};

/// Needs the GL context current in every function but the constructor. UI thread only.
class GpuScene {
public:
    /// Compiles the shaders; false when the driver refuses (the log has Qt's message).
    bool initialize(Gl& gl);
    void release();

    /// Drops buffers that `view` no longer uses. New ones are uploaded when first drawn.
    void collect(const ViewScene& view, const Scene& scene);
    /// Starts a frame. Textures, light maps and caustics are uploaded a few a frame: while uploads_pending(), the next frame
    /// shows more of them.
    void begin_frame() {
        textures_.begin_frame();
        light_maps_.begin_frame();
        caustics_.begin_frame();
    }
    [[nodiscard]] bool uploads_pending() const {
        return textures_.pending() || light_maps_.pending() || caustics_.pending();
    }
    /// Uploads a solution's light maps and caustics ahead of its being shown, for a few milliseconds; call until it is true.
    /// Those that are there are kept until the next call or forget_awaited(), whatever the view shows.
    bool upload_ahead(const Solution& solution);
    /// True when upload_ahead() would have nothing to do. Needs no context.
    [[nodiscard]] bool uploaded(const Solution& solution) const;
    /// The view shows the awaited solution now, or never will. Needs no context.
    void forget_awaited() {
        awaited_.clear();
        awaited_caustics_.clear();
    }
    /// Opaque surfaces, then blended ones from back to front. Returns how many surfaces were drawn.
    int draw(const ViewScene& view, const Scene& scene, const DrawView& from);
    /// Flat silhouettes in one colour of the items that `wanted` accepts.
    void draw_mask(const ViewScene& view, const DrawView& from, const vec4& color,
                   const std::function<bool(const ViewItem&)>& wanted);
    /// Particles where they landed on the nodes in `of`. What was uploaded for it is freed when `landings` is null.
    void draw_landings(const ViewScene& view, const DrawView& from,
                       const std::shared_ptr<const std::vector<SurfaceLandings>>& landings,
                       const std::unordered_set<NodeId>& of, float pixel_ratio);
    /// Edges of the display meshes.
    void draw_edges(const ViewScene& view, const DrawView& from);

    /// The reflection probe is a small cube map of the lit surfaces, seen from the room's centre. It is drawn a face at a
    /// time, so that a slow rasteriser does not stand still; the last complete one is used meanwhile.
    /// False, and no probe any more, when the scene shows nothing specular.
    bool begin_probe(const ViewScene& view, const DBox3& room);
    /// Draws face 0 to 5; after the last one the new probe is in use.
    void draw_probe_face(const ViewScene& view, const Scene& scene, unsigned face, float exposure,
                         const LightShares& shares);

private:
    struct Geometry {
        unsigned vertices = 0;
        unsigned indices = 0;
        unsigned light_uv = 0; ///< 0 = nothing of it is charted
        int count = 0;
        bool flat = false;                       ///< all in one plane
        vec3 normal{0.0F};                       ///< of that plane
        std::shared_ptr<const DisplayMesh> mesh; ///< keeps the key alive, so that an address is never taken for another
    };
    struct Lighting {
        unsigned values = 0;
        bool has_back = false;
        std::shared_ptr<const SurfaceLayer> layer;
    };
    struct Array {
        unsigned vao = 0;
        const DisplayMesh* mesh = nullptr;
        const SurfaceLayer* layer = nullptr;
    };

    /// Surface shader compiled for a set of features; locations by the literal's address: no text is hashed per surface.
    struct Program {
        std::unique_ptr<QOpenGLShaderProgram> program;
        std::unordered_map<const char*, int> locations;
        int at(const char* name);
    };

    const Geometry& geometry_of(const ViewItem& item);
    const Lighting* lighting_of(const ViewItem& item);
    void bind(const ViewItem& item, const Geometry& geometry, const Lighting* lighting);
    void draw_surface(const ViewItem& item, unsigned variant, const Scene& scene, const DrawView& from, const mat4& mvp);
    void set_sides(const ViewItem& item, bool reflected);
    void set_shares(const LightShares& shares);
    /// Draws the bound arrays with the light maps and caustics of the sides that are seen.
    void draw_mapped(const ViewItem& item, unsigned variant, const Geometry& geometry, bool has_back);
    void bind_map(Program& program, const std::shared_ptr<const LightMap>& map);
    void bind_caustics(Program& program, const CausticList& list);
    void make_color_map();
    void set_scale(Program& program, float line_width); ///< of false colour
    void forget(const Geometry& geometry);
    /// Draws what a flat mirror shows over its surface, through the stencil buffer.
    void draw_mirror(const ViewItem& item, const ViewScene& view, const Scene& scene, const DrawView& from, const mat4& mvp,
                     int stencil);
    void draw_flat(const ViewItem& item, const mat4& mvp, const vec4& color);

    Gl* gl_ = nullptr;
    enum Feature : unsigned {
        Textured = 1,
        Specular = 2,
        Headlight = 4,
        Cut = 8,
        Mapped = 16,
        Caustic = 32,
        Measure = 64,
        kVariants = 128
    };
    std::array<Program, kVariants> surface_;
    std::unique_ptr<QOpenGLShaderProgram> mask_;
    [[nodiscard]] unsigned variant_of(const ViewItem& item);
    bool compile(unsigned variant);
    void begin(unsigned variant, const DrawView& from);
    std::unordered_map<const DisplayMesh*, Geometry> geometries_;
    std::unordered_map<const SurfaceLayer*, Lighting> lightings_;
    std::map<std::pair<NodeId, std::uint32_t>, Array> arrays_;
    TextureCache textures_;
    LightMapCache light_maps_;
    CausticCache caustics_;
    std::vector<std::shared_ptr<const LightMap>> awaited_;   ///< of the solution that is shown next
    std::vector<CausticList> awaited_caustics_;              ///< likewise
    LightShares shares_;                                     ///< in the vertices' values
    bool caustic_boxes_ = false;                             ///< in what is being drawn
    const std::unordered_set<NodeId>* texel_grid_ = nullptr; ///< likewise
    unsigned white_ = 0;
    unsigned color_map_ = 0;                                                           ///< color_map() as a texture
    const FalseColor* false_color_ = nullptr;                                          ///< in what is being drawn
    std::shared_ptr<const std::vector<SurfaceLandings>> landings_;                     ///< that points_ are of
    std::unordered_map<const SurfaceLandings*, std::pair<unsigned, unsigned>> points_; ///< vertex array and buffer
    void forget_landings();

    struct Probe {
        unsigned texture = 0;
        dvec3 centre{0.0};
        DBox3 room;
    };
    Probe probe_;      ///< complete, in use; texture 0 = none
    Probe next_probe_; ///< being drawn
};

} // namespace atrium::ui
