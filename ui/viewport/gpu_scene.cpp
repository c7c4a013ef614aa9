#include "ui/viewport/gpu_scene.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <unordered_set>

namespace atrium::ui {
namespace {

constexpr int kProbeSize = 128;
constexpr int kProbeLevels = 6;

/// Flat mirrors with a true picture in one frame; each costs a second drawing of the scene.
constexpr int kMirrors = 2;

struct Vertex {
    vec3 position;
    std::uint32_t normal = 0; ///< 2_10_10_10, signed
    vec2 uv0{0.0F};
    vec2 uv1{0.0F};
    vec3 color{1.0F};
};

std::uint32_t pack_normal(const vec3& n) {
    const auto ten_bits = [](float x) {
        return std::uint32_t(std::int32_t(std::lround(std::clamp(x, -1.0F, 1.0F) * 511.0F))) & 0x3FFU;
    };
    return ten_bits(n.x) | (ten_bits(n.y) << 10U) | (ten_bits(n.z) << 20U);
}

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

/// True when a box lies wholly outside one side of the view's window (x and y from, x and y to; -1 to 1 is all).
bool out_of_sight(const Box3& box, const mat4& mvp, const vec4& window = vec4(-1.0F, -1.0F, 1.0F, 1.0F)) {
    std::array<int, 6> outside{};
    for (int i = 0; i < 8; ++i) {
        const vec4 p = mvp * vec4((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                                  (i & 4) != 0 ? box.max.z : box.min.z, 1.0F);
        outside[0] += p.x < window.x * p.w;
        outside[1] += p.x > window.z * p.w;
        outside[2] += p.y < window.y * p.w;
        outside[3] += p.y > window.w * p.w;
        outside[4] += p.z < -p.w;
        outside[5] += p.z > p.w;
    }
    return std::find(outside.begin(), outside.end(), 8) != outside.end();
}

/// The part of the view that a box can cover.
vec4 window_of(const Box3& box, const mat4& mvp) {
    vec4 window(1.0F, 1.0F, -1.0F, -1.0F);
    for (int i = 0; i < 8; ++i) {
        const vec4 p = mvp * vec4((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                                  (i & 4) != 0 ? box.max.z : box.min.z, 1.0F);
        if (p.w < 1e-4F) {
            return vec4(-1.0F, -1.0F, 1.0F, 1.0F);
        }
        window.x = std::min(window.x, p.x / p.w);
        window.y = std::min(window.y, p.y / p.w);
        window.z = std::max(window.z, p.x / p.w);
        window.w = std::max(window.w, p.y / p.w);
    }
    return glm::clamp(window, vec4(-1.0F), vec4(1.0F));
}

bool is_glass(const Material& m) {
    const MaterialKind kind = classify(m);
    return kind == MaterialKind::DielectricThin || kind == MaterialKind::DielectricSolid;
}
bool is_metal(const Material& m) {
    const MaterialKind kind = classify(m);
    return kind == MaterialKind::Mirror || kind == MaterialKind::Glossy;
}
/// True when a surface has the amount that is shown: illuminance is for what scatters light.
bool is_known(const Material& m, const FalseColor& scale, bool lit, bool probe) {
    return lit && !m.unlit && (is_metal(m) ? scale.quantity == LightQuantity::Luminance && probe : true);
}
bool is_blended(const Material& m) { return is_glass(m) || m.alpha_mode == Material::Alpha::Blend; }

dmat4 relative_to_eye(const ViewItem& item, const dvec3& eye) {
    dmat4 m = item.world;
    m[3] -= dvec4(eye, 0.0);
    return m;
}

} // namespace

bool GpuScene::initialize(Gl& gl) {
    gl_ = &gl;
    mask_ = load_program("mask.vert", "mask.frag");
    if (!mask_ || !compile(0) || !compile(Headlight)) {
        return false;
    }
    const std::array<std::uint8_t, 4> pixel{255, 255, 255, 255};
    gl.glGenTextures(1, &white_);
    gl.glBindTexture(GL_TEXTURE_2D, white_);
    gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    make_color_map();
    light_maps_.initialize(gl);
    caustics_.initialize(gl);
    return true;
}

void GpuScene::forget(const Geometry& geometry) {
    gl_->glDeleteBuffers(1, &geometry.vertices);
    gl_->glDeleteBuffers(1, &geometry.indices);
    gl_->glDeleteBuffers(1, &geometry.light_uv);
}

void GpuScene::release() {
    if (gl_ == nullptr) {
        return;
    }
    for (auto& [key, array] : arrays_) {
        gl_->glDeleteVertexArrays(1, &array.vao);
    }
    for (auto& [key, geometry] : geometries_) {
        forget(geometry);
    }
    for (auto& [key, lighting] : lightings_) {
        gl_->glDeleteBuffers(1, &lighting.values);
    }
    arrays_.clear();
    geometries_.clear();
    lightings_.clear();
    textures_.release(*gl_);
    light_maps_.release(*gl_);
    caustics_.release(*gl_);
    forget_awaited();
    forget_landings();
    gl_->glDeleteTextures(1, &white_);
    gl_->glDeleteTextures(1, &color_map_);
    gl_->glDeleteTextures(1, &probe_.texture);
    gl_->glDeleteTextures(1, &next_probe_.texture);
    white_ = color_map_ = 0;
    probe_ = next_probe_ = {};
    surface_ = {};
    mask_.reset();
    gl_ = nullptr;
}

int GpuScene::Program::at(const char* name) {
    const auto found = locations.find(name);
    return found != locations.end() ? found->second : locations.emplace(name, program->uniformLocation(name)).first->second;
}

unsigned GpuScene::variant_of(const ViewItem& item) {
    const Material& m = *item.material;
    unsigned out = 0;
    if (m.base_color_texture || m.emissive_texture || m.alpha_mode == Material::Alpha::Mask) {
        out |= Textured;
    }
    const bool lit = item.layer && item.layer->irradiance_front.size() >= item.mesh->positions.size();
    if (is_glass(m) || (is_metal(m) && lit)) {
        out |= Specular;
    }
    if (!lit) {
        out |= Headlight;
    } else if (!item.mesh->light_uv.empty()) {
        const SurfaceLayer& layer = *item.layer;
        const bool has_back = layer.has_back() && m.double_sided;
        if (shares_.direct) {
            const bool front = light_maps_.get(*gl_, layer.direct_map_front) != nullptr;
            const bool back = has_back && light_maps_.get(*gl_, layer.direct_map_back) != nullptr;
            out |= front || back ? Mapped : 0U;
        }
        if (shares_.caustic || caustic_boxes_ || (texel_grid_ != nullptr && texel_grid_->contains(item.node))) {
            const bool front = caustics_.get(*gl_, layer.caustic_textures_front) != nullptr;
            const bool back = has_back && caustics_.get(*gl_, layer.caustic_textures_back) != nullptr;
            out |= front || back ? Caustic : 0U;
        }
    }
    return out;
}

bool GpuScene::compile(unsigned variant) {
    if (!surface_[variant].program) {
        QByteArray defines;
        defines += (variant & Textured) != 0 ? "#define TEXTURED\n" : "";
        defines += (variant & Specular) != 0 ? "#define SPECULAR\n" : "";
        defines += (variant & Headlight) != 0 ? "#define HEADLIGHT\n" : "";
        defines += (variant & Cut) != 0 ? "#define CUT\n" : "";
        defines += (variant & Mapped) != 0 ? "#define LIGHT_MAP\n" : "";
        defines += (variant & Caustic) != 0 ? "#define CAUSTICS\n" : "";
        defines += (variant & Measure) != 0 ? "#define MEASURE\n" : "";
        surface_[variant].program = load_program("surface.vert", "surface.frag", defines);
    }
    return surface_[variant].program != nullptr;
}

void GpuScene::begin(unsigned variant, const DrawView& from) {
    Gl& gl = *gl_;
    Program& p = surface_[variant];
    p.program->bind();
    const bool probe = probe_.texture != 0 && from.use_probe;
    gl.glUniform1i(p.at("u_base_texture"), 0);
    gl.glUniform1i(p.at("u_emissive_texture"), 1);
    gl.glUniform1i(p.at("u_probe"), 2);
    if ((variant & Mapped) != 0) {
        gl.glUniform1i(p.at("u_map"), 3);
        gl.glUniform1i(p.at("u_map_tiles"), 4);
    }
    if ((variant & Caustic) != 0) {
        gl.glUniform1i(p.at("u_caustic_image"), 5);
        gl.glUniform1i(p.at("u_caustic_boxes"), 6);
        gl.glUniform1f(p.at("u_caustic_outline"), caustic_boxes_ ? 1.0F : 0.0F);
    }
    if ((variant & Measure) != 0) {
        set_scale(p, from.line_width);
    }
    gl.glUniform1f(p.at("u_exposure"), from.exposure);
    gl.glUniform4f(p.at("u_clip"), from.clip.x, from.clip.y, from.clip.z, from.clip.w);
    gl.glUniform3f(p.at("u_filter"), from.filter.r, from.filter.g, from.filter.b);
    gl.glUniform1i(p.at("u_linear"), from.linear ? 1 : 0);
    gl.glUniform1i(p.at("u_has_probe"), probe ? 1 : 0);
    gl.glUniform1f(p.at("u_probe_levels"), float(kProbeLevels));
    const auto relative = [&](const char* name, const dvec3& point) {
        const vec3 r(point - from.eye);
        gl.glUniform3f(p.at(name), r.x, r.y, r.z);
    };
    relative("u_probe_centre", probe_.centre);
    relative("u_room_min", probe_.room.min);
    relative("u_room_max", probe_.room.max);
    if ((variant & Cut) != 0) {
        const vec3 side(from.cutaway.side());
        gl.glUniform3f(p.at("u_cut_side"), side.x, side.y, side.z);
        gl.glUniform1f(p.at("u_cut_facing"), float(Cutaway::kFacing));
        relative("u_cut_plane", from.cutaway.plane());
    }
    gl.glActiveTexture(GL_TEXTURE2);
    gl.glBindTexture(GL_TEXTURE_CUBE_MAP, probe ? probe_.texture : 0);
}

void GpuScene::collect(const ViewScene& view, const Scene& scene) {
    std::unordered_map<const DisplayMesh*, bool> meshes;
    std::unordered_map<const SurfaceLayer*, bool> layers;
    std::map<std::pair<NodeId, std::uint32_t>, bool> keys;
    for (const ViewItem& item : view.items()) {
        meshes[item.mesh.get()] = true;
        layers[item.layer.get()] = true;
        keys[{item.node, item.part}] = true;
    }
    std::erase_if(arrays_, [&](auto& entry) {
        const bool gone = !keys.contains(entry.first) || !meshes.contains(entry.second.mesh) ||
                          (entry.second.layer != nullptr && !layers.contains(entry.second.layer));
        if (gone) {
            gl_->glDeleteVertexArrays(1, &entry.second.vao);
        }
        return gone;
    });
    std::erase_if(geometries_, [&](auto& entry) {
        const bool gone = !meshes.contains(entry.first);
        if (gone) {
            forget(entry.second);
        }
        return gone;
    });
    std::erase_if(lightings_, [&](auto& entry) {
        const bool gone = !layers.contains(entry.first);
        if (gone) {
            gl_->glDeleteBuffers(1, &entry.second.values);
        }
        return gone;
    });
    std::unordered_set<const LightMap*> maps;
    std::set<CausticList> caustics(awaited_caustics_.begin(), awaited_caustics_.end());
    for (const ViewItem& item : view.items()) {
        if (item.layer) {
            maps.insert(item.layer->direct_map_front.get());
            maps.insert(item.layer->direct_map_back.get());
            caustics.insert(item.layer->caustic_textures_front);
            caustics.insert(item.layer->caustic_textures_back);
        }
    }
    for (const auto& map : awaited_) {
        maps.insert(map.get());
    }
    light_maps_.collect(*gl_, maps);
    caustics_.collect(*gl_, caustics);
    textures_.collect(*gl_, scene);
}

const GpuScene::Geometry& GpuScene::geometry_of(const ViewItem& item) {
    Geometry& g = geometries_[item.mesh.get()];
    if (g.vertices != 0) {
        return g;
    }
    const DisplayMesh& mesh = *item.mesh;
    std::vector<Vertex> vertices(mesh.positions.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        Vertex& v = vertices[i];
        v.position = mesh.positions[i];
        v.normal = i < mesh.normals.size() ? pack_normal(mesh.normals[i]) : pack_normal(vec3(0, 0, 1));
        v.uv0 = i < mesh.texcoords0.size() ? mesh.texcoords0[i] : vec2(0.0F);
        v.uv1 = i < mesh.texcoords1.size() ? mesh.texcoords1[i] : vec2(0.0F);
        v.color = i < mesh.colors.size() ? mesh.colors[i] : vec3(1.0F);
    }
    if (mesh.indices.size() >= 3 && mesh.normals.size() == mesh.positions.size()) {
        const vec3 origin = mesh.positions[mesh.indices[0]];
        g.normal = mesh.normals[mesh.indices[0]];
        const float tolerance = 1e-4F * item.bvh->bounds().diagonal();
        g.flat = true;
        for (std::size_t i = 0; i < mesh.positions.size() && g.flat; ++i) {
            g.flat = std::abs(glm::dot(mesh.positions[i] - origin, g.normal)) <= tolerance &&
                     glm::dot(mesh.normals[i], g.normal) > 0.9999F;
        }
    }
    g.mesh = item.mesh;
    g.count = int(mesh.indices.size());
    gl_->glBindVertexArray(0);
    gl_->glGenBuffers(1, &g.vertices);
    gl_->glBindBuffer(GL_ARRAY_BUFFER, g.vertices);
    gl_->glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(), GL_STATIC_DRAW);
    gl_->glGenBuffers(1, &g.indices);
    gl_->glBindBuffer(GL_ARRAY_BUFFER, g.indices);
    gl_->glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(mesh.indices.size() * sizeof(std::uint32_t)), mesh.indices.data(),
                      GL_STATIC_DRAW);
    if (mesh.light_uv.size() == mesh.positions.size()) {
        gl_->glGenBuffers(1, &g.light_uv);
        gl_->glBindBuffer(GL_ARRAY_BUFFER, g.light_uv);
        gl_->glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(mesh.light_uv.size() * sizeof(vec2)), mesh.light_uv.data(),
                          GL_STATIC_DRAW);
    }
    return g;
}

void GpuScene::bind(const ViewItem& item, const Geometry& geometry, const Lighting* lighting) {
    Array& array = arrays_[{item.node, item.part}];
    const SurfaceLayer* layer = lighting != nullptr ? item.layer.get() : nullptr;
    if (array.vao != 0 && array.mesh == item.mesh.get() && array.layer == layer) {
        gl_->glBindVertexArray(array.vao);
        return;
    }
    if (array.vao == 0) {
        gl_->glGenVertexArrays(1, &array.vao);
    }
    array.mesh = item.mesh.get();
    array.layer = layer;
    gl_->glBindVertexArray(array.vao);
    gl_->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, geometry.indices);
    gl_->glBindBuffer(GL_ARRAY_BUFFER, geometry.vertices);
    const auto attribute = [&](GLuint index, GLint size, GLenum type, std::size_t at_byte) {
        gl_->glEnableVertexAttribArray(index);
        gl_->glVertexAttribPointer(index, size, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE, sizeof(Vertex),
                                   offset(at_byte));
    };
    attribute(0, 3, GL_FLOAT, offsetof(Vertex, position));
    attribute(1, 4, GL_INT_2_10_10_10_REV, offsetof(Vertex, normal));
    attribute(2, 2, GL_FLOAT, offsetof(Vertex, uv0));
    attribute(3, 2, GL_FLOAT, offsetof(Vertex, uv1));
    attribute(4, 3, GL_FLOAT, offsetof(Vertex, color));
    if (geometry.light_uv != 0) {
        gl_->glBindBuffer(GL_ARRAY_BUFFER, geometry.light_uv);
        gl_->glEnableVertexAttribArray(7);
        gl_->glVertexAttribPointer(7, 2, GL_FLOAT, GL_FALSE, sizeof(vec2), nullptr);
    } else {
        gl_->glDisableVertexAttribArray(7);
    }
    for (const GLuint index : {5U, 6U}) {
        const bool present = lighting != nullptr && (index == 5 || lighting->has_back);
        if (!present) {
            gl_->glDisableVertexAttribArray(index);
            continue;
        }
        gl_->glBindBuffer(GL_ARRAY_BUFFER, lighting->values);
        gl_->glEnableVertexAttribArray(index);
        gl_->glVertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, sizeof(Rgb),
                                   offset(index == 5 ? 0 : item.mesh->positions.size() * sizeof(Rgb)));
    }
}

void GpuScene::set_sides(const ViewItem& item, bool reflected) {
    // glTF: a mirroring transform turns the winding round, so that the front stays the front.
    gl_->glFrontFace(item.mirrored != reflected ? GL_CW : GL_CCW);
    if (item.material->double_sided) {
        gl_->glDisable(GL_CULL_FACE);
    } else {
        gl_->glEnable(GL_CULL_FACE);
    }
}

void GpuScene::draw_surface(const ViewItem& item, unsigned variant, const Scene& scene, const DrawView& from,
                            const mat4& mvp) {
    Program& p = surface_[variant];
    const auto at = [&p](const char* name) { return p.at(name); };
    const Material& m = *item.material;
    const Geometry& geometry = geometry_of(item);
    const Lighting* lighting = lighting_of(item);
    Gl& gl = *gl_;
    set_sides(item, from.reflected);
    const mat4 model(relative_to_eye(item, from.eye));
    const mat3 normal = item.flattened ? mat3(model) : mat3(glm::transpose(glm::inverse(dmat3(item.world))));
    gl.glUniformMatrix4fv(at("u_mvp"), 1, GL_FALSE, &mvp[0][0]);
    gl.glUniformMatrix4fv(at("u_model"), 1, GL_FALSE, &model[0][0]);
    gl.glUniformMatrix3fv(at("u_normal"), 1, GL_FALSE, &normal[0][0]);
    gl.glUniform4f(at("u_base"), m.base_color.r, m.base_color.g, m.base_color.b, m.alpha);
    const Rgb emitted = shares_.direct ? m.emitted_radiance() : Rgb(0.0F);
    gl.glUniform3f(at("u_emitted"), emitted.r, emitted.g, emitted.b);
    const auto texture = [&](const TextureRef& ref, int unit, const char* textured, const char* set, const char* row0,
                             const char* row1) {
        const unsigned name = ref ? textures_.get(gl, scene, ref.texture) : 0;
        gl.glUniform1i(at(textured), name != 0 ? 1 : 0);
        gl.glActiveTexture(GL_TEXTURE0 + GLenum(unit));
        gl.glBindTexture(GL_TEXTURE_2D, name != 0 ? name : white_);
        if (name != 0) {
            const vec2 zero = ref.apply(vec2(0.0F));
            const vec2 u = ref.apply(vec2(1.0F, 0.0F)) - zero;
            const vec2 v = ref.apply(vec2(0.0F, 1.0F)) - zero;
            gl.glUniform1i(at(set), ref.texcoord);
            gl.glUniform3f(at(row0), u.x, v.x, zero.x);
            gl.glUniform3f(at(row1), u.y, v.y, zero.y);
        }
    };
    if ((variant & Textured) != 0) {
        texture(m.base_color_texture, 0, "u_base_textured", "u_base_set", "u_base_row0", "u_base_row1");
        texture(m.emissive_texture, 1, "u_emissive_textured", "u_emissive_set", "u_emissive_row0", "u_emissive_row1");
    }
    gl.glUniform1i(at("u_has_back"), lighting != nullptr && lighting->has_back ? 1 : 0);
    gl.glUniform1i(at("u_unlit_material"), m.unlit ? 1 : 0);
    gl.glUniform1i(at("u_alpha_mode"), int(m.alpha_mode));
    gl.glUniform1f(at("u_alpha_cutoff"), m.alpha_cutoff);
    gl.glUniform1i(at("u_kind"), is_glass(m) ? 2 : (is_metal(m) ? 1 : 0));
    gl.glUniform1f(at("u_roughness"), m.roughness);
    if ((variant & Measure) != 0) {
        const bool probe = probe_.texture != 0 && from.use_probe;
        gl.glUniform1i(at("u_known"), is_known(m, *false_color_, (variant & Headlight) == 0, probe) ? 1 : 0);
    }
    const float f = (m.ior - 1.0F) / (m.ior + 1.0F);
    gl.glUniform1f(at("u_f0"), f * f);
    gl.glUniform1f(at("u_diffuse_share"), m.metallic + (1.0F - m.metallic) * (1.0F - m.transmission));
    bind(item, geometry, lighting);
    if ((variant & (Mapped | Caustic)) != 0) {
        draw_mapped(item, variant, geometry, lighting != nullptr && lighting->has_back);
    } else {
        gl.glDrawElements(GL_TRIANGLES, geometry.count, GL_UNSIGNED_INT, nullptr);
    }
}

int GpuScene::draw(const ViewScene& view, const Scene& scene, const DrawView& from) {
    Gl& gl = *gl_;
    gl.glEnable(GL_DEPTH_TEST);
    gl.glDepthMask(GL_TRUE);
    gl.glDisable(GL_BLEND);
    gl.glCullFace(GL_BACK);
    set_shares(from.shares);
    caustic_boxes_ = from.caustic_boxes && !from.linear;
    texel_grid_ = from.linear ? nullptr : from.texel_grid;
    false_color_ = from.linear ? nullptr : from.false_color;

    const dmat4 view_projection = from.projection * from.rotation;
    struct Visible {
        const ViewItem* item;
        unsigned variant;
        double distance;
        mat4 mvp;
    };
    std::vector<Visible> opaque;
    std::vector<Visible> blended;
    for (const ViewItem& item : view.items()) {
        const mat4 mvp(view_projection * relative_to_eye(item, from.eye));
        const Cutaway::Part cut = from.cutaway.part_of(item.bounds);
        if (cut == Cutaway::Part::All) {
            continue;
        }
        if (out_of_sight(item.bvh->bounds(), mvp, from.window)) {
            continue;
        }
        if (false_color_ != nullptr && is_glass(*item.material)) {
            continue; // a colour over another would stand for an amount that is nowhere
        }
        const unsigned variant = variant_of(item) | (cut == Cutaway::Part::Some ? unsigned(Cut) : 0U) |
                                 (false_color_ != nullptr ? unsigned(Measure) : 0U);
        if (!compile(variant)) {
            continue;
        }
        const dvec3 centre(item.world * dvec4(dvec3(item.bvh->bounds().centre()), 1.0));
        (is_blended(*item.material) && false_color_ == nullptr ? blended : opaque)
            .push_back({&item, variant, glm::length(centre - from.eye), mvp});
    }
    // Few changes of program, and near things first, so that what they hide is not shaded.
    std::stable_sort(opaque.begin(), opaque.end(), [](const Visible& a, const Visible& b) {
        return a.variant != b.variant ? a.variant < b.variant : a.distance < b.distance;
    });
    std::stable_sort(blended.begin(), blended.end(),
                     [](const Visible& a, const Visible& b) { return a.distance > b.distance; });
    unsigned bound = kVariants;
    const auto draw_all = [&](const std::vector<Visible>& list) {
        for (const Visible& v : list) {
            if (v.variant != bound) {
                bound = v.variant;
                begin(bound, from);
            }
            draw_surface(*v.item, v.variant, scene, from, v.mvp);
        }
    };
    draw_all(opaque);
    // A mirror has the luminance of what it shows, and no illuminance.
    if (!from.linear && !from.reflected && (false_color_ == nullptr || false_color_->quantity == LightQuantity::Luminance)) {
        int mirrors = 0;
        for (const Visible& v : opaque) {
            const Geometry& geometry = geometry_of(*v.item);
            if (classify(*v.item->material) == MaterialKind::Mirror && geometry.flat && !v.item->flattened &&
                v.item->layer && mirrors < kMirrors) {
                draw_mirror(*v.item, view, scene, from, v.mvp, ++mirrors);
                bound = kVariants;
            }
        }
    }
    if (!blended.empty()) {
        gl.glEnable(GL_BLEND);
        gl.glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
        gl.glDepthMask(GL_FALSE);
        draw_all(blended);
        gl.glDepthMask(GL_TRUE);
        gl.glDisable(GL_BLEND);
    }
    gl.glFrontFace(GL_CCW);
    gl.glDisable(GL_CULL_FACE);
    gl.glBindVertexArray(0);
    gl.glUseProgram(0);
    return int(opaque.size() + blended.size());
}

void GpuScene::draw_flat(const ViewItem& item, const mat4& mvp, const vec4& color) {
    mask_->bind();
    mask_->setUniformValue("u_color", QVector4D(color.r, color.g, color.b, color.a));
    gl_->glUniformMatrix4fv(mask_->uniformLocation("u_mvp"), 1, GL_FALSE, &mvp[0][0]);
    set_sides(item, false);
    const Geometry& geometry = geometry_of(item);
    bind(item, geometry, lighting_of(item));
    gl_->glDrawElements(GL_TRIANGLES, geometry.count, GL_UNSIGNED_INT, nullptr);
    mask_->release();
}

void GpuScene::draw_mirror(const ViewItem& item, const ViewScene& view, const Scene& scene, const DrawView& from,
                           const mat4& mvp, int stencil) {
    const Geometry& geometry = geometry_of(item);
    const dvec3 point(item.world * dvec4(dvec3(item.mesh->positions[item.mesh->indices[0]]), 1.0));
    dvec3 normal = glm::normalize(glm::transpose(glm::inverse(dmat3(item.world))) * dvec3(geometry.normal));
    const double height = glm::dot(from.eye - point, normal);
    if (height < 0.0) {
        if (!item.material->double_sided) {
            return;
        }
        normal = -normal;
    }
    Gl& gl = *gl_;
    const vec4 background(from.background, 1.0F);
    // Where the mirror is seen ...
    gl.glEnable(GL_STENCIL_TEST);
    gl.glStencilFunc(GL_ALWAYS, stencil, 0xFF);
    gl.glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    gl.glDepthFunc(GL_LEQUAL);
    gl.glEnable(GL_POLYGON_OFFSET_FILL); // another program need not give the very same depth
    gl.glPolygonOffset(-1.0F, -1.0F);
    draw_flat(item, mvp, background);
    gl.glDisable(GL_POLYGON_OFFSET_FILL);
    // ... nothing is near any more ...
    gl.glStencilFunc(GL_EQUAL, stencil, 0xFF);
    gl.glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    gl.glDepthFunc(GL_ALWAYS);
    gl.glDepthRange(1.0, 1.0);
    draw_flat(item, mvp, background);
    gl.glDepthRange(0.0, 1.0);
    gl.glDepthFunc(GL_LESS);
    // ... so that the room shows, seen from behind the mirror ...
    DrawView behind = from;
    behind.reflected = true;
    behind.cutaway = {}; // a mirror shows the walls
    const dmat3 reflection = dmat3(1.0) - 2.0 * glm::outerProduct(normal, normal);
    behind.rotation = from.rotation * dmat4(reflection);
    behind.eye = from.eye - normal * (2.0 * glm::dot(from.eye - point, normal));
    // A millimetre in front, so that the mirror does not hide what it shows.
    behind.clip = vec4(vec3(normal), float(glm::dot(behind.eye - point, normal) - 0.001));
    behind.window = window_of(item.bvh->bounds(), mvp);
    behind.filter = glm::clamp(item.material->base_color, Rgb(0.0F), Rgb(1.0F));
    gl.glEnable(GL_CLIP_DISTANCE0);
    draw(view, scene, behind);
    gl.glDisable(GL_CLIP_DISTANCE0);
    // ... and later things are in front of the mirror or behind it as before.
    gl.glDepthFunc(GL_ALWAYS);
    gl.glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl.glEnable(GL_DEPTH_TEST);
    draw_flat(item, mvp, background);
    gl.glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.glDepthFunc(GL_LESS);
    gl.glDisable(GL_STENCIL_TEST);
}

void GpuScene::draw_mask(const ViewScene& view, const DrawView& from, const vec4& color,
                         const std::function<bool(const ViewItem&)>& wanted) {
    mask_->bind();
    mask_->setUniformValue("u_color", QVector4D(color.r, color.g, color.b, color.a));
    const int place = mask_->uniformLocation("u_mvp");
    const dmat4 view_projection = from.projection * from.rotation;
    for (const ViewItem& item : view.items()) {
        if (!wanted(item)) {
            continue;
        }
        const mat4 mvp(view_projection * relative_to_eye(item, from.eye));
        if (out_of_sight(item.bvh->bounds(), mvp)) {
            continue;
        }
        const Geometry& geometry = geometry_of(item);
        set_sides(item, false);
        gl_->glUniformMatrix4fv(place, 1, GL_FALSE, &mvp[0][0]);
        bind(item, geometry, lighting_of(item));
        gl_->glDrawElements(GL_TRIANGLES, geometry.count, GL_UNSIGNED_INT, nullptr);
    }
    gl_->glFrontFace(GL_CCW);
    gl_->glDisable(GL_CULL_FACE);
    gl_->glBindVertexArray(0);
    mask_->release();
}

void GpuScene::draw_edges(const ViewScene& view, const DrawView& from) {
    gl_->glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    gl_->glEnable(GL_POLYGON_OFFSET_LINE);
    gl_->glPolygonOffset(-1.0F, -1.0F);
    gl_->glEnable(GL_BLEND);
    gl_->glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    draw_mask(view, from, vec4(0.05F, 0.1F, 0.2F, 0.45F),
              [&from](const ViewItem& item) { return from.cutaway.part_of(item.bounds) != Cutaway::Part::All; });
    gl_->glDisable(GL_BLEND);
    gl_->glDisable(GL_POLYGON_OFFSET_LINE);
    gl_->glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

bool GpuScene::begin_probe(const ViewScene& view, const DBox3& room) {
    const bool wanted = !room.empty() && std::any_of(view.items().begin(), view.items().end(), [](const ViewItem& item) {
        return is_glass(*item.material) || is_metal(*item.material);
    });
    Gl& gl = *gl_;
    if (!wanted) {
        gl.glDeleteTextures(1, &probe_.texture);
        probe_ = {};
        return false;
    }
    if (next_probe_.texture == 0) {
        gl.glGenTextures(1, &next_probe_.texture);
        gl.glBindTexture(GL_TEXTURE_CUBE_MAP, next_probe_.texture);
        for (GLenum face = 0; face < 6; ++face) {
            gl.glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA16F, kProbeSize, kProbeSize, 0, GL_RGBA,
                            GL_FLOAT, nullptr);
        }
        gl.glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        gl.glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        gl.glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl.glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        gl.glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    }
    next_probe_.room = room;
    next_probe_.centre = room.centre();
    return true;
}

void GpuScene::draw_probe_face(const ViewScene& view, const Scene& scene, unsigned face, float exposure,
                               const LightShares& shares) {
    Gl& gl = *gl_;
    unsigned framebuffer = 0;
    unsigned depth = 0;
    gl.glGenFramebuffers(1, &framebuffer);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.glGenRenderbuffers(1, &depth);
    gl.glBindRenderbuffer(GL_RENDERBUFFER, depth);
    gl.glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, kProbeSize, kProbeSize);
    gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    gl.glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_CUBE_MAP_POSITIVE_X + face,
                              next_probe_.texture, 0);
    gl.glViewport(0, 0, kProbeSize, kProbeSize);

    // Cube map faces look along +x -x +y -y +z -z with these upward directions (OpenGL's own convention).
    constexpr std::array<std::array<int, 6>, 6> kFaces{{{1, 0, 0, 0, -1, 0},
                                                        {-1, 0, 0, 0, -1, 0},
                                                        {0, 1, 0, 0, 0, 1},
                                                        {0, -1, 0, 0, 0, -1},
                                                        {0, 0, 1, 0, -1, 0},
                                                        {0, 0, -1, 0, -1, 0}}};
    const auto& f = kFaces[face];
    const dvec3 ahead(f[0], f[1], f[2]);
    const dvec3 up(f[3], f[4], f[5]);
    const dvec3 right = glm::cross(ahead, up);
    DrawView from;
    from.eye = next_probe_.centre;
    from.exposure = exposure;
    from.linear = true;
    from.use_probe = false;
    from.shares = shares;
    from.rotation = glm::transpose(dmat4(dvec4(right, 0), dvec4(up, 0), dvec4(-ahead, 0), dvec4(0, 0, 0, 1)));
    const double near_plane = 0.02;
    const double far_plane = std::max(2.0 * next_probe_.room.diagonal(), 10.0);
    from.projection = dmat4(0.0);
    from.projection[0][0] = from.projection[1][1] = 1.0;
    from.projection[2][2] = -(far_plane + near_plane) / (far_plane - near_plane);
    from.projection[2][3] = -1.0;
    from.projection[3][2] = -2.0 * far_plane * near_plane / (far_plane - near_plane);
    const Rgb sky = scene.environment.sky_radiance;
    gl.glClearColor(sky.r, sky.g, sky.b, 1.0F);
    gl.glDepthMask(GL_TRUE);
    gl.glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw(view, scene, from);
    gl.glDeleteFramebuffers(1, &framebuffer);
    gl.glDeleteRenderbuffers(1, &depth);
    if (face == 5) {
        gl.glBindTexture(GL_TEXTURE_CUBE_MAP, next_probe_.texture);
        gl.glGenerateMipmap(GL_TEXTURE_CUBE_MAP);
        std::swap(probe_, next_probe_);
    }
}

} // namespace atrium::ui
