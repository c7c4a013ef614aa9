// Recovered work in the light of the saved file.
#include "ui/panels/lit_picture.h"

#include "ui/document/sample_room.h"

#include <gtest/gtest.h>

namespace atrium::ui {
namespace {

NodeId named(const Scene& scene, const std::string& name) {
    NodeId out;
    scene.nodes.for_each([&](NodeId id, const Node& n) { out = n.name == name ? id : out; });
    return out;
}

/// Every surface has `lux`, the shelf ten times as much.
Solution even_light(const Scene& scene, float lux) {
    Solution out;
    out.final = true;
    out.mean_radiance = 0.2 * double(lux);
    for (const NodeId id : scene.in_tree_order()) {
        const Shape* shape = scene.shapes.find(scene.nodes.find(id)->shape);
        for (std::uint32_t part = 0; shape != nullptr && part < part_count(*shape); ++part) {
            auto layer = std::make_shared<SurfaceLayer>();
            layer->node = id;
            layer->part = part;
            auto mesh = std::make_shared<DisplayMesh>(make_display_mesh(*shape, part));
            layer->irradiance_front.assign(mesh->positions.size(), Rgb(id == named(scene, "Shelf") ? 10.0F * lux : lux));
            layer->mesh = mesh;
            out.surfaces.push_back(layer);
        }
    }
    return out;
}

const SurfaceLayer* layer_of(const Solution& light, NodeId id) {
    for (const auto& layer : light.surfaces) {
        if (layer->node == id) {
            return layer.get();
        }
    }
    return nullptr;
}

TEST(LitPicture, KnownObjectsKeepTheirLightAndNewOnesHaveTheMean) {
    const Scene saved = sample_room();
    const Solution light = even_light(saved, 100.0F);
    // The same objects under other ids, as another file has them: a node in front of them all.
    Scene changed;
    Node fresh;
    fresh.name = "Fresh";
    fresh.shape = changed.shapes.insert({"Fresh", Box{}, {}});
    changed.roots.push_back(changed.nodes.insert(fresh));
    for (const NodeId id : saved.in_tree_order()) {
        Node copy = *saved.nodes.find(id);
        copy.parent = {};
        copy.children.clear();
        copy.materials.clear();
        copy.transform = decompose(saved.world_matrix(id));
        if (copy.shape) {
            copy.shape = changed.shapes.insert(*saved.shapes.find(copy.shape));
        }
        copy.light = {};
        copy.camera = {};
        changed.roots.push_back(changed.nodes.insert(copy));
    }
    Node& bowl = *changed.nodes.find(named(changed, "Bowl"));
    bowl.shape = changed.shapes.insert({"Bowl", Box{}, {}}); // another shape: its light is not known
    const Solution carried = carried_light(saved, light, changed);
    ASSERT_NE(layer_of(carried, named(changed, "Shelf")), nullptr);
    EXPECT_EQ(layer_of(carried, named(changed, "Shelf"))->irradiance_front[0].g, 1000.0F);
    EXPECT_EQ(layer_of(carried, named(changed, "Vase"))->irradiance_front[0].g, 100.0F);
    for (const char* name : {"Fresh", "Bowl"}) {
        const SurfaceLayer* layer = layer_of(carried, named(changed, name));
        ASSERT_NE(layer, nullptr) << name;
        EXPECT_GT(layer->irradiance_front[0].g, 100.0F) << name;
        EXPECT_LT(layer->irradiance_front[0].g, 1000.0F) << name;
    }
}

TEST(LitPicture, BrighterLightIsABrighterPictureOfTheSameRoom) {
    const Scene room = sample_room();
    const ViewCamera camera = default_camera(room);
    Solution dim = even_light(room, 100.0F);
    Solution bright = even_light(room, 300.0F);
    bright.mean_radiance = dim.mean_radiance; // the same exposure
    const auto mean = [](const QImage& image) {
        double sum = 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                sum += qGray(image.pixel(x, y));
            }
        }
        return sum / (image.width() * image.height());
    };
    const double a = mean(lit_picture(room, dim, camera, {80, 50}));
    const double b = mean(lit_picture(room, bright, camera, {80, 50}));
    EXPECT_GT(a, 20.0);
    EXPECT_GT(b, 1.2 * a);
}

} // namespace
} // namespace atrium::ui
