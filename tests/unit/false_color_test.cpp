#include "engine/measure/light_range.h"
#include "engine/view/false_color.h"
#include "engine/view/still.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace atrium {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;
using testing::Pointwise;

// CIE 1976 lightness of display values (IEC 61966-2-1 and CIE 15), for what makes a map readable.
double lightness(const Rgb& display) {
    const double y = 0.2126 * double(srgb_to_linear(display.r)) + 0.7152 * double(srgb_to_linear(display.g)) +
                     0.0722 * double(srgb_to_linear(display.b));
    return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(FalseColor, TheMapGetsLighterByEvenSteps) {
    // matplotlib's documentation of viridis: first and last colour #440154 and #fde725.
    EXPECT_EQ(color_map().front(), 0x440154U);
    EXPECT_EQ(color_map().back(), 0xfde725U);
    const double whole = lightness(map_color(1.0F)) - lightness(map_color(0.0F));
    EXPECT_GT(whole, 70.0);
    for (int i = 0; i < 16; ++i) {
        const double step = lightness(map_color(float(i + 1) / 16.0F)) - lightness(map_color(float(i) / 16.0F));
        EXPECT_GT(step, 0.5 * whole / 16.0) << i;
        EXPECT_LT(step, 1.5 * whole / 16.0) << i;
    }
}

TEST(FalseColor, PlacesOnLinearAndLogarithmicScales) {
    const FalseColor linear{LightQuantity::Illuminance, false, 100.0, 500.0, false};
    EXPECT_FLOAT_EQ(scale_place(linear, 200.0), 0.25F);
    EXPECT_EQ(scale_place(linear, 5.0), 0.0F);
    EXPECT_EQ(scale_place(linear, 5000.0), 1.0F);
    const FalseColor logarithmic{LightQuantity::Luminance, true, 1.0, 10000.0, false};
    EXPECT_FLOAT_EQ(scale_place(logarithmic, 10.0), 0.25F);
    EXPECT_FLOAT_EQ(scale_place(logarithmic, 1000.0), 0.75F);
    EXPECT_EQ(scale_place(logarithmic, 0.0), 0.0F);
}

TEST(FalseColor, RoundValuesAreThoseThatPeopleThinkIn) {
    FalseColor scale{LightQuantity::Illuminance, false, 0.0, 500.0, false};
    EXPECT_THAT(round_values(scale, 6), ElementsAre(0, 100, 200, 300, 400, 500));
    scale = {LightQuantity::Illuminance, true, 100.0, 1000.0, false};
    EXPECT_THAT(round_values(scale), Pointwise(DoubleEq(), {100.0, 200.0, 300.0, 500.0, 1000.0}));
    scale = {LightQuantity::Illuminance, true, 0.1, 100.0, false};
    EXPECT_THAT(round_values(scale, 10), Pointwise(DoubleEq(), {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0}));
    scale = {LightQuantity::Illuminance, true, 1.0, 1e6, false};
    EXPECT_THAT(round_values(scale, 7), Pointwise(DoubleEq(), {1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6}));
    EXPECT_THAT(round_values(scale, 4), Pointwise(DoubleEq(), {1.0, 100.0, 1e4, 1e6}));
    // Less than a power of ten: even steps, else there would be one value or none.
    scale = {LightQuantity::Illuminance, true, 210.0, 290.0, false};
    EXPECT_THAT(round_values(scale, 10), ElementsAre(210, 220, 230, 240, 250, 260, 270, 280, 290));
}

TEST(FalseColor, NeverMoreValuesThanAskedForAndAllWithinTheRange) {
    for (double low = 0.003; low < 1e5; low *= 3.7) {
        for (double width = 1.01; width < 1e7; width *= 2.3) {
            for (const bool logarithmic : {false, true}) {
                const FalseColor scale = valid_scale({LightQuantity::Luminance, logarithmic, low, low * width, false});
                const std::vector<double> values = round_values(scale);
                EXPECT_LE(values.size(), 12U);
                EXPECT_GE(values.size(), 2U) << scale.minimum << " " << scale.maximum << logarithmic;
                for (const double value : values) {
                    EXPECT_GE(value, scale.minimum * (1.0 - 1e-6));
                    EXPECT_LE(value, scale.maximum * (1.0 + 1e-6));
                }
            }
        }
    }
}

TEST(FalseColor, AnyRangeBecomesOneThatCanBeDrawn) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const bool logarithmic : {false, true}) {
        for (const double low : {-5.0, 0.0, 300.0, 1e300, nan}) {
            for (const double high : {-1.0, 0.0, 300.0, 1e300, nan}) {
                const FalseColor scale = valid_scale({LightQuantity::Illuminance, logarithmic, low, high, false});
                EXPECT_LT(scale.minimum, scale.maximum);
                EXPECT_TRUE(std::isfinite(scale_place(scale, 17.0)));
                EXPECT_TRUE(!logarithmic || scale.minimum > 0.0);
                EXPECT_EQ(valid_scale(scale), scale);
            }
        }
    }
    const FalseColor turned = valid_scale({LightQuantity::Illuminance, false, 500.0, 100.0, false});
    EXPECT_EQ(turned.minimum, 100.0);
    EXPECT_EQ(turned.maximum, 500.0);
}

/// Two squares with even light: one of 3 m2 in 40 lx, one of 1 m2 in 900 lx.
std::pair<Scene, std::shared_ptr<Solution>> two_squares() {
    Scene scene;
    auto solution = std::make_shared<Solution>();
    const auto add = [&](double width, float lux, float rho, double x) {
        Material material;
        material.base_color = Rgb(rho);
        const auto half = float(0.5 * width);
        Node node;
        node.transform.translation = dvec3(x, 0.0, 0.0);
        node.shape =
            scene.shapes.insert({"", Polygon{{{-half, -0.5F}, {half, -0.5F}, {half, 0.5F}, {-half, 0.5F}}, {}}, {}});
        node.materials = {scene.materials.insert(material)};
        auto layer = std::make_shared<SurfaceLayer>();
        layer->mesh = std::make_shared<DisplayMesh>(make_display_mesh(*scene.shapes.find(node.shape), 0));
        layer->irradiance_front.assign(layer->mesh->positions.size(), Rgb(lux));
        layer->direct_front.assign(layer->mesh->positions.size(), Rgb(0.5F * lux));
        layer->node = scene.nodes.insert(node);
        scene.roots.push_back(layer->node);
        solution->surfaces.push_back(layer);
    };
    add(3.0, 40.0F, 0.8F, 0.0);
    add(1.0, 900.0F, 0.2F, 3.0);
    return {scene, solution};
}

TEST(LightRange, IsThatOfTheSurfacesByArea) {
    const auto [scene, solution] = two_squares();
    const LightRange all = light_range(scene, *solution, LightQuantity::Illuminance);
    EXPECT_NEAR(all.low, 60.0, 0.01);
    EXPECT_NEAR(all.high, 1350.0, 0.1);
    const LightRange direct = light_range(scene, *solution, LightQuantity::Illuminance, {false, true, false});
    EXPECT_NEAR(direct.high, 450.0, 0.1);
    // L = rho E / pi.
    const LightRange seen = light_range(scene, *solution, LightQuantity::Luminance);
    EXPECT_NEAR(seen.low, 0.8 * 60.0 / kPiD, 0.01);
    EXPECT_NEAR(seen.high, 0.2 * 1350.0 / kPiD, 0.01);
}

TEST(FalseColor, StillsHaveTheColourOfTheAmountAndGreyOutside) {
    const auto [scene, solution] = two_squares();
    ViewCamera camera;
    camera.to_world[3] = dvec4(1.0, 0.0, 4.0, 1.0);
    camera.lens.yfov = 1.2F;
    StillOptions options;
    options.width = 120;
    options.height = 60;
    const auto at = [&](const Picture& picture, double x, double y) { // a point of the plane z = 0
        const double scale = 30.0 / (std::tan(0.6) * 4.0);
        return picture.pixels[std::size_t(30.0 - scale * y) * 120U + std::size_t(60.0 + scale * (x - 1.0))];
    };
    const auto expect = [](const Rgb& pixel, const Rgb& wanted, const char* what) {
        EXPECT_NEAR(glm::length(pixel - wanted), 0.0F, 1e-3F) << what;
    };
    FalseColor scale{LightQuantity::Illuminance, true, 10.0, 3000.0, true};
    const Picture lux = render_false_color(scene, *solution, camera, options, scale, {});
    expect(at(lux, 0.5, 0.1), false_color(scale, 60.0), "direct and diffuse light");
    expect(at(lux, 3.0, 0.1), false_color(scale, 1350.0), "the bright square");
    expect(at(lux, 0.5, 1.5), Rgb(0.27F), "nothing is there");
    scale.quantity = LightQuantity::Luminance;
    const Picture nits = render_false_color(scene, *solution, camera, options, scale, {});
    expect(at(nits, 3.0, 0.1), false_color(scale, 0.2 * 1350.0 / kPiD), "luminance");
    options.shares = {false, true, false};
    expect(at(render_false_color(scene, *solution, camera, options, scale, {}), 3.0, 0.1),
           false_color(scale, 0.2 * 450.0 / kPiD), "direct light alone");
}

TEST(LightRange, ScalesFitAroundIt) {
    const FalseColor linear = fitted_scale({}, {60.0, 1350.0});
    EXPECT_EQ(linear.minimum, 0.0);
    EXPECT_NEAR(linear.maximum, 2000.0, 1e-9);
    FalseColor logarithmic;
    logarithmic.logarithmic = true;
    logarithmic = fitted_scale(logarithmic, {60.0, 1350.0});
    EXPECT_NEAR(logarithmic.minimum, 50.0, 1e-9);
    EXPECT_NEAR(logarithmic.maximum, 2000.0, 1e-9);
    EXPECT_EQ(fitted_scale(logarithmic, {}), logarithmic); // no light tells nothing
}

} // namespace
} // namespace atrium
