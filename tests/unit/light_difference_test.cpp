// Two solutions compared at the same points of the same surfaces.
#include "engine/measure/light_difference.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace atrium {
namespace {

/// A floor of 2 x 3 m and a small lamp-like square of 1 m2 above it, each with even light.
struct LightDifferenceTest : testing::Test {
    Scene scene;
    NodeId floor, shelf;

    void SetUp() override {
        floor = add("floor", 2.0F, 3.0F, 0.0);
        shelf = add("shelf", 1.0F, 1.0F, 1.0);
    }
    NodeId add(const char* name, float width, float depth, double z) {
        const Shape shape{name, Polygon{{{0, 0}, {width, 0}, {width, depth}, {0, depth}}, {}}, {}};
        Node node;
        node.name = name;
        node.shape = scene.shapes.insert(shape);
        node.materials = {MaterialId{}};
        node.transform.translation.z = z;
        const NodeId id = scene.nodes.next_key();
        EXPECT_TRUE(apply_added(id, node));
        return id;
    }
    bool apply_added(NodeId id, const Node& node) {
        scene.roots.push_back(id);
        return scene.nodes.restore(id, node);
    }
    [[nodiscard]] Solution light(const Rgb& on_floor, const Rgb& on_shelf, bool back = false) const {
        Solution out;
        for (const auto& [id, value] : {std::pair(floor, on_floor), std::pair(shelf, on_shelf)}) {
            auto layer = std::make_shared<SurfaceLayer>();
            layer->node = id;
            const Node& node = *scene.nodes.find(id);
            layer->mesh = std::make_shared<DisplayMesh>(make_display_mesh(*scene.shapes.find(node.shape), 0));
            layer->irradiance_front.assign(layer->mesh->positions.size(), value);
            if (back) {
                layer->irradiance_back.assign(layer->mesh->positions.size(), value * 2.0F);
            }
            out.surfaces.push_back(layer);
        }
        return out;
    }
};

TEST_F(LightDifferenceTest, PlacesAreSpreadByArea) {
    const auto places = spread_places(scene, light(Rgb(1.0F), Rgb(1.0F)), 700);
    ASSERT_EQ(places.size(), 700U);
    std::size_t low = 0;
    dvec3 mean(0.0);
    for (const SensorPlace& place : places) {
        EXPECT_EQ(place.normal, dvec3(0, 0, 1));
        if (place.point.z == 0.0) {
            ++low;
            mean += place.point;
            EXPECT_EQ(place.point, glm::clamp(place.point, dvec3(0.0), dvec3(2, 3, 0)));
        }
    }
    EXPECT_EQ(low, 600U) << "6 of 7 square metres";
    EXPECT_NEAR(mean.x / 600.0, 1.0, 0.02);
    EXPECT_NEAR(mean.y / 600.0, 1.5, 0.03);
    const auto both = spread_places(scene, light(Rgb(1.0F), Rgb(1.0F), true), 700);
    std::size_t up = 0;
    for (const SensorPlace& place : both) {
        up += place.normal.z > 0.0 ? 1U : 0U;
    }
    EXPECT_EQ(up, 350U);
    EXPECT_TRUE(spread_places(scene, Solution(), 10).empty());
}

TEST_F(LightDifferenceTest, FiguresByHand) {
    const Solution a = light(Rgb(10.0F), Rgb(10.0F));
    EXPECT_EQ(light_difference(scene, a, a).rel_rms, 0.0);
    EXPECT_EQ(light_difference(scene, a, a).energy_rel, 0.0);
    EXPECT_EQ(light_difference(scene, a, a).points, 4096U);
    // Seventh part 17 instead of 10: by 7 on one of seven square metres.
    const LightDifference d = light_difference(scene, light(Rgb(10.0F), Rgb(17.0F)), a, 7000);
    EXPECT_NEAR(d.rel_rms, std::sqrt(49.0 / 7.0) / 10.0, 1e-6);
    EXPECT_NEAR(d.rel_max, 7.0 / 10.1, 1e-6);
    EXPECT_NEAR(d.energy_rel, 0.1, 1e-6);
    EXPECT_NEAR(light_difference(scene, light(Rgb(9.0F), Rgb(9.0F)), a).energy_rel, 0.1, 1e-6) << "never negative";
}

TEST(SeenPlaces, LeaveOutTheInsidesOfSolids) {
    Scene room;
    test::add_room(room, 4, 3, 5, test::add_material(room, 0.5F));
    test::add_point_light(room, {2, 2.2, 2.5}, 1000);
    Shape shape;
    shape.geometry = Box{};
    Node crate;
    crate.name = "crate";
    crate.shape = room.shapes.insert(shape);
    crate.materials = {test::add_material(room, 0.5F)};
    crate.transform.translation = {2, 0.5, 2.5}; // a unit box, on the floor
    room.roots.push_back(room.nodes.insert(crate));
    const auto places = seen_places(room, 2000);
    EXPECT_GT(places.size(), 1900U);
    const auto beneath = std::count_if(places.begin(), places.end(), [](const SensorPlace& p) {
        return p.point.y < 1e-6 && std::abs(p.point.x - 2.0) < 0.5 && std::abs(p.point.z - 2.5) < 0.5;
    });
    EXPECT_EQ(beneath, 0) << "a square metre of floor lies inside the crate";
    EXPECT_TRUE(std::any_of(places.begin(), places.end(), [](const SensorPlace& p) { return p.point.y < 1e-6; }));
}

TEST_F(LightDifferenceTest, ColourCountsWhereBrightnessIsTheSame) {
    const Solution a = light(Rgb(1.0F, 0.0F, 0.0F), Rgb(1.0F, 0.0F, 0.0F));
    const Solution b = light(Rgb(0.0F, 0.2126F / 0.7152F, 0.0F), Rgb(0.0F, 0.2126F / 0.7152F, 0.0F));
    EXPECT_GT(light_difference(scene, a, b).rel_rms, 1.0);
}

} // namespace
} // namespace atrium
