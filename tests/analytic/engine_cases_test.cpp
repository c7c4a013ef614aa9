// The engine at normal quality on closed forms and published cases: as it is shown, within 2 %.
#include "tests/support/light_cases.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using test::KnownLight;
using test::LightCase;

class EngineCase : public testing::TestWithParam<LightCase> {};

TEST_P(EngineCase, IsShownWithinTwoPerCent) {
    const LightCase& c = GetParam();
    const Scene scene = c.scene();
    const test::Solved solved = test::solve(scene);
    ASSERT_TRUE(solved.solution);
    for (const KnownLight& place : c.places) {
        const SensorReading shown = read_surface(scene, *solved.solution, place.point, place.normal);
        EXPECT_TRUE(shown.on_surface) << place.name;
        const double expected = luminance(place.expected);
        EXPECT_NEAR(luminance(shown.irradiance) / expected, 1.0, 0.02 + c.uncertainty) << place.name;
    }
}
INSTANTIATE_TEST_SUITE_P(Published, EngineCase, testing::ValuesIn(test::light_cases()),
                         [](const auto& at) { return at.param.name; });

} // namespace
} // namespace atrium
