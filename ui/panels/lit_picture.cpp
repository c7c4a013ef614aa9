#include "ui/panels/lit_picture.h"

#include "engine/view/tone.h"

#include <map>
#include <string>
#include <utility>

namespace atrium::ui {
namespace {

/// Nodes by name and the how-manieth of that name it is.
std::map<std::pair<std::string, int>, NodeId> by_name(const Scene& scene) {
    std::map<std::pair<std::string, int>, NodeId> out;
    std::map<std::string, int> count;
    for (const NodeId id : scene.in_tree_order()) {
        const std::string& name = scene.nodes.find(id)->name;
        out[{name, count[name]++}] = id;
    }
    return out;
}

bool same_shape(const Scene& a, NodeId x, const Scene& b, NodeId y) {
    const Shape* one = a.shapes.find(a.nodes.find(x)->shape);
    const Shape* other = b.shapes.find(b.nodes.find(y)->shape);
    return one != nullptr && other != nullptr && one->geometry == other->geometry;
}

/// The mean of the reflected and direct light on vertices, lux.
Rgb mean_light(const Solution& light) {
    Rgb sum(0.0F);
    std::size_t count = 0;
    for (const auto& layer : light.surfaces) {
        for (std::uint32_t v = 0; v < layer->irradiance_front.size(); ++v) {
            sum += vertex_irradiance(*layer, v, false);
        }
        count += layer->irradiance_front.size();
    }
    return count > 0 ? sum / float(count) : Rgb(0.0F);
}

std::shared_ptr<const SurfaceLayer> even_layer(NodeId id, std::uint32_t part, const Shape& shape, const Rgb& light) {
    auto out = std::make_shared<SurfaceLayer>();
    out->node = id;
    out->part = part;
    auto mesh = std::make_shared<DisplayMesh>(make_display_mesh(shape, part));
    out->irradiance_front.assign(mesh->positions.size(), light);
    out->irradiance_back = out->irradiance_front;
    out->mesh = std::move(mesh);
    return out;
}

} // namespace

Solution carried_light(const Scene& from, const Solution& light, const Scene& to) {
    std::map<std::pair<NodeId, std::uint32_t>, std::shared_ptr<const SurfaceLayer>> stored;
    for (const auto& layer : light.surfaces) {
        stored[{layer->node, layer->part}] = layer;
    }
    Solution out;
    out.final = light.final;
    out.mean_radiance = light.mean_radiance;
    const Rgb mean = mean_light(light);
    const auto before = by_name(from);
    for (const auto& [name, id] : by_name(to)) {
        const Shape* shape = to.shapes.find(to.nodes.find(id)->shape);
        if (shape == nullptr || !to.shown(id)) {
            continue;
        }
        const auto match = before.find(name);
        const bool known = match != before.end() && same_shape(from, match->second, to, id);
        for (std::uint32_t part = 0; part < part_count(*shape); ++part) {
            const auto layer = known ? stored.find({match->second, part}) : stored.end();
            if (layer == stored.end()) {
                out.surfaces.push_back(even_layer(id, part, *shape, mean));
                continue;
            }
            auto moved = std::make_shared<SurfaceLayer>(*layer->second);
            moved->node = id;
            out.surfaces.push_back(std::move(moved));
        }
    }
    return out;
}

QImage lit_picture(const Scene& scene, const Solution& light, const ViewCamera& camera, QSize size) {
    StillOptions options;
    options.width = size.width();
    options.height = size.height();
    const Picture picture = render_still(scene, light, camera, options, {});
    const float exposure = exposure_scale(light.mean_radiance, 0.0F);
    QImage out(size, QImage::Format_RGB32);
    for (int y = 0; y < size.height(); ++y) {
        for (int x = 0; x < size.width(); ++x) {
            const Rgb& radiance = picture.pixels[std::size_t(y) * std::size_t(size.width()) + std::size_t(x)];
            const vec3 c = display_color(radiance, exposure) * 255.0F + 0.5F;
            out.setPixel(x, y, qRgb(int(c.r), int(c.g), int(c.b)));
        }
    }
    return out;
}

} // namespace atrium::ui
