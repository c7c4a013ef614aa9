#include "ui/viewport/gpu_scene.h"

#include "ui/viewport/gpu_scene_parts.h"

#include <set>
#include <unordered_set>

namespace atrium::ui {
namespace {

/// Flat mirrors with a true picture in one frame; each costs a second drawing of the scene.
constexpr int kMirrors = 2;

/// True when a surface has the amount that is shown: illuminance is for what scatters light.
bool is_known(const Material& m, const FalseColor& scale, bool lit, bool probe) {
    return lit && !m.unlit && (is_metal(m) ? scale.quantity == LightQuantity::Luminance && probe : true);
}
bool is_blended(const Material& m) { return is_glass(m) || m.alpha_mode == Material::Alpha::Blend; }

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

} // namespace atrium::ui
