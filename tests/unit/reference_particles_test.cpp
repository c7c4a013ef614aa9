// How the reference's particles find small bright patches: where they start, and which discs they cross.
#include "engine/base/rng.h"
#include "engine/reference/disc_tree.h"
#include "engine/reference/light_tracer.h"
#include "tests/support/moving_caustics.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace atrium {
namespace {

using test::add_material;
using test::add_rectangle;

double number(std::uint64_t i, std::uint64_t k) { return double(hash64(hash_combine(i, k)) >> 11) * 0x1p-53; }

dvec4 numbers(std::uint64_t i) { return {number(i, 0), number(i, 1), number(i, 2), number(i, 3)}; }

// What is worth something lies in a six-hundredth of the cube.
bool useful(const dvec4& u) {
    return u.x > 0.4 && u.x < 0.6 && u.y > 0.7 && u.y < 0.9 && u.z > 0.1 && u.z < 0.3 && u.w > 0.5 && u.w < 0.7;
}

TEST(StartGuide, ClosesInOnWhatIsOfUseAndStaysUnbiased) {
    constexpr std::uint64_t kTrials = 1U << 15U;
    StartGuide guide;
    std::vector<StartGuide::Trial> trials;
    for (std::uint64_t look = 0; look < 4; ++look) {
        for (std::uint64_t i = 0; i < kTrials; ++i) {
            const auto start = guide(numbers(hash_combine(look, i)));
            trials.push_back({start.at, start.density, useful(start.at) ? 1.0F : 0.0F});
        }
        guide = StartGuide(trials);
    }
    double found = 0.0;
    double volume = 0.0;
    double volume2 = 0.0;
    double all = 0.0;
    for (std::uint64_t i = 0; i < kTrials; ++i) {
        const auto start = guide(numbers(hash_combine(77, i)));
        ASSERT_TRUE(start.at == glm::clamp(start.at, dvec4(0.0), dvec4(1.0)));
        found += useful(start.at) ? 1.0 / double(kTrials) : 0.0;
        const double share = useful(start.at) ? 1.0 / double(start.density) : 0.0;
        volume += share / double(kTrials);
        volume2 += share * share / double(kTrials);
        all += 1.0 / double(start.density) / double(kTrials);
    }
    EXPECT_GT(found, 0.15) << "of the starts, where 0.0016 would be without a guide";
    const double noise = std::sqrt((volume2 - volume * volume) / double(kTrials));
    EXPECT_NEAR(volume, 1.6e-3, 4.0 * noise);
    EXPECT_LT(noise, 0.7e-4) << "2.2e-4 without a guide";
    EXPECT_NEAR(all, 1.0, 0.05);
}

TEST(StartGuide, WithoutUseEveryStartIsAsGood) {
    const std::vector<StartGuide::Trial> nothing(1000);
    const auto start = StartGuide(nothing)(dvec4(0.1, 0.2, 0.3, 0.4));
    EXPECT_EQ(start.at, dvec4(0.1, 0.2, 0.3, 0.4));
    EXPECT_EQ(start.density, 1.0F);
}

TEST(DiscTree, FindsTheDiscsThatOneByOneAreCrossed) {
    constexpr float kRadius = 0.2F;
    const auto unit = [](std::uint64_t i, std::uint64_t k) {
        const vec3 v(vec3(dvec3(number(i, k), number(i, k + 1), number(i, k + 2))) - vec3(0.5F));
        // Along the axes, too: there a box is met in its faces.
        return i % 4 == 0 ? vec3(0.0F, v.y < 0.0F ? -1.0F : 1.0F, 0.0F) : glm::normalize(v);
    };
    std::vector<CausticDisc> discs;
    for (std::uint64_t i = 0; i < 300; ++i) {
        discs.push_back({vec3(dvec3(number(i, 11), number(i, 12), number(i, 13)) * 3.0), unit(i, 21)});
    }
    const DiscTree tree(discs, kRadius);
    std::vector<std::uint32_t> found;
    std::size_t crossings = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const vec3 from(dvec3(number(i, 31), number(i, 32), number(i, 33)) * 3.0);
        const vec3 direction = unit(i, 41);
        const float length = i % 5 == 0 ? std::numeric_limits<float>::infinity() : 2.0F * float(number(i, 51));
        tree.crossed(from, direction, length, found);
        std::sort(found.begin(), found.end());
        std::vector<std::uint32_t> expected;
        for (std::uint32_t k = 0; k < discs.size(); ++k) {
            const float down = glm::dot(direction, discs[k].normal);
            const float t = down < 0.0F ? glm::dot(discs[k].centre - from, discs[k].normal) / down : -1.0F;
            if (t >= 0.0F && t <= length && glm::length(from + direction * t - discs[k].centre) < kRadius) {
                expected.push_back(k);
            }
        }
        ASSERT_EQ(found, expected) << i;
        crossings += expected.size();
    }
    EXPECT_GT(crossings, 500U);
    DiscTree({}, kRadius).crossed(vec3(0.0F), vec3(0, 1, 0), 1.0F, found);
    EXPECT_TRUE(found.empty());
}

// The sun through a hole of 20 cm in the ceiling, and a floor that is one mirror: a particle in two thousand of those that
// are aimed at the floor gets in.
TEST(LightTracer, StartsWhereLightGetsIn) {
    Scene scene;
    const MaterialId grey = add_material(scene, 0.5F);
    Material polished;
    polished.base_color = Rgb(1.0F);
    polished.metallic = 1.0F;
    polished.roughness = 0.0F;
    const MaterialId mirror = scene.materials.insert(polished);
    add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 8, 8, mirror);
    constexpr double kHole = 0.1; // half of it
    constexpr double kWide = 6;   // half of the ceiling: wider than the floor, for the sun comes aslant
    const auto ceiling = [&](const dvec2& centre, double w, double d) {
        add_rectangle(scene, "ceiling", {centre.x, 3, centre.y}, {0, -1, 0}, {1, 0, 0}, float(w), float(d), grey);
    };
    ceiling({-(kWide + kHole) / 2, 0}, kWide - kHole, 2 * kWide);
    ceiling({(kWide + kHole) / 2, 0}, kWide - kHole, 2 * kWide);
    ceiling({0, -(kWide + kHole) / 2}, 2 * kHole, kWide - kHole);
    ceiling({0, (kWide + kHole) / 2}, 2 * kHole, kWide - kHole);
    test::add_sun(scene, {0.3, -1, 0.1}, 1e5F);
    const RayScene rays(scene);
    const PathLights lights(scene, rays);
    const LightTracer tracer(rays, lights, LightTracer::Emitters::Small);
    ASSERT_TRUE(tracer.useful());
    constexpr std::uint64_t kParticles = 1U << 14U;
    std::size_t landed = 0;
    double flux = 0.0;
    double flux2 = 0.0;
    for (std::uint64_t i = 0; i < kParticles; ++i) {
        tracer.trace(9, i, false, [&](const CausticLeg& leg) {
            landed += leg.lands ? 1 : 0;
            flux += double(luminance(leg.flux));
            flux2 += double(luminance(leg.flux)) * double(luminance(leg.flux));
        });
    }
    const double mean = flux / kParticles;
    const double noise = std::sqrt((flux2 / kParticles - mean * mean) / kParticles);
    const dvec3 down = glm::normalize(dvec3(0.3, -1, 0.1));
    EXPECT_GT(double(landed), 0.2 * kParticles);
    EXPECT_NEAR(mean, 1e5 * -down.y * 4.0 * kHole * kHole, 4.0 * noise);
    EXPECT_LT(noise, 0.05 * mean);
}

} // namespace
} // namespace atrium
