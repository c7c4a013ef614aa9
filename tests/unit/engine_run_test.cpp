// Whole solves as a caller sees them: the same light whatever the threads and the order, stops, empty scenes, honest
// figures.
#include "engine/base/parallel.h"
#include "engine/radiosity/links.h"
#include "engine/raycast/ray_scene.h"
#include "engine/view/still.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <set>

namespace atrium {
namespace {

using namespace test;
using Quality = SolverSettings::Quality;
using Clock = std::chrono::steady_clock;

NodeId add_box(Scene& scene, const vec3& size, const dvec3& at, MaterialId material) {
    Shape shape;
    shape.geometry = Box{size};
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = {material};
    node.transform.translation = at;
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

/// Furnished room with a panel, a lamp and a little sky through an open wall.
Scene furnished(float rho = 0.6F) {
    Scene scene;
    const MaterialId m = add_material(scene, rho);
    add_room(scene, 4, 2.5F, 3, m);
    scene.nodes.erase(scene.roots.back());
    scene.roots.pop_back();
    add_box(scene, {0.8F, 0.7F, 0.6F}, {1.2, 0.35, 1.3}, m);
    Shape bulb;
    bulb.geometry = Sphere{0.1F};
    Node node;
    node.shape = scene.shapes.insert(bulb);
    node.materials = {add_material(scene, 0.0F, 5000.0F)};
    node.transform.translation = {2.7, 1.9, 1.1};
    scene.roots.push_back(scene.nodes.insert(node));
    add_point_light(scene, {1, 2, 2}, 400);
    scene.environment.sky_radiance = Rgb(20, 30, 50);
    return scene;
}

bool same(const std::shared_ptr<const LightMap>& a, const std::shared_ptr<const LightMap>& b) {
    return a && b ? *a == *b : a == b;
}

void expect_same_light(const Solution& a, const Solution& b, const std::string& what) {
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size()) << what;
    for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
        EXPECT_TRUE(*a.surfaces[i]->mesh == *b.surfaces[i]->mesh) << what << ", mesh of surface " << i;
        EXPECT_TRUE(a.surfaces[i]->irradiance_front == b.surfaces[i]->irradiance_front) << what << ", surface " << i;
        EXPECT_TRUE(a.surfaces[i]->irradiance_back == b.surfaces[i]->irradiance_back) << what << ", surface " << i;
        EXPECT_TRUE(a.surfaces[i]->direct_front == b.surfaces[i]->direct_front) << what << ", surface " << i;
        EXPECT_TRUE(a.surfaces[i]->direct_back == b.surfaces[i]->direct_back) << what << ", surface " << i;
        EXPECT_TRUE(same(a.surfaces[i]->direct_map_front, b.surfaces[i]->direct_map_front)) << what << ", surface " << i;
        EXPECT_TRUE(same(a.surfaces[i]->direct_map_back, b.surfaces[i]->direct_map_back)) << what << ", surface " << i;
    }
    EXPECT_EQ(a.mean_radiance, b.mean_radiance) << what;
    EXPECT_EQ(a.statistics.iterations, b.statistics.iterations) << what;
    EXPECT_EQ(a.statistics.links, b.statistics.links) << what;
    EXPECT_EQ(a.statistics.energy.defect, b.statistics.energy.defect) << what;
}

double largest(const Solution& solution) {
    double out = 0.0;
    for (const auto& layer : solution.surfaces) {
        for (const bool back : {false, true}) {
            for (std::size_t i = 0; i < (back ? layer->irradiance_back : layer->irradiance_front).size(); ++i) {
                const Rgb e = light_on(*layer, i, back);
                EXPECT_TRUE(is_finite(e));
                out = std::max(out, double(max_component(e)));
            }
        }
    }
    return out;
}

// X-THREADS
TEST(EngineRun, TheSameBitsForAnyNumberOfThreads) {
    const Scene scene = furnished();
    set_thread_limit(1);
    const Solved one = solve(scene, Quality::Draft);
    ASSERT_TRUE(one.solution);
    EXPECT_EQ(one.solution->statistics.threads, 1U);
    for (const unsigned threads : {2U, 8U}) {
        set_thread_limit(threads);
        const Solved more = solve(scene, Quality::Draft);
        ASSERT_TRUE(more.solution);
        expect_same_light(*one.solution, *more.solution, std::to_string(threads) + " threads");
        EXPECT_EQ(one.engine.gather_free({2, 1, 1}, {0, 1, 0}).irradiance,
                  more.engine.gather_free({2, 1, 1}, {0, 1, 0}).irradiance);
    }
    set_thread_limit(0);
}

TEST(EngineRun, WhatWasSolvedBeforeDoesNotMatter) {
    const Scene scene = furnished();
    Scene other = furnished(0.3F);
    add_box(other, {0.3F, 0.3F, 0.3F}, {3, 1, 2}, other.materials.keys().front());
    const Solved fresh = solve(scene, Quality::Draft);
    Solved used = solve(other, Quality::Draft);
    ASSERT_TRUE(fresh.solution && used.solution);
    SolveOptions options;
    options.quality = Quality::Draft;
    const auto again = used.engine.solve(scene, options, RunContext{});
    ASSERT_TRUE(again);
    expect_same_light(*fresh.solution, **again, "after another scene");
    const auto third = used.engine.solve(scene, options, RunContext{});
    expect_same_light(*fresh.solution, **third, "once more");
}

TEST(EngineRun, ProgressNeverFallsAndEndsAtOne) {
    std::vector<Progress> reports;
    std::vector<std::shared_ptr<const Solution>> snapshots;
    RunContext context;
    context.on_progress = [&](const Progress& p) { reports.push_back(p); };
    SolveOptions options;
    options.quality = Quality::Draft;
    options.revision = 42;
    GiEngine engine;
    const auto result = engine.solve(furnished(), options, context, [&](auto s) { snapshots.push_back(std::move(s)); });
    ASSERT_TRUE(result);
    ASSERT_FALSE(reports.empty());
    for (std::size_t i = 1; i < reports.size(); ++i) {
        EXPECT_GE(reports[i].fraction, reports[i - 1].fraction) << reports[i].phase;
    }
    EXPECT_GE(reports.front().fraction, 0.0);
    EXPECT_EQ(reports.back().fraction, 1.0);
    std::set<std::string> phases;
    for (const Progress& p : reports) {
        phases.emplace(p.phase);
    }
    EXPECT_EQ(phases, (std::set<std::string>{"ray_scene", "hierarchy", "direct", "links", "gather", "layers"}));
    ASSERT_GE(snapshots.size(), 2U);
    for (std::size_t i = 0; i < snapshots.size(); ++i) {
        EXPECT_EQ(snapshots[i]->final, i + 1 == snapshots.size());
        EXPECT_EQ(snapshots[i]->revision, 42U);
    }
    EXPECT_EQ(snapshots.back(), *result);
}

TEST(EngineRun, StoppedAnywhereItReturnsSoonAndTheNextSolveIsRight) {
    const Scene scene = furnished();
    const Solved whole = solve(scene, Quality::Draft);
    ASSERT_TRUE(whole.solution);
    int with_picture = 0, without = 0;
    for (const double at : {0.0, 0.03, 0.08, 0.2, 0.25, 0.4, 0.5, 0.7, 0.9}) {
        RunContext context;
        Clock::time_point asked = Clock::time_point::max();
        bool done = false; // nothing was left to stop
        context.on_progress = [&](const Progress& p) {
            if (p.fraction >= at && asked == Clock::time_point::max()) {
                asked = Clock::now();
                done = p.fraction >= 1.0;
                context.stop.request_stop();
            }
        };
        GiEngine engine;
        SolveOptions options;
        options.quality = Quality::Draft;
        const auto result = engine.solve(scene, options, context);
        ASSERT_NE(asked, Clock::time_point::max());
        EXPECT_LT(std::chrono::duration<double>(Clock::now() - asked).count(), 1.0) << "stopped at " << at;
        if (result) {
            ++with_picture;
            EXPECT_EQ((*result)->final, done) << at;
            EXPECT_EQ((*result)->statistics.converged, done) << at;
            EXPECT_GT(largest(**result), 0.0);
        } else {
            ++without;
            EXPECT_NE(result.error().message().find("stopped before the first picture"), std::string::npos);
        }
        const auto next = engine.solve(scene, options, RunContext{});
        ASSERT_TRUE(next);
        expect_same_light(*whole.solution, **next, "after a stop at " + std::to_string(at));
    }
    EXPECT_GT(with_picture, 0);
    EXPECT_GT(without, 0);
}

TEST(EngineRun, AnotherSeedIsAnotherSampleOfTheSameLight) {
    const Scene scene = furnished();
    const Solved one = solve(scene, Quality::Draft, 1);
    const Solved two = solve(scene, Quality::Draft, 2);
    ASSERT_TRUE(one.solution && two.solution);
    const double a = mean_irradiance(scene, *one.solution), b = mean_irradiance(scene, *two.solution);
    EXPECT_NE(a, b) << "the seed reaches no random stream";
    EXPECT_NEAR(a / b, 1.0, 0.03);
}

TEST(EngineRun, ADeadlineThatHasPassedOrComesSoon) {
    SolveOptions options;
    options.quality = Quality::Fine;
    GiEngine engine;
    RunContext past;
    past.deadline = Clock::now() - std::chrono::seconds(1);
    EXPECT_FALSE(engine.solve(furnished(), options, past));
    EXPECT_FALSE(engine.has_solution());
    EXPECT_EQ(engine.gather_free({2, 1, 1}, {0, 1, 0}).irradiance, Rgb(0.0F));
    RunContext soon;
    const auto start = Clock::now();
    soon.deadline = start + std::chrono::milliseconds(300);
    const auto result = engine.solve(furnished(), options, soon);
    EXPECT_LT(std::chrono::duration<double>(Clock::now() - start).count(), 3.0);
    if (result) {
        EXPECT_FALSE((*result)->statistics.converged && !(*result)->final);
    }
}

// X-EMPTY
TEST(EngineRun, EmptyScenesGiveDefinedZeros) {
    struct Case {
        const char* name;
        Scene scene;
        bool dark;
    };
    std::vector<Case> cases;
    cases.push_back({"nothing at all", Scene{}, true});
    Scene no_light;
    add_room(no_light, 4, 3, 5, add_material(no_light, 0.5F));
    cases.push_back({"no lights", no_light, true});
    Scene only_lamp;
    add_point_light(only_lamp, {0, 2, 0}, 1000);
    cases.push_back({"a lamp and no surface", only_lamp, true});
    Scene only_sky;
    only_sky.environment.sky_radiance = Rgb(100.0F);
    cases.push_back({"only sky", only_sky, true});
    Scene mirror;
    Material silver;
    silver.metallic = 1.0F;
    silver.roughness = 0.0F;
    add_rectangle(mirror, "mirror", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 2, 2, mirror.materials.insert(silver));
    cases.push_back({"only a mirror", mirror, true});
    mirror.environment.sky_radiance = Rgb(100.0F);
    cases.push_back({"a mirror under the sky", mirror, true}); // what falls on a mirror is nothing to look at
    Scene flat;
    Shape shape;
    shape.geometry = Box{};
    Node node;
    node.shape = flat.shapes.insert(shape);
    node.transform.scale = {0, 0, 0};
    flat.roots.push_back(flat.nodes.insert(node));
    cases.push_back({"a box scaled to nothing", flat, true});
    for (const Case& c : cases) {
        const Solved s = solve(c.scene, Quality::Draft);
        ASSERT_TRUE(s.solution) << c.name;
        EXPECT_TRUE(s.solution->final) << c.name;
        EXPECT_EQ(largest(*s.solution) == 0.0, c.dark) << c.name;
        EXPECT_TRUE(s.solution->statistics.converged) << c.name << ": nothing is left to do";
        EXPECT_TRUE(std::isfinite(s.solution->mean_radiance)) << c.name;
        EXPECT_TRUE(std::isfinite(s.solution->statistics.error_estimate)) << c.name;
        EXPECT_TRUE(std::isfinite(s.solution->statistics.energy.defect)) << c.name;
        const SensorReading free = s.engine.gather_free({0.3, 5, 0.2}, {0, 1, 0});
        EXPECT_TRUE(is_finite(free.irradiance) && std::isfinite(free.standard_error)) << c.name;
        EXPECT_FALSE(read_surface(c.scene, *s.solution, {50, 50, 50}, {0, 1, 0}).on_surface) << c.name;
        StillOptions options;
        options.width = options.height = 8;
        for (const vec3& p : render_still(c.scene, *s.solution, default_camera(c.scene), options, RunContext{}).pixels) {
            EXPECT_TRUE(is_finite(p)) << c.name;
        }
    }
}

TEST(EngineRun, AnEyeInsideASolidSeesSomethingDefined) {
    Scene scene = furnished();
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    ViewCamera camera;
    camera.to_world[3] = dvec4(1.2, 0.35, 1.3, 1);
    StillOptions options;
    options.width = options.height = 16;
    for (const vec3& p : render_still(scene, *s.solution, camera, options, RunContext{}).pixels) {
        EXPECT_TRUE(is_finite(p));
        EXPECT_GE(max_component(p), 0.0F);
    }
}

TEST(EngineRun, ACameraOfNoSizeSeesSomethingDefined) {
    const Scene scene = furnished();
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    StillOptions options;
    options.width = options.height = 8;
    for (const dvec3& scale : {dvec3(0.0), dvec3(1.0, 0.0, 1.0), dvec3(0.0, 1.0, 1.0), dvec3(1.0, 1.0, 0.0)}) {
        ViewCamera camera;
        for (int axis = 0; axis < 3; ++axis) {
            camera.to_world[axis] *= scale[axis];
        }
        camera.to_world[3] = dvec4(2.0, 1.5, 2.0, 1.0);
        double sum = 0.0;
        for (const vec3& p : render_still(scene, *s.solution, camera, options, RunContext{}).pixels) {
            EXPECT_TRUE(is_finite(p));
            sum += double(p.y);
        }
        EXPECT_GT(sum, 0.0) << "the room is lit, and something of it is seen";
    }
}

TEST(EngineRun, LightOnAFlattenedObjectCanBeKept) {
    Scene scene = furnished();
    const auto before = scene.roots.size();
    auto data = std::make_shared<MeshData>();
    data->positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    data->indices = {0, 1, 2, 0, 3, 1};
    data->parts = {{0, 6}};
    Shape shape;
    shape.geometry = Mesh{data};
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.transform.scale = dvec3(1.0, 0.0, 1.0);
    node.transform.translation = dvec3(1.0, 1.0, 1.0);
    scene.roots.push_back(scene.nodes.insert(node));
    ASSERT_EQ(scene.roots.size(), before + 1);
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    const auto kept = decode_solution(encode_solution(*s.solution, scene), scene);
    EXPECT_TRUE(kept) << kept.error().message();
}

// X-RHO, X-RHO-GT1
TEST(EngineRun, ReflectanceOfOneAndMoreIsClampedAndConverges) {
    double at_limit = 0.0;
    for (const float rho : {kMaxReflectance, 1.0F, 1.2F, 50.0F}) {
        Scene scene;
        add_room(scene, 4, 3, 5, add_material(scene, rho, 1.0F));
        const Solved s = solve(scene, Quality::Draft);
        ASSERT_TRUE(s.solution);
        EXPECT_TRUE(s.solution->statistics.converged) << rho;
        const double mean = mean_irradiance(scene, *s.solution);
        EXPECT_TRUE(std::isfinite(mean));
        EXPECT_GT(mean, 0.0);
        at_limit = rho == kMaxReflectance ? mean : at_limit;
        EXPECT_EQ(mean, at_limit) << rho << " counts as the largest reflectance";
    }
    // 1 - rho is 1e-4 here: the closure of the rows decides, to a per cent as asked.
    EXPECT_NEAR(at_limit * (1.0 - double(kMaxReflectance)), 1.0, 0.02);
}

TEST(EngineRun, EnergyIsAccountedFor) {
    Scene closed;
    add_room(closed, 4, 2.5F, 3, add_material(closed, 0.7F));
    add_box(closed, {0.8F, 0.7F, 0.6F}, {1.2, 0.35, 1.3}, closed.materials.keys().front());
    add_point_light(closed, {3, 2, 2}, 1000);
    const Solved s = solve(closed, Quality::Draft);
    ASSERT_TRUE(s.solution);
    const auto& energy = s.solution->statistics.energy;
    EXPECT_NEAR(energy.emitted, 1000.0, 30.0);
    EXPECT_NEAR(energy.absorbed, 1000.0, 40.0);
    EXPECT_NEAR(energy.defect, 0.0, 0.02);
    const Solved open = solve(furnished(), Quality::Draft);
    ASSERT_TRUE(open.solution);
    EXPECT_GT(open.solution->statistics.energy.escaped, 0.0);
    EXPECT_NEAR(open.solution->statistics.energy.defect, 0.0, 0.05);
}

TEST(EngineRun, StatisticsAreHonest) {
    const Scene scene = furnished();
    const Solved s = solve(scene, Quality::Draft, 7);
    ASSERT_TRUE(s.solution);
    const Statistics& t = s.solution->statistics;
    EXPECT_EQ(t.quality, "draft");
    EXPECT_EQ(t.seed, 7U);
    EXPECT_EQ(t.triangles, 5U * 2 + 12 + RayScene(scene).triangle_count() - 22) << "as the ray scene counts";
    EXPECT_TRUE(find_feature(t.features, "sky").used);
    EXPECT_FALSE(find_feature(t.features, "sun").used);
    EXPECT_FALSE(find_feature(t.features, "particles").used);
    EXPECT_FALSE(find_feature(t.features, "octree").used);
    EXPECT_EQ(t.particles_emitted + t.particles_stored, 0U) << "what is not used costs nothing";
    EXPECT_EQ(t.memory.particles + t.memory.octree + t.memory.caustic_textures, 0U);
    EXPECT_GT(t.elements, t.clusters);
    EXPECT_GT(t.clusters, 0U);
    EXPECT_GT(t.links, 0U);
    EXPECT_GT(t.rays, 1000U);
    EXPECT_GT(t.memory.links, t.links * sizeof(Link) / 2);
    EXPECT_GT(t.memory.peak_rss, t.memory.elements + t.memory.links);
    EXPECT_GE(t.time.solve, t.time.first_picture);
    EXPECT_GT(t.time.first_picture, 0.0);
    double seconds = 0.0, share = 0.0;
    for (const auto& phase : t.phases) {
        EXPECT_GE(phase.seconds, 0.0);
        seconds += phase.seconds;
        share += phase.share;
    }
    EXPECT_LE(seconds, t.time.solve * 1.001);
    EXPECT_GT(seconds, t.time.solve * 0.9);
    EXPECT_NEAR(share, seconds / t.time.solve, 0.01);
    EXPECT_LE(t.residual, 1e-3);
}

// CIE171-5.3's room, floor points G to J.
Scene cie53(double scale, const dvec3& offset) {
    Scene scene;
    const MaterialId black = add_material(scene, 0);
    const auto s = float(scale);
    add_room(scene, 4 * s, 3 * s, 4 * s, black);
    add_rectangle(scene, "source", dvec3(2, 3, 2) * scale, {0, -1, 0}, {1, 0, 0}, s, s,
                  add_material(scene, 0, 1000.0F * kPi));
    for (const NodeId id : scene.roots) {
        scene.nodes.find(id)->transform.translation += offset;
    }
    return scene;
}
const double kFloor53[][2] = {{0.25, 61.42409854}, {0.75, 79.25515732}, {1.25, 95.66727633}, {1.75, 105.7782422}};

// X-SCALE: light from surfaces of given luminance does not know the scale.
TEST(EngineRun, ScaleOfTheModelDoesNotChangeIlluminance) {
    double mean_at_first = 0.0;
    for (const double scale : {1.0, 1e-3, 1e3}) {
        const Scene scene = cie53(scale, dvec3(0.0));
        const Solved s = solve(scene, Quality::Draft);
        ASSERT_TRUE(s.solution);
        for (const auto& [z, e] : kFloor53) {
            const dvec3 p = dvec3(2, 0, z) * scale;
            EXPECT_NEAR(luminance(s.engine.gather_free(p, {0, 1, 0}).irradiance) / e, 1.0, 0.03) << scale << " at " << z;
        }
        // What is shown is the same field sampled at the same places.
        const double mean = mean_irradiance(scene, *s.solution, scene.roots[0]);
        mean_at_first = mean_at_first > 0.0 ? mean_at_first : mean;
        EXPECT_NEAR(mean / mean_at_first, 1.0, 0.01) << scale;
    }
}

// X-OFFSET
TEST(EngineRun, AThousandKilometresAwayTheLightIsTheSame) {
    const Scene near = cie53(1.0, dvec3(0.0));
    const Solved a = solve(near, Quality::Draft);
    for (const dvec3& offset : {dvec3(1e6, 2e6, 0), dvec3(-1e7, 0, 3)}) {
        const Scene far = cie53(1.0, offset);
        const Solved b = solve(far, Quality::Draft);
        ASSERT_TRUE(a.solution && b.solution);
        for (const auto& [z, e] : kFloor53) {
            EXPECT_NEAR(luminance(b.engine.gather_free(dvec3(2, 0, z) + offset, {0, 1, 0}).irradiance) / e, 1.0, 1e-2);
            const SensorReading here = read_surface(near, *a.solution, dvec3(2, 0, z), {0, 1, 0});
            const SensorReading there = read_surface(far, *b.solution, dvec3(2, 0, z) + offset, {0, 1, 0});
            ASSERT_TRUE(here.on_surface && there.on_surface);
            EXPECT_NEAR(luminance(there.irradiance) / luminance(here.irradiance), 1.0, 1e-3);
        }
    }
}

} // namespace
} // namespace atrium
