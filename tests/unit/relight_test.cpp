// GiEngine::update() while lamps are dimmed and coloured and walls painted.
#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/scene/photometric_web.h"
#include "engine/session/engine_session.h"
#include "tests/support/light_cases.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <thread>

namespace atrium {
namespace {

using namespace test;
using Light3 = std::vector<Rgb>;

/// A room with two kinds of lamps that shine, a point light, a spot, daylight through a hole in the ceiling, a box on the
/// floor, a mirror that stands on it, and a ball of polished metal.
struct Room {
    Scene scene;
    MaterialId wall, cube, panel, strip;
    NodeId box, point, spot;
    GiEngine engine;
    SolveOptions options;

    explicit Room(bool with_sky = true, bool with_metal = true) {
        wall = add_color(scene, {0.7F, 0.6F, 0.5F});
        cube = add_color(scene, {0.3F, 0.5F, 0.3F});
        panel = add_color(scene, Rgb(0.2F), {3000.0F, 2500.0F, 2000.0F});
        strip = add_color(scene, Rgb(0.2F), {1000.0F, 2000.0F, 3000.0F});
        for (const MaterialId id : {wall, cube, panel, strip}) {
            scene.materials.find(id)->name = "paint";
        }
        add_cie_shell(scene, wall, wall);
        add_rectangle(scene, "wall z0", {2, 1.5, 0}, {0, 0, 1}, {1, 0, 0}, 4, 3, wall);
        if (with_sky) {
            add_frame(scene, {0, 3, 0}, {4, 0, 0}, {0, 0, 4}, {2.5, 2.5}, {3.5, 3.5}, wall);
            scene.environment.sky_radiance = Rgb(200.0F, 250.0F, 300.0F);
        } else {
            add_rectangle(scene, "ceiling", {2, 3, 2}, {0, -1, 0}, {1, 0, 0}, 4, 4, wall);
        }
        box = add_shape(scene, "box", Box{vec3(0.4F, 0.8F, 0.4F)}, {1.2, 0.41, 1.2}, cube);
        add_rectangle(scene, "panel", {2, 2.9, 1}, {0, -1, 0}, {1, 0, 0}, 0.4F, 0.4F, panel);
        add_rectangle(scene, "strip", {0.05, 2, 2}, {1, 0, 0}, {0, 0, 1}, 0.6F, 0.1F, strip);
        point = add_point_light(scene, {0.6, 2.4, 0.6}, 1500.0);
        spot = add_point_light(scene, {3.4, 2.4, 0.6}, 2500.0);
        light_of(spot).kind = Light::Kind::Spot;
        scene.nodes.find(spot)->transform.rotation = glm::angleAxis(-1.2, dvec3(1, 0, 0));
        if (with_metal) {
            Material silver;
            silver.metallic = 1.0F;
            silver.roughness = 0.0F;
            silver.base_color = Rgb(0.9F);
            const MaterialId id = scene.materials.insert(silver);
            add_rectangle(scene, "mirror", {3.9, 1.2, 2.4}, {-1, 0, 0}, {0, 0, 1}, 0.8F, 1.2F, id);
            add_shape(scene, "ball", Sphere{0.25F}, {2.6, 0.26, 2.2}, id);
        }
        scene.settings.quality = options.quality = SolverSettings::Quality::Draft;
        options.keep_for_updates = true;
    }
    Light& light_of(NodeId node) { return *scene.lights.find(scene.nodes.find(node)->light); }
    Material& material(MaterialId id) { return *scene.materials.find(id); }
    std::shared_ptr<const Solution> solve() {
        auto r = engine.solve(scene, options, {});
        return r ? *r : nullptr;
    }
    std::shared_ptr<const Solution> update() {
        auto r = engine.update(scene, options, {});
        EXPECT_TRUE(r) << r.error().message();
        return r ? *r : nullptr;
    }
    [[nodiscard]] Light3 light(const Solution& solution) const {
        std::vector<SensorPlace> places;
        for (std::uint32_t i = 0; i < 1500; ++i) {
            const vec2 u = sobol_owen2(i, 0, 5U);
            places.push_back({{0.1 + 3.8 * u.x, 0.0, 0.1 + 3.8 * u.y}, {0, 1, 0}});
            places.push_back({{0.1 + 3.8 * u.x, 0.1 + 2.8 * u.y, 4.0}, {0, 0, -1}});
            places.push_back({{1.0 + 0.4 * u.x, 0.81, 1.0 + 0.4 * u.y}, {0, 1, 0}});
        }
        Light3 out;
        for (const SensorReading& r : read_surfaces(scene, solution, places)) {
            out.push_back(r.on_surface ? r.irradiance : Rgb(0.0F));
        }
        return out;
    }
};

double relative_rms(const Light3& a, const Light3& b) {
    double sum = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const dvec3 d = dvec3(a[i]) - dvec3(b[i]);
        sum += glm::dot(d, d) / 3.0;
        mean += (double(b[i].r) + b[i].g + b[i].b) / 3.0;
    }
    return std::sqrt(sum / double(a.size())) / (mean / double(a.size()));
}

// Layers, maps and caustics, to the bit.
void expect_same(const Solution& a, const Solution& b) {
    const auto same = [](const auto& x, const auto& y) { return x == y || (x && y && *x == *y); };
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
    for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
        const SurfaceLayer &x = *a.surfaces[i], &y = *b.surfaces[i];
        EXPECT_TRUE(x.irradiance_front == y.irradiance_front) << i;
        EXPECT_TRUE(x.irradiance_back == y.irradiance_back) << i;
        EXPECT_TRUE(x.direct_front == y.direct_front) << i;
        EXPECT_TRUE(x.direct_back == y.direct_back) << i;
        EXPECT_TRUE(x.caustic_front == y.caustic_front) << i;
        EXPECT_TRUE(same(x.direct_map_front, y.direct_map_front)) << i;
        EXPECT_TRUE(same(x.direct_map_back, y.direct_map_back)) << i;
        ASSERT_EQ(x.caustic_textures_front.size(), y.caustic_textures_front.size()) << i;
        for (std::size_t k = 0; k < x.caustic_textures_front.size(); ++k) {
            EXPECT_TRUE(same(x.caustic_textures_front[k], y.caustic_textures_front[k])) << i;
        }
    }
}

struct Edit {
    const char* name;
    std::function<void(Room&)> apply;
};
using Edits = std::vector<Edit>;
const Edits& edits_of_lamps() {
    static const Edits all{
        {"a point light dimmed", [](Room& r) { r.light_of(r.point).intensity *= 0.2F; }},
        {"a spot brighter", [](Room& r) { r.light_of(r.spot).intensity *= 3.0F; }},
        {"a point light in red",
         [](Room& r) {
             r.light_of(r.point).color = {1.0F, 0.3F, 0.05F};
         }},
        {"a spot switched off", [](Room& r) { r.light_of(r.spot).enabled = false; }},
        {"a point light hidden", [](Room& r) { r.scene.nodes.find(r.point)->visible = false; }},
        {"a shining surface in blue", [](Room& r) { r.material(r.panel).emissive_color *= Rgb(0.2F, 0.6F, 1.5F); }},
        {"a shining surface dark", [](Room& r) { r.material(r.panel).emissive_strength = 0.0F; }},
    };
    return all;
}
const Edits& other_edits() {
    static const Edits all{
        {"the sky brighter", [](Room& r) { r.scene.environment.sky_radiance *= Rgb(4.0F, 3.0F, 2.0F); }},
        {"walls dark",
         [](Room& r) {
             r.material(r.wall).base_color = {0.1F, 0.05F, 0.1F};
         }},
        {"walls white", [](Room& r) { r.material(r.wall).base_color = Rgb(0.85F); }},
        {"a box red",
         [](Room& r) {
             r.material(r.cube).base_color = {0.8F, 0.05F, 0.05F};
         }},
        {"several at once",
         [](Room& r) {
             r.light_of(r.point).intensity *= 2.0F;
             r.material(r.strip).emissive_strength *= 3.0F;
             r.material(r.wall).base_color = {0.3F, 0.6F, 0.7F};
             r.scene.environment.sky_radiance *= 0.1F;
         }},
    };
    return all;
}

void follow(const Edits& edits) {
    Room room;
    const auto before = room.solve();
    ASSERT_TRUE(before);
    const Scene was = room.scene;
    Room dice;
    dice.options.seed = 2;
    const double chance = relative_rms(room.light(*before), dice.light(*dice.solve())); // of a solution as such
    for (const Edit& edit : edits) {
        room.scene = was;
        edit.apply(room);
        const auto updated = room.update();
        ASSERT_TRUE(updated) << edit.name;
        EXPECT_TRUE(updated->statistics.update.degraded);
        EXPECT_GT(updated->statistics.update.sources_changed + updated->statistics.update.materials_changed, 0U);
        Room fresh;
        fresh.scene = room.scene;
        const Light3 expected = fresh.light(*fresh.solve());
        const double error = relative_rms(room.light(*updated), expected);
        const double stale = relative_rms(room.light(*before), expected);
        std::printf("%-28s rms %.2f %%, light that does not follow %.1f %%, another seed %.2f %%, rays %llu\n", edit.name,
                    100.0 * error, 100.0 * stale, 100.0 * chance, static_cast<unsigned long long>(updated->statistics.rays));
        EXPECT_LT(error, 0.2 * stale + chance) << edit.name;
    }
    // What was learnt of each source stays: the second time nothing is traced.
    for (const Edit& edit : edits) {
        room.scene = was;
        edit.apply(room);
        EXPECT_EQ(room.update()->statistics.rays, 0U) << edit.name;
    }
}

TEST(Relight, LightFollowsLamps) { follow(edits_of_lamps()); }
TEST(Relight, LightFollowsSkyAndPaint) { follow(other_edits()); }

/// Brighter to one side, as a wall washer; another `peak` is another file.
std::shared_ptr<const PhotometricWeb> washer(float peak) {
    PhotometricData data;
    data.vertical = {0, 30, 60, 90};
    data.horizontal = {0, 90, 180, 270, 360};
    for (const float side : {0.5F, 1.0F, 0.5F, 0.2F, 0.5F}) {
        for (const float down : {0.6F, 1.0F, 0.5F, 0.0F}) {
            data.candela.push_back(peak * side * down);
        }
    }
    return std::make_shared<const PhotometricWeb>(std::move(data));
}

// Dimmed and coloured as any lamp.
TEST(Relight, PhotometricLamps) {
    const auto with_washer = [](Room& r) {
        set_photometry(r.light_of(r.spot), washer(900.0F));
        r.scene.nodes.find(r.spot)->transform.rotation = glm::angleAxis(-1.4, dvec3(1, 0, 0));
    };
    Room room;
    with_washer(room);
    const auto before = room.solve();
    ASSERT_TRUE(before);
    const Scene was = room.scene;
    room.light_of(room.spot).intensity *= 0.25F;
    room.light_of(room.spot).color = {1.0F, 0.7F, 0.4F};
    const auto updated = room.update();
    ASSERT_TRUE(updated);
    EXPECT_TRUE(updated->statistics.update.degraded);
    EXPECT_EQ(updated->statistics.update.sources_changed, 1U);
    Room fresh;
    fresh.scene = room.scene;
    const Light3 expected = fresh.light(*fresh.solve());
    Room dice;
    dice.scene = room.scene;
    dice.options.seed = 2;
    const double chance = relative_rms(dice.light(*dice.solve()), expected);
    const double error = relative_rms(room.light(*updated), expected);
    const double stale = relative_rms(room.light(*before), expected);
    std::printf("a photometric lamp dimmed    rms %.2f %%, light that does not follow %.1f %%, another seed %.2f %%\n",
                100.0 * error, 100.0 * stale, 100.0 * chance);
    EXPECT_GT(stale, 0.1);
    EXPECT_LT(error, 0.1 * stale + chance);
    room.scene = was;
    expect_same(*room.update(), *before);
}

TEST(Relight, OneFactorForAllLightTracesNothing) {
    Room room(false);
    const auto before = room.solve();
    ASSERT_TRUE(before);
    const Light3 old = room.light(*before);
    room.light_of(room.point).intensity *= 0.5F;
    room.light_of(room.spot).intensity *= 0.5F;
    room.material(room.panel).emissive_color *= 0.5F;
    room.material(room.strip).emissive_strength *= 0.5F;
    const auto updated = room.update();
    EXPECT_EQ(updated->statistics.rays, 0U);
    EXPECT_EQ(updated->statistics.update.sources_changed, 4U);
    EXPECT_NEAR(updated->statistics.energy.emitted, 0.5 * before->statistics.energy.emitted,
                1e-4 * before->statistics.energy.emitted);
    EXPECT_NEAR(updated->mean_radiance, 0.5 * before->mean_radiance, 1e-4 * before->mean_radiance);
    const Light3 now = room.light(*updated);
    for (std::size_t i = 0; i < now.size(); ++i) {
        EXPECT_NEAR(now[i].g, 0.5F * old[i].g, 1e-5F * old[i].g);
    }
}

TEST(Relight, LongDragsLeaveNoTrace) {
    Room room, other;
    const auto before = room.solve();
    ASSERT_TRUE(before);
    ASSERT_TRUE(other.solve());
    const Scene was = room.scene;
    const auto slide = [&](Room& r, int i) {
        const vec2 u = sobol_owen2(std::uint32_t(i), 0, 9U);
        r.scene = was;
        r.light_of(r.point).intensity *= 3.0F * u.x;
        r.material(r.panel).emissive_color *= Rgb(u.y, u.x, 1.0F);
        r.material(r.wall).base_color = {u.x, 0.5F, u.y};
    };
    for (int i = 0; i < 100; ++i) {
        slide(room, i);
        ASSERT_TRUE(room.update());
    }
    // Where it is does not depend on how it came there.
    slide(other, 99);
    expect_same(*room.update(), *other.update());
    room.scene = was;
    const auto back = room.update();
    expect_same(*back, *before);
    EXPECT_EQ(back->mean_radiance, before->mean_radiance);
}

TEST(Relight, TheSameForAnyNumberOfThreads) {
    const auto light = [](unsigned threads) {
        set_thread_limit(threads);
        Room room;
        EXPECT_TRUE(room.solve());
        other_edits().back().apply(room);
        auto out = room.update();
        set_thread_limit(0);
        return out;
    };
    expect_same(*light(1), *light(3));
}

TEST(Relight, GoesTogetherWithMoves) {
    Room room;
    const auto before = room.solve();
    ASSERT_TRUE(before);
    const auto compare = [&](const char* what, double most) {
        const auto updated = room.update();
        ASSERT_TRUE(updated) << what;
        Room fresh;
        fresh.scene = room.scene;
        const Light3 expected = fresh.light(*fresh.solve());
        const double error = relative_rms(room.light(*updated), expected);
        const double stale = relative_rms(room.light(*before), expected);
        std::printf("%-28s rms %.2f %%, light that does not follow %.1f %%\n", what, 100.0 * error, 100.0 * stale);
        EXPECT_LT(error, most * stale) << what;
    };
    const auto move = [&] { room.scene.nodes.find(room.box)->transform.translation += dvec3(0.3, 0.0, 0.2); };
    other_edits().back().apply(room);
    move();
    compare("both at once", 0.3);
    room.light_of(room.point).intensity *= 0.3F;
    compare("a lamp after a move", 0.3);
    move();
    compare("a move after a lamp", 0.3);
    room.material(room.strip).emissive_strength *= 0.2F;
    room.material(room.cube).base_color = Rgb(0.7F);
    compare("paint after a move", 0.3);
}

TEST(Relight, AStoppedUpdateIsDoneByTheNext) {
    Room room, other;
    ASSERT_TRUE(room.solve());
    ASSERT_TRUE(other.solve());
    RunContext stopped;
    stopped.stop.request_stop();
    for (const auto& edit : {edits_of_lamps().front(), other_edits().back()}) {
        for (Room* r : {&room, &other}) {
            edit.apply(*r);
        }
        EXPECT_FALSE(room.engine.update(room.scene, room.options, stopped));
        EXPECT_TRUE(room.engine.can_update());
        expect_same(*room.update(), *other.update());
    }
}

TEST(Relight, SaysWhatItCannotFollow) {
    const auto refuses = [](const std::string& why, const std::function<void(Room&)>& edit) {
        Room room(false, true);
        ASSERT_TRUE(room.solve());
        edit(room);
        const auto updated = room.engine.update(room.scene, room.options, {});
        ASSERT_FALSE(updated) << why;
        EXPECT_NE(updated.error().message().find(why), std::string::npos) << updated.error().message();
        EXPECT_FALSE(room.engine.can_update());
    };
    refuses("the sky began to shine", [](Room& r) { r.scene.environment.sky_radiance = Rgb(10.0F); });
    refuses("began to shine", [](Room& r) { r.material(r.cube).emissive_color = Rgb(10.0F); });
    refuses("more than its colour", [](Room& r) { r.material(r.cube).roughness = 0.1F; });
    refuses("more than its colour", [](Room& r) { r.material(r.cube).transmission = 0.9F; });
    refuses("more than its colour", [](Room& r) { r.material(r.cube).alpha_mode = Material::Alpha::Blend; });
    refuses("a mirror", [](Room& r) {
        r.scene.materials.for_each([&](MaterialId id, const Material& m) {
            if (m.metallic > 0.0F) {
                r.material(id).base_color = Rgb(0.5F);
            }
        });
    });
}

// Names are no light: they need neither a refusal nor a ray.
TEST(Relight, NamesOfMaterialsDoNotMatter) {
    Room room;
    const auto before = room.solve();
    ASSERT_TRUE(before);
    room.material(room.wall).name = "another";
    const auto updated = room.update();
    EXPECT_EQ(updated->statistics.update.materials_changed, 0U);
    expect_same(*updated, *before);
}

// As the editor does it: a colour is picked, and full quality comes when the hand lets go.
TEST(Relight, TheSessionFollowsAColourPicker) {
    Room room(false, false);
    EngineSession session([] {});
    session.load(room.scene, 1, nullptr);
    const auto wait = [&](const auto& done) {
        for (int i = 0; i < 6000 && !done(); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return done();
    };
    ASSERT_TRUE(wait([&] { return session.latest() && session.latest()->final; }));
    for (std::uint64_t revision = 2; revision < 6; ++revision) {
        room.material(room.wall).base_color *= Rgb(0.9F, 0.7F, 0.8F);
        room.light_of(room.point).intensity *= 0.8F;
        EditGroup both;
        both.edits.push_back({SetResource<Material>{room.wall, room.material(room.wall)}});
        both.edits.push_back({SetResource<Light>{room.scene.nodes.find(room.point)->light, room.light_of(room.point)}});
        session.post({both}, revision, true);
        ASSERT_TRUE(wait([&] { return session.latest()->revision == revision && !session.latest()->final; }));
        EXPECT_TRUE(session.latest()->statistics.update.degraded);
        EXPECT_EQ(session.latest()->statistics.update.sources_changed, 1U);
        EXPECT_EQ(session.latest()->statistics.update.materials_changed, 1U);
        EXPECT_TRUE(session.status().moving);
    }
    session.end_gesture();
    ASSERT_TRUE(wait([&] { return session.latest()->final; }));
    EXPECT_FALSE(session.latest()->statistics.update.degraded);
    Room fresh(false, false);
    fresh.scene = room.scene;
    expect_same(*session.latest(), *fresh.solve());
}

} // namespace
} // namespace atrium
