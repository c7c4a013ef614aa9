// The light of GpuScene's surfaces: on vertices, in maps, in caustic textures, and what of it is shown.
#include "ui/viewport/gpu_scene.h"

#include <QElapsedTimer>

#include <algorithm>

namespace atrium::ui {
namespace {

/// Light of a solution that is not shown yet: no further one is begun after this many milliseconds.
constexpr int kUploadAheadMs = 5;

} // namespace

bool GpuScene::upload_ahead(const Solution& solution) {
    forget_awaited();
    for (const auto& layer : solution.surfaces) {
        for (const auto& map : {layer->direct_map_front, layer->direct_map_back}) {
            if (map) {
                awaited_.push_back(map);
            }
        }
        for (const CausticList* list : {&layer->caustic_textures_front, &layer->caustic_textures_back}) {
            if (!list->empty()) {
                awaited_caustics_.push_back(*list);
            }
        }
    }
    QElapsedTimer clock;
    clock.start();
    const auto there = [&](const auto& all, auto& cache, const auto& what) {
        return std::all_of(all.begin(), all.end(), [&](const auto& one) {
            return cache.ready(what(one)) || (clock.elapsed() < kUploadAheadMs && cache.upload_some(*gl_, one));
        });
    };
    return there(awaited_, light_maps_, [](const auto& map) -> const LightMap& { return *map; }) &&
           there(awaited_caustics_, caustics_, [](const CausticList& list) -> const CausticList& { return list; });
}

bool GpuScene::uploaded(const Solution& solution) const {
    return std::all_of(solution.surfaces.begin(), solution.surfaces.end(), [this](const auto& layer) {
        return (!layer->direct_map_front || light_maps_.ready(*layer->direct_map_front)) &&
               (!layer->direct_map_back || light_maps_.ready(*layer->direct_map_back)) &&
               caustics_.ready(layer->caustic_textures_front) && caustics_.ready(layer->caustic_textures_back);
    });
}

void GpuScene::set_shares(const LightShares& shares) {
    if (shares == shares_) {
        return;
    }
    shares_ = shares;
    for (auto& [key, array] : arrays_) {
        gl_->glDeleteVertexArrays(1, &array.vao);
    }
    arrays_.clear();
    for (auto& [key, lighting] : lightings_) {
        gl_->glDeleteBuffers(1, &lighting.values);
    }
    lightings_.clear();
}

const GpuScene::Lighting* GpuScene::lighting_of(const ViewItem& item) {
    if (!item.layer || item.layer->irradiance_front.size() < item.mesh->positions.size()) {
        return nullptr;
    }
    Lighting& l = lightings_[item.layer.get()];
    if (l.values != 0) {
        return &l;
    }
    const std::size_t count = item.mesh->positions.size();
    const SurfaceLayer& layer = *item.layer;
    l.layer = item.layer;
    l.has_back = layer.irradiance_back.size() >= count;
    std::vector<Rgb> values;
    values.reserve(l.has_back ? 2 * count : count);
    for (const bool back : {false, true}) {
        if (back && !l.has_back) {
            break;
        }
        const auto& map = back ? layer.direct_map_back : layer.direct_map_front;
        const CausticList& textures = back ? layer.caustic_textures_back : layer.caustic_textures_front;
        // What the driver cannot hold is shown as coarsely as the vertices are.
        const bool coarse_map = shares_.direct && map && light_maps_.too_large(*map);
        const bool coarse_caustics = shares_.caustic && caustics_.too_large(textures);
        for (std::uint32_t i = 0; i < count; ++i) {
            Rgb light = vertex_irradiance(layer, i, back, shares_);
            const bool charted = i < item.mesh->light_uv.size() && item.mesh->light_uv[i].x >= 0.0F;
            if (charted && coarse_map) {
                light += map->irradiance(item.mesh->light_uv[i]);
            }
            if (charted && coarse_caustics) {
                for (const auto& texture : textures) {
                    light += texture->irradiance(item.mesh->light_uv[i]);
                }
            }
            values.push_back(light);
        }
    }
    gl_->glGenBuffers(1, &l.values);
    gl_->glBindBuffer(GL_ARRAY_BUFFER, l.values);
    gl_->glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(values.size() * sizeof(Rgb)), values.data(), GL_STATIC_DRAW);
    return &l;
}

void GpuScene::bind_map(Program& program, const std::shared_ptr<const LightMap>& map) {
    const LightMapCache::Texture* found = light_maps_.get(*gl_, map);
    const LightMapCache::Texture& texture = found != nullptr ? *found : light_maps_.dark();
    gl_->glActiveTexture(GL_TEXTURE3);
    gl_->glBindTexture(GL_TEXTURE_2D, texture.image);
    gl_->glActiveTexture(GL_TEXTURE4);
    gl_->glBindTexture(GL_TEXTURE_2D, texture.tiles);
    gl_->glUniform1f(program.at("u_map_scale"), texture.scale);
}

void GpuScene::bind_caustics(Program& program, const CausticList& list) {
    const CausticCache::Texture* found = caustics_.get(*gl_, list);
    if (found == nullptr) {
        gl_->glUniform1i(program.at("u_caustic_count"), 0); // nothing is looked up
        return;
    }
    gl_->glActiveTexture(GL_TEXTURE5);
    gl_->glBindTexture(GL_TEXTURE_2D, found->image);
    gl_->glActiveTexture(GL_TEXTURE6);
    gl_->glBindTexture(GL_TEXTURE_2D, found->boxes);
    gl_->glUniform1i(program.at("u_caustic_count"), found->count);
    gl_->glUniform4f(program.at("u_caustic_bounds"), found->low.x, found->low.y, found->high.x, found->high.y);
    gl_->glUniform1f(program.at("u_caustic_scale"), shares_.caustic ? found->scale : 0.0F);
}

void GpuScene::draw_mapped(const ViewItem& item, unsigned variant, const Geometry& geometry, bool has_back) {
    Gl& gl = *gl_;
    Program& program = surface_[variant];
    const SurfaceLayer& layer = *item.layer;
    const auto draw_side = [&](bool back) {
        if ((variant & Mapped) != 0) {
            bind_map(program, back ? layer.direct_map_back : layer.direct_map_front);
        }
        if ((variant & Caustic) != 0) {
            const bool grid = texel_grid_ != nullptr && texel_grid_->contains(item.node);
            gl.glUniform1f(program.at("u_caustic_grid"), grid ? 1.0F : 0.0F);
            bind_caustics(program, back ? layer.caustic_textures_back : layer.caustic_textures_front);
        }
        gl.glDrawElements(GL_TRIANGLES, geometry.count, GL_UNSIGNED_INT, nullptr);
    };
    if (!has_back || !item.material->double_sided) {
        draw_side(false);
        return;
    }
    // A side at a time, each with its own map: choosing in the shader would make every fragment pay for both.
    gl.glEnable(GL_CULL_FACE);
    gl.glCullFace(GL_FRONT);
    draw_side(true);
    gl.glCullFace(GL_BACK);
    draw_side(false);
}

void GpuScene::make_color_map() {
    Gl& gl = *gl_;
    std::array<std::uint8_t, 3 * kMapColors> colors{};
    for (std::size_t i = 0; i < kMapColors; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            colors[3 * i + c] = std::uint8_t(color_map()[i] >> (16U - 8U * c) & 0xFFU);
        }
    }
    color_map_ = new_texture(gl, GL_LINEAR);
    gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, GLsizei(kMapColors), 1, 0, GL_RGB, GL_UNSIGNED_BYTE, colors.data());
    gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void GpuScene::set_scale(Program& p, float line_width) {
    Gl& gl = *gl_;
    const FalseColor& scale = *false_color_;
    const auto end = [&](double value) { return float(scale.logarithmic ? std::log(value) : value); };
    std::array<float, 24> levels{};
    std::size_t count = 0;
    if (scale.contours) {
        for (const double value : round_values(scale)) {
            if (value > scale.minimum && count < levels.size()) { // no line around what is dark
                levels[count++] = float(value);
            }
        }
    }
    gl.glUniform1i(p.at("u_color_map"), 7);
    gl.glUniform1i(p.at("u_illuminance"), scale.quantity == LightQuantity::Illuminance ? 1 : 0);
    gl.glUniform1i(p.at("u_logarithmic"), scale.logarithmic ? 1 : 0);
    gl.glUniform2f(p.at("u_range"), end(scale.minimum), end(scale.maximum));
    gl.glUniform1i(p.at("u_level_count"), GLint(count));
    gl.glUniform1fv(p.at("u_levels"), GLsizei(levels.size()), levels.data());
    gl.glUniform1f(p.at("u_line"), 0.5F * line_width);
    gl.glActiveTexture(GL_TEXTURE7);
    gl.glBindTexture(GL_TEXTURE_2D, color_map_);
}

} // namespace atrium::ui
