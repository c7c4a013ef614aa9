// Particles after an edit: what was traced again must be what a full trace of the same links finds, to the last bit.
#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/layers/caustic_layer.h"
#include "tests/support/moving_caustics.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using test::Moved;
using test::Stage;
using test::stage;
using test::Staged;

ParticleSettings keeping(std::uint32_t particles) {
    ParticleSettings out;
    out.particles = particles;
    out.keep_paths = true;
    return out;
}

ParticleMap trace(const Staged& s, std::uint32_t particles) {
    return ParticleMap(s.rays, s.targets, s.direct, s.emitters, {}, keeping(particles), RunContext{});
}

void expect_same(const ParticleMap& a, const ParticleMap& b) {
    ASSERT_EQ(a.landings().size(), b.landings().size());
    for (std::size_t i = 0; i < a.landings().size(); ++i) {
        const Landing &x = a.landings()[i], &y = b.landings()[i];
        ASSERT_TRUE(x == y) << i << ": link " << x.link << " / " << y.link << ", particle " << x.index << " / " << y.index
                            << ", surface " << x.surface << " / " << y.surface;
    }
    ASSERT_EQ(a.links().size(), b.links().size());
    for (std::size_t i = 0; i < a.links().size(); ++i) {
        EXPECT_EQ(a.links()[i].first, b.links()[i].first);
        EXPECT_EQ(a.links()[i].landings, b.links()[i].landings);
        EXPECT_EQ(a.links()[i].aimed_at.min, b.links()[i].aimed_at.min);
    }
    const ParticleEnergy &e = a.energy(), &f = b.energy();
    EXPECT_EQ(e.emitted, f.emitted);
    EXPECT_EQ(e.absorbed, f.absorbed);
    EXPECT_EQ(e.escaped, f.escaped);
    EXPECT_EQ(e.stored, f.stored);
    for (std::size_t p = 0; p < a.paths().size(); ++p) {
        ASSERT_EQ(a.paths().path(p), b.paths().path(p)) << p;
    }
}

// Places to move to, by turns.
dvec3 place(std::uint32_t i) {
    const vec2 u = sobol_owen2(i, 0, 7);
    return {-1.6 + 3.0 * double(u.x), 0.15 + 0.3 * double(sobol_owen(i, 2, 7)), -1.8 + 3.0 * double(u.y)};
}

TEST(ParticleUpdate, PathsAreKeptOnlyWhenAskedForAndChangeNothing) {
    const Staged s(stage().scene);
    ParticleSettings settings = keeping(20'000);
    const ParticleMap with(s.rays, s.targets, s.direct, s.emitters, {}, settings, RunContext{});
    settings.keep_paths = false;
    const ParticleMap without(s.rays, s.targets, s.direct, s.emitters, {}, settings, RunContext{});
    EXPECT_FALSE(without.keeps_paths());
    EXPECT_LT(without.memory_bytes() + with.paths().memory_bytes(), with.memory_bytes());
    ASSERT_EQ(with.paths().size(), with.emitted());
    EXPECT_GE(with.emitted(), without.emitted()); // some that light nothing are watched
    EXPECT_LE(with.emitted() - without.emitted(), settings.particles / 16);
    EXPECT_GT(with.paths().vertices(), 2 * with.emitted());
    EXPECT_TRUE(with.landings() == without.landings());
    EXPECT_NEAR(with.energy().emitted, without.energy().emitted, 1e-6 * without.energy().emitted);
}

TEST(ParticleUpdate, IsWhatAFullTraceOfTheSameLinksFinds) {
    Stage set = stage();
    auto at = std::make_unique<Staged>(set.scene);
    ParticleMap map = trace(*at, 20'000);
    const ParticleMap start = map;
    const dvec3 home = set.scene.nodes.find(set.box)->transform.translation;
    double most = 0.0;
    for (std::uint32_t i = 0; i < 24; ++i) {
        set.scene.nodes.find(set.box)->transform.translation = i % 4 == 3 ? home : place(i);
        auto next = std::make_unique<Staged>(set.scene);
        const Moved moved(at->rays, next->rays);
        ASSERT_FALSE(moved.boxes.empty());
        const ParticleUpdate update = map.update(next->particle_scene(), moved.boxes, moved.surfaces, RunContext{});
        ASSERT_TRUE(update.complete);
        EXPECT_EQ(update.re_aimed, 0U);
        most = std::max(most, update.share);
        ParticleMap full = start;
        ASSERT_TRUE(full.retrace(next->particle_scene(), RunContext{}));
        expect_same(map, full);
        if (i % 4 == 3) {
            expect_same(map, start); // there and back leaves no trace
        }
        if (::testing::Test::HasFatalFailure()) {
            return;
        }
        at = std::move(next);
    }
    EXPECT_GT(most, 0.0);
    EXPECT_LT(most, 0.3);
}

// Moves something and updates, in one go.
struct Walk {
    explicit Walk(Stage s, std::uint32_t particles = 20'000)
        : set(std::move(s)), at(std::make_unique<Staged>(set.scene)), map(trace(*at, particles)) {}
    Node& node(NodeId id) { return *set.scene.nodes.find(id); }
    // As an editor does it: targets keep their pieces, whatever way things are turned.
    ParticleUpdate step() {
        auto next = std::make_unique<Staged>(set.scene);
        const Moved moved(at->rays, next->rays);
        next->targets = at->targets;
        next->targets.follow(next->rays, moved.surfaces);
        at = std::move(next);
        return map.update(at->particle_scene(), moved.boxes, moved.surfaces, RunContext{});
    }
    [[nodiscard]] ParticleMap full(const ParticleMap& links) const {
        ParticleMap out = links;
        EXPECT_TRUE(out.retrace(at->particle_scene(), RunContext{}));
        return out;
    }
    Stage set;
    std::unique_ptr<Staged> at;
    ParticleMap map;
};

TEST(ParticleUpdate, TheOctreeFindsWhatTheScanFinds) {
    const Staged s(stage().scene);
    const ParticleMap map = trace(s, 20'000);
    PassageOctree octree(scene_reach(s.rays));
    EXPECT_EQ(octree.cells(), 1U); // empty until something moves
    std::size_t found = 0;
    for (std::uint32_t i = 0; i < 60; ++i) { // boxes of all sizes; some partly outside of everything
        const vec3 centre = 3.2F * (2.0F * vec3(sobol_owen(i, 0, 3), sobol_owen(i, 1, 3), sobol_owen(i, 2, 3)) - vec3(1.0F));
        const vec3 half = vec3(0.01F + std::exp2(-float(i % 8)));
        std::vector<Box3> boxes(2);
        boxes[0].add(centre - half);
        boxes[0].add(centre + half);
        boxes[1].add(centre);
        boxes[1].add(centre + vec3(half.x, 0.0F, 0.3F * half.z));
        std::vector<std::uint8_t> scan(map.paths().size(), 0), tree = scan, one = scan;
        map.paths().mark_crossing(boxes, scan);
        octree.mark_crossing(map.paths(), boxes, tree);
        for (std::size_t p = 0; p < one.size(); ++p) {
            one[p] = map.paths().crosses(p, boxes) ? 1 : 0;
            found += one[p];
        }
        ASSERT_TRUE(scan == one) << i;
        ASSERT_TRUE(tree == one) << i;
    }
    EXPECT_GT(found, 0U);
    EXPECT_LT(octree.cells(), 200U); // those behind are gone
}

TEST(ParticleUpdate, TheOctreeFollowsWhatIsTracedAgain) {
    Stage set = stage();
    auto at = std::make_unique<Staged>(set.scene);
    ParticleMap scan = trace(*at, 20'000);
    ParticleSettings settings = keeping(20'000);
    settings.passage_octree = true;
    ParticleMap tree(at->rays, at->targets, at->direct, at->emitters, {}, settings, RunContext{});
    for (std::uint32_t i = 0; i < 24; ++i) {
        const NodeId id = i % 8 == 5 ? set.ball : set.box;
        set.scene.nodes.find(id)->transform.translation =
            id == set.box ? place(i / 2) + dvec3(0.1 * (i % 2), 0, 0) : dvec3(-0.6, 0.5, -0.5 + 0.05 * i);
        auto next = std::make_unique<Staged>(set.scene);
        const Moved moved(at->rays, next->rays);
        const ParticleUpdate a = scan.update(next->particle_scene(), moved.boxes, moved.surfaces, RunContext{});
        const ParticleUpdate b = tree.update(next->particle_scene(), moved.boxes, moved.surfaces, RunContext{});
        EXPECT_EQ(a.particles, b.particles);
        expect_same(scan, tree);
        at = std::move(next);
    }
    EXPECT_GT(tree.octree()->cells(), 1U);
    EXPECT_GT(tree.memory_bytes(), scan.memory_bytes());
}

TEST(ParticleUpdate, TargetsAndSourcesThatMoveAreAimedAnew) {
    Walk walk(stage());
    const ParticleMap start = walk.map;
    for (const NodeId id : {walk.set.ball, walk.set.lamp, walk.set.shining}) {
        const Transform home = walk.node(id).transform;
        for (int i = 0; i < 3; ++i) {
            if (i < 2) {
                walk.node(id).transform.translation += dvec3(0.21, -0.07, 0.13);
                walk.node(id).transform.rotation = glm::angleAxis(0.7, glm::normalize(dvec3(0.2, 0.5, 0.1)));
            } else {
                walk.node(id).transform = home;
            }
            const ParticleUpdate update = walk.step();
            ASSERT_TRUE(update.complete);
            EXPECT_GT(update.re_aimed, 0U);
            EXPECT_LT(update.re_aimed, walk.map.links().size());
            for (std::size_t l = 0; l < start.links().size(); ++l) {
                EXPECT_EQ(walk.map.links()[l].count, start.links()[l].count);
            }
            expect_same(walk.map, walk.full(start));
            if (i == 2) {
                expect_same(walk.map, start);
            }
            if (::testing::Test::HasFatalFailure()) {
                return;
            }
        }
    }
}

TEST(ParticleUpdate, TheSunStartsOutsideOfWhatGrows) {
    Walk walk(stage());
    const ParticleMap start = walk.map;
    const dvec3 origin = walk.at->rays.origin();
    const float reach = scene_reach(walk.at->rays);
    const Transform home = walk.node(walk.set.box).transform;
    for (const double stretch : {100.0, 130.0, 1.0}) { // far out to both sides
        walk.node(walk.set.box).transform.scale = {stretch, 1.0, 1.0};
        const ParticleUpdate update = walk.step();
        ASSERT_TRUE(update.complete);
        ASSERT_EQ(walk.at->rays.origin(), origin);
        EXPECT_EQ(scene_reach(walk.at->rays) > reach, stretch > 1.0);
        EXPECT_EQ(update.re_aimed > 0, stretch != 130.0);
        expect_same(walk.map, walk.full(start));
    }
    EXPECT_EQ(walk.node(walk.set.box).transform, home);
    expect_same(walk.map, start);
}

TEST(ParticleUpdate, SameForAnyNumberOfThreads) {
    std::optional<ParticleMap> first;
    for (const unsigned threads : {1U, 2U, 5U}) {
        set_thread_limit(threads);
        Walk walk(stage());
        for (std::uint32_t i = 0; i < 4; ++i) {
            walk.node(walk.set.box).transform.translation = place(i);
            ASSERT_TRUE(walk.step().complete);
        }
        set_thread_limit(0);
        if (!first) {
            first = walk.map;
        }
        expect_same(walk.map, *first);
    }
}

TEST(ParticleUpdate, WhenStoppedNothingHasChanged) {
    Walk walk(stage());
    const ParticleMap start = walk.map;
    walk.node(walk.set.box).transform.translation = {0.4, 0.3, -0.4};
    const Staged next(walk.set.scene);
    const Moved moved(walk.at->rays, next.rays);
    RunContext context;
    context.stop.request_stop();
    EXPECT_FALSE(walk.map.update(next.particle_scene(), moved.boxes, moved.surfaces, context).complete);
    expect_same(walk.map, start);
    const ParticleUpdate update = walk.map.update(next.particle_scene(), moved.boxes, moved.surfaces, RunContext{});
    EXPECT_TRUE(update.complete);
    EXPECT_GT(update.landings, 0U);
}

TEST(ParticleUpdate, BrightnessTracesNothing) {
    Walk walk(stage());
    const std::vector<Landing> before = walk.map.landings();
    walk.set.scene.lights.find(walk.node(walk.set.lamp).light)->intensity *= 0.5F;
    const ParticleUpdate update = walk.step();
    EXPECT_TRUE(update.complete);
    EXPECT_EQ(update.particles, 0U);
    EXPECT_FALSE(update.surfaces.empty());
    EXPECT_TRUE(walk.map.landings() == before);
    walk.set.scene.nodes.find(walk.set.lamp)->light = {};
    EXPECT_FALSE(walk.step().fits); // a lamp less
    EXPECT_TRUE(walk.map.landings() == before);
}

// A mirror that throws the sun back at the sky lights nothing until something comes into its way.
TEST(ParticleUpdate, LinksThatLightNothingAreWatched) {
    Stage set;
    test::add_rectangle(set.scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 6.0F, 6.0F,
                        test::add_material(set.scene, 0.6F));
    test::add_rectangle(set.scene, "mirror", {-1, 0.5, 0}, {0, 1, 0}, {1, 0, 0}, 0.5F, 0.5F,
                        test::add_specular(set.scene, false));
    set.box = test::add_shape(set.scene, Box{vec3(0.3F)}, {0, 1.2, 2}, test::add_material(set.scene, 0.6F));
    test::add_sun(set.scene, {1, -1, 0}, 1e5F);
    Walk walk(std::move(set));
    const ParticleMap start = walk.map;
    ASSERT_FALSE(start.links().empty());
    EXPECT_TRUE(start.landings().empty());
    walk.node(walk.set.box).transform.translation = {-0.3, 1.2, 0};
    const ParticleUpdate there = walk.step();
    EXPECT_EQ(there.lit, 1U);
    double power = 0.0;
    for (const Landing& l : walk.map.landings()) {
        power += l.bends == 1 ? double(luminance(walk.map.power(l))) : 0.0;
    }
    const double beam = 0.5 * std::sqrt(0.5); // as high as the mirror shows; the box is higher than that and 0.3 wide
    EXPECT_NEAR(power, 0.9 * 1e5 * beam * 0.3, 0.03 * 1e5 * beam * 0.3);
    expect_same(walk.map, walk.full(start));
    walk.node(walk.set.box).transform.translation = {0, 1.2, 2};
    EXPECT_EQ(walk.step().lit, 0U);
    expect_same(walk.map, start);
}

void expect_same(const CausticLight& a, const CausticLight& b) {
    ASSERT_EQ(a.sides.size(), b.sides.size());
    for (std::size_t i = 0; i < a.sides.size(); ++i) {
        const CausticLight::Side &x = a.sides[i], &y = b.sides[i];
        EXPECT_EQ(x.surface, y.surface);
        EXPECT_EQ(x.back, y.back);
        EXPECT_TRUE(x.on_mesh == y.on_mesh);
        ASSERT_EQ(x.textures.size(), y.textures.size());
        for (std::size_t k = 0; k < x.textures.size(); ++k) {
            EXPECT_TRUE(*x.textures[k] == *y.textures[k]);
        }
    }
    EXPECT_TRUE(a.records == b.records);
}

TEST(ParticleUpdate, TexturesOfOtherSurfacesStay) {
    Walk walk(stage(), 60'000);
    CausticSettings settings;
    settings.most_texels = 1U << 16U;
    const ChartSettings charting;
    CausticLight light = build_caustic_light(walk.at->rays, chart_surfaces(walk.at->rays, charting), walk.map, settings);
    ASSERT_GT(light.texture_count(), 0U);
    std::size_t kept = 0, made = 0;
    const Transform home = walk.node(walk.set.box).transform;
    for (std::uint32_t i = 0; i < 8; ++i) {
        Node& node = walk.node(i % 6 == 4 ? walk.set.ball : walk.set.box);
        node.transform.translation += i % 6 == 4 ? dvec3(0.05, 0, 0.02) : dvec3(0);
        if (i % 6 != 4) {
            node.transform = home;
            node.transform.translation = i == 7 ? home.translation : place(i);
        }
        const ParticleUpdate update = walk.step();
        ASSERT_TRUE(update.complete);
        const std::vector<SurfaceCharts> charts = chart_surfaces(walk.at->rays, charting);
        const CausticReuse reuse{light, update.surfaces};
        CausticLight next = build_caustic_light(walk.at->rays, charts, walk.map, settings, &reuse);
        expect_same(next, build_caustic_light(walk.at->rays, charts, walk.map, settings));
        for (const CausticLight::Side& side : next.sides) {
            for (const auto& t : side.textures) {
                const bool old = std::any_of(light.sides.begin(), light.sides.end(), [&](const CausticLight::Side& s) {
                    return std::find(s.textures.begin(), s.textures.end(), t) != s.textures.end();
                });
                (old ? kept : made) += 1;
            }
        }
        light = std::move(next);
    }
    EXPECT_GT(kept, 0U);
    EXPECT_GT(made, 0U);
}

} // namespace
} // namespace atrium
