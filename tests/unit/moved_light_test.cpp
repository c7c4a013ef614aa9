// Where light cannot have changed although something moved: scouting rays and sight between tiles and boxes.
#include "engine/radiosity/box_sight.h"
#include "engine/radiosity/light_shafts.h"
#include "tests/support/light_cases.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <random>

namespace atrium {
namespace {

using namespace test;

/// Two rooms with a wall between them, both with a lamp and sun through a hole in the ceiling; a box moves in the left one.
struct TwoRooms {
    Scene scene;
    NodeId box;
    std::unique_ptr<RayScene> before, rays;
    std::vector<Box3> boxes;

    explicit TwoRooms(const dvec3& by, bool mirror = false) {
        const MaterialId grey = add_material(scene, 0.5F);
        for (const double x : {-2.0, 2.0}) {
            add_rectangle(scene, "floor", {x, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, grey);
            add_rectangle(scene, "ceiling", {x - 1.0, 3, 0}, {0, -1, 0}, {1, 0, 0}, 2, 4, grey);
            add_point_light(scene, {x, 2.5, 0.5}, 800.0);
        }
        for (const auto& [at, out] : std::vector<std::pair<dvec3, dvec3>>{{{-4, 1.5, 0}, {1, 0, 0}},
                                                                          {{-0.05, 1.5, 0}, {-1, 0, 0}},
                                                                          {{0.05, 1.5, 0}, {1, 0, 0}},
                                                                          {{4, 1.5, 0}, {-1, 0, 0}}}) {
            add_rectangle(scene, "wall", at, out, {0, 0, 1}, 4, 3, grey);
        }
        if (mirror) {
            Material metal;
            metal.metallic = 1.0F;
            metal.roughness = 0.0F;
            metal.base_color = Rgb(1.0F);
            add_rectangle(scene, "mirror", {-3.9, 1.5, 0}, {1, 0, 0}, {0, 0, 1}, 3, 2, scene.materials.insert(metal));
        }
        Light sun;
        sun.kind = Light::Kind::Directional;
        sun.intensity = 1000.0F;
        sun.angular_diameter_degrees = 0.53F;
        Node node;
        node.light = scene.lights.insert(sun);
        node.transform.rotation = glm::angleAxis(-1.2, glm::normalize(dvec3(1, 0, 0.3)));
        scene.roots.push_back(scene.nodes.insert(node));
        box = add_shape(scene, "box", Box{vec3(0.5F, 0.5F, 0.5F)}, {-2.2, 1.0, 0.1}, grey);
        before = std::make_unique<RayScene>(scene);
        rays = std::make_unique<RayScene>(scene);
        scene.nodes.find(box)->transform.translation += by;
        const auto moved = rays->move_to(scene);
        EXPECT_TRUE(moved);
        for (const MovedSurface& m : *moved) {
            boxes.push_back(m.before);
            boxes.push_back(m.after);
        }
        EXPECT_TRUE(rays->look_back());
    }
    [[nodiscard]] vec3 engine(const vec3& p) const { return p - vec3(rays->origin()); }
};

struct Counts {
    int changed = 0, missed = 0, touched = 0, met = 0, met_in_other_room = 0;
};

// Floor points whose light is compared before and after; `light(rays, p)`.
template <class Light> Counts count(const TwoRooms& rooms, const LightShafts& shafts, const Light& light, bool closely) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> u(-1.9F, 1.9F);
    Counts out;
    for (int i = 0; i < 4000; ++i) {
        const bool left = i % 2 == 0;
        const SurfacePoint p{rooms.engine({(left ? -2.0F : 2.0F) + u(random), 0.0F, u(random)}), {0, 1, 0}};
        const bool touched = std::any_of(rooms.boxes.begin(), rooms.boxes.end(),
                                         [&](const Box3& box) { return shafts.touched(p.position, 0.0F, box); });
        const bool met = touched && shafts.meets_moved(*rooms.rays, p, rooms.boxes, closely);
        const double was = light(*rooms.before, p), is = light(*rooms.rays, p);
        const bool changed = std::abs(was - is) > 0.02 * std::max(was, is);
        out.touched += touched ? 1 : 0;
        out.met += met ? 1 : 0;
        out.met_in_other_room += met && !left ? 1 : 0;
        out.changed += changed ? 1 : 0;
        out.missed += changed && !met ? 1 : 0;
    }
    return out;
}

TEST(LightShafts, ScoutsMeetWhatChangesTheLightOfLampsAndSun) {
    const TwoRooms rooms({0.4, 0.0, 0.3});
    const DirectLight lights(rooms.scene, *rooms.rays);
    LightShafts shafts;
    shafts.add_lamps(lights);
    const auto light = [&](const RayScene& rays, const SurfacePoint& p) {
        return double(luminance(DirectLight(lights.lights(), rays).lamps_irradiance(p.position, p.normal, 16).irradiance));
    };
    for (const bool closely : {false, true}) {
        const Counts c = count(rooms, shafts, light, closely);
        EXPECT_GT(c.changed, 50);
        EXPECT_EQ(c.missed, 0);
        EXPECT_LT(10 * c.met, 8 * c.touched) << "less than boxes say; what lay and lies in its shadow is met twice";
        EXPECT_EQ(c.met_in_other_room, 0) << "a wall lies between";
    }
}

TEST(LightShafts, ScoutsOverAMirrorMeetWhatChangesItsLight) {
    const TwoRooms rooms({0.4, 0.2, 0.3}, true);
    const DirectLight lights(rooms.scene, *rooms.rays);
    const MirrorLight before(*rooms.before), now(*rooms.rays);
    ASSERT_FALSE(now.empty());
    LightShafts shafts;
    shafts.add_lamps(lights);
    shafts.over_mirrors(now.mirrors());
    const auto light = [&](const RayScene& rays, const SurfacePoint& p) {
        const MirrorLight& mirrors = &rays == rooms.before.get() ? before : now;
        const DirectLight of(lights.lights(), rays);
        return double(luminance(mirrors.irradiance(p.position, p.normal, {}, &of, nullptr).irradiance));
    };
    const Counts c = count(rooms, shafts, light, false);
    EXPECT_GT(c.changed, 50);
    EXPECT_LE(c.missed, c.changed / 20) << "at the rim of the sun's disc";
    EXPECT_LT(c.met, 2 * c.changed);
    EXPECT_EQ(c.met_in_other_room, 0);
}

TEST(BoxSight, AWallHidesTheOtherRoomAndWhatIsKnownStaysWithinTheSurroundings) {
    const TwoRooms rooms({0.4, 0.0, 0.3});
    BoxSight sight(*rooms.rays, 2);
    sight.about(rooms.boxes, true);
    int asked = 0;
    const auto sees = [&](std::size_t room) {
        return sight.sees(room, [&] {
            ++asked;
            return sight.any({rooms.engine({room == 0 ? -1.0F : 1.0F, 0.0F, 1.5F}), {0, 1, 0}}, 0.1F);
        });
    };
    EXPECT_TRUE(sees(0));
    EXPECT_FALSE(sees(1));
    EXPECT_FALSE(sees(1));
    EXPECT_EQ(asked, 2);
    std::vector<Box3> near = rooms.boxes;
    for (Box3& box : near) {
        box.min.x += 0.1F;
        box.max.x += 0.1F;
    }
    sight.about(near, true);
    EXPECT_FALSE(sees(1));
    EXPECT_EQ(asked, 2) << "a step within what is around";
    for (Box3& box : near) {
        box.min.x += 3.0F;
        box.max.x += 3.0F;
    }
    sight.about(near, true);
    EXPECT_TRUE(sees(1)) << "it came over";
    EXPECT_EQ(asked, 3);
}

TEST(RayScene, StillBlocksKnowsNothingOfWhatMoved) {
    const TwoRooms rooms({0.0, 0.5, 0.0});
    const vec3 from = rooms.engine({-2.2F, 0.0F, 0.1F});
    const Ray up{from, {0, 1, 0}, 2.0F};
    EXPECT_TRUE(rooms.rays->nearest(up)) << "the box";
    EXPECT_FALSE(rooms.rays->still_blocks(up));
    const Ray across{rooms.engine({-2.2F, 1.0F, 1.0F}), {1, 0, 0}, 4.0F};
    EXPECT_TRUE(rooms.rays->still_blocks(across)) << "the wall";
    EXPECT_FALSE(rooms.rays->still_blocks({across.origin, across.direction, 1.0F}));
}

} // namespace
} // namespace atrium
