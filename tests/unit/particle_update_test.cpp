// Particles after an edit: what was traced again must be what a full trace of the same links finds, to the last bit.
#include "engine/base/parallel.h"
#include "engine/base/rng.h"
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

} // namespace
} // namespace atrium
