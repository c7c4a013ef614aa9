#include "engine/measure/compare.h"

#include <gtest/gtest.h>

#include <cmath>

namespace atrium {
namespace {

Picture solid(int width, int height, const vec3& color) {
    return {width, height, std::vector<vec3>(std::size_t(width) * std::size_t(height), color)};
}

TEST(Difference, OfEqualValuesIsZero) {
    const std::vector<double> v = {0.0, 1.0, 2.0, 3.0};
    const Difference d = difference(v, v);
    EXPECT_EQ(d.count, 4U);
    EXPECT_EQ(d.rel_mse, 0.0);
    EXPECT_EQ(d.rel_rmse, 0.0);
    EXPECT_EQ(d.mean_relative_bias, 0.0);
    EXPECT_EQ(d.p99, 0.0);
}

TEST(Difference, FiguresOfASmallSetByHand) {
    // Mean of the reference 20, eps 0.2; errors 2, -2, 3.
    const Difference d = difference(std::vector<double>{12.0, 18.0, 33.0}, std::vector<double>{10.0, 20.0, 30.0});
    EXPECT_NEAR(d.mean_relative_bias, 1.0 / 20.0, 1e-12);
    EXPECT_NEAR(d.rel_rmse, std::sqrt((4.0 + 4.0 + 9.0) / 3.0) / 20.0, 1e-12);
    EXPECT_NEAR(d.rel_mse, (4.0 / 100.04 + 4.0 / 400.04 + 9.0 / 900.04) / 3.0, 1e-12);
    EXPECT_NEAR(d.p95, 2.0 / 10.2, 1e-12);
}

TEST(Difference, PercentilesPickTheRightRank) {
    std::vector<double> reference(100, 1.0);
    std::vector<double> values(100);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = 1.0 + double(99 - i) * 0.0101; // unsorted on purpose; (1 + eps) = 1.01
    }
    const Difference d = difference(values, reference);
    EXPECT_NEAR(d.p95, 0.94, 1e-9);
    EXPECT_NEAR(d.p99, 0.98, 1e-9);
    EXPECT_NEAR(d.max, 0.99, 1e-9);
}

TEST(Difference, ADarkReferenceIsNotDividedByZero) {
    EXPECT_EQ(difference(std::vector<double>{0.0}, std::vector<double>{0.0}).rel_mse, 0.0);
    EXPECT_TRUE(std::isinf(difference(std::vector<double>{1.0}, std::vector<double>{0.0}).rel_mse));
    EXPECT_EQ(difference({}, {}).count, 0U);
}

TEST(Flip, OfEqualPicturesIsZero) {
    Picture p = solid(40, 30, {0.2F, 0.5F, 0.1F});
    p.pixels[311] = {1.0F, 0.0F, 0.0F};
    EXPECT_EQ(flip(p, p), 0.0);
}

TEST(Flip, GreenAgainstBlueIsTheLargestErrorByDefinition) {
    // Filters leave a uniform picture alone; the paper scales its colour difference so that these two colours give 1.
    EXPECT_NEAR(flip(solid(20, 20, {0.0F, 1.0F, 0.0F}), solid(20, 20, {0.0F, 0.0F, 1.0F})), 1.0, 2e-3);
}

TEST(Flip, GrowsWithTheDifferenceAndIsSymmetric) {
    const Picture a = solid(32, 32, {0.2F, 0.2F, 0.2F});
    const Picture b = solid(32, 32, {0.25F, 0.25F, 0.25F});
    const Picture c = solid(32, 32, {0.5F, 0.5F, 0.5F});
    EXPECT_GT(flip(b, a), 0.01);
    EXPECT_GT(flip(c, a), flip(b, a));
    EXPECT_NEAR(flip(a, c), flip(c, a), 1e-6);
}

TEST(Flip, ASharpEdgeCountsMoreThanItsColorAlone) {
    const Picture flat = solid(64, 64, {0.4F, 0.4F, 0.4F});
    Picture edge = flat;
    for (std::size_t y = 0; y < 64; ++y) {
        for (std::size_t x = 32; x < 64; ++x) {
            edge.pixels[y * 64 + x] = vec3(0.5F);
        }
    }
    const Picture brighter = solid(64, 64, {0.5F, 0.5F, 0.5F});
    // Half the area differs as `brighter` does, so without the edge the mean error would be half as large.
    EXPECT_GT(flip(edge, flat), 0.5 * flip(brighter, flat) * 1.02);
}

} // namespace
} // namespace atrium
