// Webs by themselves: symmetric forms against the full one, the three types, flux against quadrature and closed forms.
#include "engine/scene/photometric_web.h"

#include "engine/base/rng.h"
#include "engine/base/units.h"
#include "engine/reference/web_reading.h"
#include "engine/scene/light.h"

#include <functional>
#include <gtest/gtest.h>

namespace atrium {
namespace {

PhotometricData data_of(PhotometryType type, std::vector<float> vertical, std::vector<float> horizontal,
                        const std::function<double(double v, double h)>& candela) {
    PhotometricData out;
    out.type = type;
    out.vertical = std::move(vertical);
    out.horizontal = std::move(horizontal);
    for (const float h : out.horizontal) {
        for (const float v : out.vertical) {
            out.candela.push_back(float(candela(double(v), double(h))));
        }
    }
    return out;
}

std::vector<float> steps(float from, float to, float step) {
    std::vector<float> out;
    for (int i = 0; from + float(i) * step <= to + 1e-3F; ++i) {
        out.push_back(from + float(i) * step);
    }
    return out;
}

vec3 random_direction(std::uint32_t k) {
    const vec2 u = sobol_owen2(k, 0, 7);
    const float z = 1.0F - 2.0F * u.x;
    const float r = std::sqrt(std::max(1.0F - z * z, 0.0F));
    return {r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z};
}

// Mean over the sphere times 4 pi.
double flux_by_points(const PhotometricWeb& web) {
    constexpr std::uint32_t kPoints = 1U << 18U;
    double sum = 0.0;
    for (std::uint32_t k = 0; k < kPoints; ++k) {
        sum += double(web.candela(random_direction(k)));
    }
    return 4.0 * kPiD * sum / kPoints;
}

void expect_same(const PhotometricWeb& a, const PhotometricWeb& b) {
    for (std::uint32_t k = 0; k < 5000; ++k) {
        const vec3 d = random_direction(k);
        ASSERT_NEAR(a.candela(d), b.candela(d), 2e-5F * a.peak()) << d.x << " " << d.y << " " << d.z;
        ASSERT_NEAR(double(a.candela(d)), read_candela(a.data(), dvec3(d)), 2e-5 * double(a.peak()));
    }
    EXPECT_NEAR(a.flux() / b.flux(), 1.0, 1e-6);
}

constexpr PhotometryType C = PhotometryType::C;

TEST(PhotometricWeb, SymmetricFormsEqualTheFullOne) {
    const std::vector<float> v = steps(0, 180, 7.5F);
    const auto rad = [](double degrees) { return radians_from_degrees(degrees); };
    // With both, one and none of the mirror planes; no symmetry at all is the wedge in h.
    const auto quarters = [&](double a, double h) { return 200 + 90 * std::cos(rad(2 * h)) * std::sin(rad(a)) + a; };
    const auto about0 = [&](double a, double h) { return 200 + 90 * std::cos(rad(h)) * std::sin(rad(a)) + a; };
    const auto about90 = [&](double a, double h) { return 200 + 90 * std::sin(rad(h)) * std::sin(rad(a)) + a; };
    const auto axial = [](double a, double) { return 300 - a; };
    const auto full = [&](const auto& f) { return PhotometricWeb(data_of(C, v, steps(0, 360, 15), f)); };
    expect_same(PhotometricWeb(data_of(C, v, {0}, axial)), full(axial));
    expect_same(PhotometricWeb(data_of(C, v, steps(0, 90, 15), quarters)), full(quarters));
    expect_same(PhotometricWeb(data_of(C, v, steps(0, 180, 15), about0)), full(about0));
    expect_same(PhotometricWeb(data_of(C, v, steps(90, 270, 15), about90)), full(about90));
    // The last plane, which is the first again, left out.
    expect_same(PhotometricWeb(data_of(C, v, steps(0, 345, 15), about90)), full(about90));
    // 180 is not among the angles of 90 to 270: between its neighbours.
    const PhotometricWeb coarse(data_of(C, v, {90, 150, 220, 270}, about90));
    expect_same(coarse, coarse);
    EXPECT_NEAR(double(coarse.candela({-1, 0, 0})), read_candela(coarse.data(), {-1, 0, 0}), 1e-3);
    EXPECT_NEAR(double(coarse.candela({1, 0, 0})), double(coarse.candela({-1, 0, 0})), 1e-3);
    EXPECT_NEAR(flux_by_points(coarse) / coarse.flux(), 1.0, 1e-3);
}

TEST(PhotometricWeb, Orientation) {
    // Brightest towards v = 90, h = 90: to the light's own +y; nadir is -z.
    const PhotometricWeb web(data_of(C, {0, 90, 180}, steps(0, 360, 90), [](double v, double h) {
        return v == 0 ? 5 : v == 180 ? 1 : h == 90 ? 100 : h == 180 ? 50 : h == 270 ? 25 : 10;
    }));
    EXPECT_FLOAT_EQ(web.candela({0, 0, -1}), 5);
    EXPECT_FLOAT_EQ(web.candela({0, 0, 1}), 1);
    EXPECT_FLOAT_EQ(web.candela({1, 0, 0}), 10);
    EXPECT_FLOAT_EQ(web.candela({0, 1, 0}), 100);
    EXPECT_FLOAT_EQ(web.candela({-1, 0, 0}), 50);
    EXPECT_FLOAT_EQ(web.candela({0, -1, 0}), 25);
}

// The same light, cd = 100 (1 + d.x + 0.5 d.y) before the front half, measured in the ways of A and B.
TEST(PhotometricWeb, TypesAAndB) {
    for (const PhotometryType type : {PhotometryType::A, PhotometryType::B}) {
        const auto light = [&](double v, double h) {
            const dvec3 d = photometric_direction(type, v, h);
            return 100 * (1 + d.x + 0.5 * d.y);
        };
        const PhotometricWeb web(data_of(type, steps(-90, 90, 2.5F), steps(-90, 90, 2.5F), light));
        for (std::uint32_t k = 0; k < 5000; ++k) {
            const vec3 d = random_direction(k);
            const double expected = d.z < 0 ? 100 * (1 + double(d.x) + 0.5 * double(d.y)) : 0.0;
            if (std::abs(d.z) > 0.01F) {
                ASSERT_NEAR(double(web.candela(d)), expected, 0.001 * double(web.peak()));
                ASSERT_NEAR(double(web.candela(d)), read_candela(web.data(), dvec3(d)), 2e-5 * double(web.peak()));
            }
        }
        // Half the sphere, the slopes cancel: 200 pi.
        EXPECT_NEAR(web.flux() / (200 * kPiD), 1.0, 1e-3);
        // Halves that mirror each other.
        const auto even = [&](double v, double h) { return 10 + std::abs(v) + 2 * std::abs(h); };
        expect_same(PhotometricWeb(data_of(type, steps(0, 90, 10), steps(0, 90, 10), even)),
                    PhotometricWeb(data_of(type, steps(-90, 90, 10), steps(-90, 90, 10), even)));
    }
}

TEST(PhotometricWeb, FluxIsTheIntegralOfWhatIsTold) {
    const PhotometricWeb uniform(data_of(C, {0, 180}, {0}, [](double, double) { return 50; }));
    EXPECT_NEAR(uniform.flux() / (200 * kPiD), 1.0, 1e-7);
    const PhotometricWeb lambert(
        data_of(C, steps(0, 90, 0.5F), {0}, [](double v, double) { return 100 * std::cos(radians_from_degrees(v)); }));
    EXPECT_NEAR(lambert.flux() / (100 * kPiD), 1.0, 1e-5);
    const auto rough = [](double v, double h) { return 30 + std::fmod(v * 7 + h * 3, 90.0); };
    for (const auto& data :
         {data_of(C, steps(0, 180, 20), steps(0, 360, 40), rough), data_of(C, {90, 100, 140}, steps(0, 180, 45), rough),
          data_of(PhotometryType::B, steps(-90, 90, 15), steps(-90, 90, 15), rough),
          data_of(PhotometryType::A, steps(-40, 90, 10), steps(-60, 60, 15), rough)}) {
        const PhotometricWeb web(data);
        EXPECT_NEAR(flux_by_points(web) / web.flux(), 1.0, 1e-3);
    }
}

TEST(PhotometricWeb, BeamAngles) {
    // 100 cd straight down, linear to 0 at 40 degrees; across, to 0 at 80.
    const auto light = [](double v, double h) {
        return std::max(100 * (1 - v / (40 + 40 * std::abs(std::sin(radians_from_degrees(h))))), 0.0);
    };
    const PhotometricWeb web(data_of(C, steps(0, 180, 5), steps(0, 360, 90), light));
    EXPECT_NEAR(web.beam_angle(0), 40, 0.01);
    EXPECT_NEAR(web.beam_angle(90), 80, 0.01);
    EXPECT_NEAR(web.beam_angle(0, 0.1), 72, 0.01);
    const PhotometricWeb up(data_of(C, steps(0, 180, 5), {0}, [&](double v, double) { return light(180 - v, 0); }));
    EXPECT_NEAR(up.beam_angle(0), 40, 0.01);
    const PhotometricWeb all(data_of(C, {0, 180}, {0}, [](double, double) { return 50; }));
    EXPECT_DOUBLE_EQ(all.beam_angle(0), 360);
}

TEST(PhotometricWeb, LightsTakeItAndGiveItBack) {
    const auto web = std::make_shared<const PhotometricWeb>(
        data_of(C, steps(0, 90, 5), {0}, [](double v, double) { return 200 * std::cos(radians_from_degrees(v)); }));
    Light light;
    set_photometry(light, web);
    EXPECT_EQ(light.intensity, 200.0F);
    EXPECT_NEAR(flux_of(light), web->flux(), 1e-4 * web->flux());
    EXPECT_EQ(light_distribution(light), web.get());
    light.intensity *= 0.5F; // dimmed
    EXPECT_NEAR(flux_of(light), 0.5 * web->flux(), 1e-4 * web->flux());
    Light sun = light;
    sun.kind = Light::Kind::Directional;
    EXPECT_EQ(light_distribution(sun), nullptr);
    EXPECT_EQ(flux_of(sun), 0.0);
    Light same = light;
    same.photometry.web = std::make_shared<const PhotometricWeb>(web->data());
    EXPECT_EQ(same, light); // another copy of the same
    remove_photometry(light);
    EXPECT_FALSE(light.photometry);
    EXPECT_NEAR(flux_of(light), 0.5 * web->flux(), 1e-4 * web->flux());
}

} // namespace
} // namespace atrium
