// The brute-force reference on closed forms and published cases.
#include "engine/reference/reference.h"
#include "tests/support/light_cases.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using test::KnownLight;
using test::LightCase;

class ReferenceCase : public testing::TestWithParam<LightCase> {};

TEST_P(ReferenceCase, AgreesWithinItsStandardError) {
    const LightCase& c = GetParam();
    std::vector<ReferencePoint> points;
    for (const KnownLight& place : c.places) {
        points.push_back({place.point, place.normal});
    }
    ReferenceSettings settings;
    settings.paths = c.paths;
    const auto r = reference_irradiance(c.scene(), points, settings, RunContext{});
    ASSERT_TRUE(r);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const KnownLight& place = c.places[i];
        const double expected = luminance(place.expected);
        const double error = r->points[i].standard_error;
        EXPECT_TRUE(r->points[i].on_surface) << place.name;
        EXPECT_LE(error, 0.015 * expected) << place.name;
        EXPECT_NEAR(luminance(r->points[i].irradiance), expected, 4.0 * error + c.uncertainty * expected) << place.name;
        for (int k = 0; k < 3; ++k) { // single channels are noisier than their sum
            EXPECT_NEAR(r->points[i].irradiance[k], place.expected[k], 8.0 * error + 2.0 * c.uncertainty * place.expected[k])
                << place.name;
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Published, ReferenceCase, testing::ValuesIn(test::light_cases()),
                         [](const auto& at) { return at.param.name; });

} // namespace
} // namespace atrium
