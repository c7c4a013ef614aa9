// A memory budget is kept by coarser light, and said so.
#include "engine/solver/memory_budget.h"

#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace test;

TEST(MemoryBudget, TakesNothingFromScenesThatFit) {
    const QualitySettings wanted = quality_settings(SolverSettings::Quality::Normal, 10.0F, 0.0);
    QualitySettings kept = wanted;
    keep_within(kept, std::size_t(16) << 30U, 1'000'000);
    EXPECT_EQ(kept.refine.max_links, wanted.refine.max_links);
    EXPECT_EQ(kept.maps.max_samples, wanted.maps.max_samples);
    EXPECT_EQ(kept.layers.max_vertices, wanted.layers.max_vertices);
    EXPECT_EQ(kept.particles, wanted.particles);
    EXPECT_GE(kept.most_particles, 2 * kept.particles);
    EXPECT_EQ(kept.caustics.most_texels, wanted.caustics.most_texels);
}

TEST(MemoryBudget, LessMemoryIsNeverMoreOfAnything) {
    QualitySettings before = quality_settings(SolverSettings::Quality::Fine, 10.0F, 0.0);
    for (std::size_t mib = 8192; mib > 0; mib /= 2) {
        QualitySettings q = quality_settings(SolverSettings::Quality::Fine, 10.0F, 0.0);
        keep_within(q, mib << 20U, 100'000);
        EXPECT_LE(q.refine.max_links, before.refine.max_links);
        EXPECT_LE(q.maps.max_samples, before.maps.max_samples);
        EXPECT_LE(q.layers.max_vertices, before.layers.max_vertices);
        EXPECT_LE(q.particles, before.particles);
        EXPECT_LE(q.most_particles, before.most_particles);
        EXPECT_LE(q.particles, q.most_particles);
        EXPECT_LE(q.caustics.most_texels, before.caustics.most_texels);
        EXPECT_GT(q.maps.max_samples, 0U);
        before = q;
    }
    EXPECT_LT(before.maps.max_samples, 1'000'000U);
}

TEST(MemoryBudget, DefaultIsHalfOfTheMachine) {
    const std::size_t half = memory_budget();
    EXPECT_GT(half, std::size_t(256) << 20U);
    set_memory_budget(std::size_t(300) << 20U);
    EXPECT_EQ(memory_budget(), std::size_t(300) << 20U);
    set_memory_budget(0);
    EXPECT_EQ(memory_budget(), half);
}

// Many small lamps over a large floor, whose shadows ask for more texels than fit: fewer are made, and it is said.
TEST(MemoryBudget, LightIsCoarserAndSaysSo) {
    Scene scene;
    const MaterialId grey = add_material(scene, 0.3F);
    add_room(scene, 60, 4, 40, grey);
    for (int i = 0; i < 40; ++i) {
        add_rectangle(scene, "board", {1.0 + i % 10 * 6, 1.0, 4.0 + i / 10 * 9.0}, {0, 1, 0}, {1, 0, 0}, 1.5, 1.5, grey);
        add_point_light(scene, {3.0 + i % 10 * 6, 3.0, 4.0 + i / 10 * 9.0}, 1000);
    }
    const auto texels = [](const Solution& solution) {
        std::size_t sum = 0;
        for (const auto& layer : solution.surfaces) {
            sum += layer->direct_map_front ? layer->direct_map_front->image.size() : 0;
        }
        return sum;
    };
    const Solved free = solve(scene);
    set_memory_budget(std::size_t(32) << 20U);
    const Solved bound = solve(scene);
    set_memory_budget(0);
    ASSERT_TRUE(free.solution && bound.solution);
    EXPECT_FALSE(free.solution->statistics.link_budget_reached);
    EXPECT_TRUE(bound.solution->statistics.link_budget_reached);
    EXPECT_TRUE(lowered_by_memory(free.solution->statistics.features).empty());
    const std::vector<std::string> lowered = lowered_by_memory(bound.solution->statistics.features);
    EXPECT_EQ(std::count(lowered.begin(), lowered.end(), "finer_light_maps"), 1);
    EXPECT_EQ(std::count(lowered.begin(), lowered.end(), "more_particles"), 0) << "there are none";
    const auto again = decode_solution(encode_solution(*bound.solution, scene), scene);
    ASSERT_TRUE(again);
    EXPECT_EQ(lowered_by_memory((*again)->statistics.features), lowered) << "a project remembers it";
    EXPECT_GT(texels(*free.solution), 300'000U);
    EXPECT_LT(texels(*bound.solution), 250'000U);
    const double mean = mean_irradiance(scene, *free.solution);
    EXPECT_NEAR(mean_irradiance(scene, *bound.solution) / mean, 1.0, 0.05) << "coarser, not darker";
}

} // namespace
} // namespace atrium
