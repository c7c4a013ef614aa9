// The light of GpuScene's surfaces: on vertices, in maps, and what of it is shown.
#include "ui/viewport/gpu_scene.h"

#include <QElapsedTimer>

#include <algorithm>

namespace atrium::ui {
namespace {

/// Light maps of a solution that is not shown yet: no further one is begun after this many milliseconds.
constexpr int kUploadAheadMs = 5;

} // namespace

bool GpuScene::upload_ahead(const Solution& solution) {
    awaited_.clear();
    for (const auto& layer : solution.surfaces) {
        for (const auto& map : {layer->direct_map_front, layer->direct_map_back}) {
            if (map) {
                awaited_.push_back(map);
            }
        }
    }
    QElapsedTimer clock;
    clock.start();
    return std::all_of(awaited_.begin(), awaited_.end(), [&](const auto& map) {
        return light_maps_.ready(*map) || (clock.elapsed() < kUploadAheadMs && light_maps_.upload_some(*gl_, map));
    });
}

bool GpuScene::uploaded(const Solution& solution) const {
    return std::all_of(solution.surfaces.begin(), solution.surfaces.end(), [this](const auto& layer) {
        return (!layer->direct_map_front || light_maps_.ready(*layer->direct_map_front)) &&
               (!layer->direct_map_back || light_maps_.ready(*layer->direct_map_back));
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
        // A map that the driver cannot hold is shown as coarsely as the vertices are.
        const bool coarse = map && light_maps_.too_large(*map);
        for (std::uint32_t i = 0; i < count; ++i) {
            values.push_back(coarse ? irradiance_at(layer, {i, i, i}, vec3(1.0F, 0.0F, 0.0F), back, shares_)
                                    : vertex_irradiance(layer, i, back, shares_));
        }
    }
    gl_->glGenBuffers(1, &l.values);
    gl_->glBindBuffer(GL_ARRAY_BUFFER, l.values);
    gl_->glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(values.size() * sizeof(Rgb)), values.data(), GL_STATIC_DRAW);
    return &l;
}

void GpuScene::draw_mapped(const ViewItem& item, Program& program, const Geometry& geometry, bool has_back) {
    Gl& gl = *gl_;
    const auto draw_with = [&](const std::shared_ptr<const LightMap>& map) {
        const LightMapCache::Texture* found = light_maps_.get(gl, map);
        const LightMapCache::Texture& texture = found != nullptr ? *found : light_maps_.dark();
        gl.glActiveTexture(GL_TEXTURE3);
        gl.glBindTexture(GL_TEXTURE_2D, texture.image);
        gl.glActiveTexture(GL_TEXTURE4);
        gl.glBindTexture(GL_TEXTURE_2D, texture.tiles);
        gl.glUniform1f(program.at("u_map_scale"), texture.scale);
        gl.glDrawElements(GL_TRIANGLES, geometry.count, GL_UNSIGNED_INT, nullptr);
    };
    const SurfaceLayer& layer = *item.layer;
    if (!has_back || !item.material->double_sided) {
        draw_with(layer.direct_map_front);
        return;
    }
    // A side at a time, each with its own map: choosing in the shader would make every fragment pay for both.
    gl.glEnable(GL_CULL_FACE);
    gl.glCullFace(GL_FRONT);
    draw_with(layer.direct_map_back);
    gl.glCullFace(GL_BACK);
    draw_with(layer.direct_map_front);
}

} // namespace atrium::ui
