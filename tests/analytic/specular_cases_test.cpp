// Mirrors, metals and glass at a point against the numbers of shared/validation and against what energy allows.
#include "engine/base/float_traps.h"
#include "engine/optics/ggx.h"
#include "engine/optics/specular.h"
#include "engine/raycast/ray_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>
#include <random>

namespace atrium {
namespace {

struct FresnelRow {
    double n;
    double degrees;
    double reflectance;
    double pane;      // both faces, each polarisation by itself
    double refracted; // degrees
};
const FresnelRow kFresnel[] = {
    {1.33, 0, 0.020059312, 0.9606703, 0},
    {1.33, 30, 0.021112458, 0.95881327, 22.0824},
    {1.33, 45, 0.027521384, 0.9475647, 32.1176},
    {1.33, 60, 0.059125599, 0.89341392, 40.6281},
    {1.33, 70, 0.1326566, 0.77584989, 44.9538},
    {1.33, 80, 0.3469161, 0.49453119, 47.7704},
    {1.33, 85, 0.58272824, 0.26770868, 48.5054},
    {1.33, 89, 0.89604651, 0.055047303, 48.7435},
    {1.5, 0, 0.04, 0.92307692, 0},
    {1.5, 30, 0.041522626, 0.92073444, 19.4712},
    {1.5, 45, 0.050239911, 0.90734433, 28.1255},
    {1.5, 60, 0.089186713, 0.84812841, 35.2644},
    {1.5, 70, 0.17104254, 0.72871213, 38.7896},
    {1.5, 80, 0.38770435, 0.4584728, 41.0364},
    {1.5, 85, 0.61279965, 0.24693058, 41.6156},
    {1.5, 89, 0.90418495, 0.050678959, 41.8025},
    {1.52, 0, 0.042579995, 0.91831803, 0},
    {1.52, 30, 0.044143501, 0.91595731, 19.2049},
    {1.52, 45, 0.053045232, 0.90252826, 27.7233},
    {1.52, 60, 0.092482705, 0.84347067, 34.733},
    {1.52, 70, 0.1747119, 0.72471278, 38.1862},
    {1.52, 80, 0.39094986, 0.45604344, 40.3834},
    {1.52, 85, 0.61492349, 0.24564552, 40.9493},
    {1.52, 89, 0.90469177, 0.050417022, 41.1319},
    {2.42, 0, 0.17239492, 0.70590981, 0},
    {2.42, 30, 0.17388297, 0.70590807, 11.9239},
    {2.42, 45, 0.18152106, 0.70530557, 16.9893},
    {2.42, 60, 0.21159757, 0.69460661, 20.9689},
    {2.42, 70, 0.27085862, 0.64697062, 22.8489},
    {2.42, 80, 0.43332761, 0.45775937, 24.0131},
    {2.42, 85, 0.62162162, 0.25912633, 24.3086},
    {2.42, 89, 0.89969295, 0.054197558, 24.4035},
};

Material glass(float ior, float thickness = 1.0F) {
    Material m;
    m.base_color = Rgb(1.0F);
    m.transmission = 1.0F;
    m.roughness = 0.0F;
    m.ior = ior;
    m.thickness = thickness;
    return m;
}

Material metal(float roughness, float f0 = 1.0F) {
    Material m;
    m.base_color = Rgb(f0);
    m.metallic = 1.0F;
    m.roughness = roughness;
    return m;
}

SpecularPoint on_plane(const Material& m, bool front = true) {
    return {&m, m.base_color, vec3(0, 0, 1), vec3(0, 0, 1), front};
}

vec3 arriving(double degrees) {
    const double a = radians_from_degrees(degrees);
    return {float(std::sin(a)), 0.0F, float(-std::cos(a))};
}

struct Mean {
    double weight = 0.0;
    double reflected = 0.0;
    double transmitted = 0.0;
};
/// Mean over stratified numbers: side x side places in the lobe, `lobes` strata of the choice.
Mean mean_weight(const SpecularPoint& at, const vec3& in, unsigned side, unsigned lobes = 1) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> jitter(0.0F, 0.999F);
    Mean out;
    for (unsigned i = 0; i < side * side * lobes; ++i) {
        const unsigned k = i / lobes;
        const vec3 u((float(k % side) + jitter(random)) / float(side), (float(k / side) + jitter(random)) / float(side),
                     (float(i % lobes) + jitter(random)) / float(lobes));
        const SpecularSample s = sample_specular(at, in, u);
        const double w = s.weight.g / double(side * side * lobes);
        EXPECT_TRUE(w >= 0.0 && is_finite(s.weight));
        EXPECT_NEAR(glm::length(s.direction), 1.0F, 1e-4F);
        out.weight += w;
        (s.transmitted ? out.transmitted : out.reflected) += w;
    }
    return out;
}

TEST(SpecularCases, FresnelReflectance) {
    for (const FresnelRow& row : kFresnel) {
        const double cosine = std::cos(radians_from_degrees(row.degrees));
        EXPECT_NEAR(fresnel_dielectric(float(cosine), float(row.n)), row.reflectance, 1e-6) << row.n << " " << row.degrees;
        const double inside = std::cos(radians_from_degrees(row.refracted));
        // Seen from within, a rounding of the cosine weighs more the closer the critical angle is.
        EXPECT_NEAR(fresnel_dielectric(float(inside), float(1.0 / row.n)), row.reflectance, row.degrees < 80 ? 4e-6 : 1e-3);
    }
    const struct {
        double n, brewster, critical;
    } angles[] = {{1.33, 53.061237, 48.753467},
                  {1.5, 56.309932, 41.810315},
                  {1.52, 56.659293, 41.13951},
                  {2.42, 67.548454, 24.407469}};
    for (const auto& a : angles) {
        const double rs = (1 - a.n * a.n) / (1 + a.n * a.n); // all that is left of it where Rp = 0
        EXPECT_NEAR(fresnel_dielectric(float(std::cos(radians_from_degrees(a.brewster))), float(a.n)), 0.5 * rs * rs, 1e-6);
        const auto within = [&](double degrees) {
            return fresnel_dielectric(float(std::cos(radians_from_degrees(degrees))), float(1 / a.n));
        };
        EXPECT_EQ(within(a.critical + 1e-4), 1.0F) << a.n;
        EXPECT_LT(within(a.critical - 1e-2), 0.95F) << a.n;
    }
    EXPECT_EQ(fresnel_dielectric(0.0F, 1.0F), 0.0F);
    EXPECT_EQ(fresnel_dielectric(0.0F, 1.5F), 1.0F);
}

TEST(SpecularCases, HemisphericalFresnelReflectance) {
    const struct {
        double n, outside, inside;
    } rows[] = {{1.33, 0.065930849, 0.47194915},
                {1.5, 0.091777959, 0.59634576},
                {1.52, 0.094706927, 0.60816609},
                {2.42, 0.21254079, 0.86553869}};
    for (const auto& row : rows) {
        constexpr int kSteps = 200000;
        double outside = 0.0;
        double inside = 0.0;
        for (int i = 0; i < kSteps; ++i) { // uniform in the squared cosine, as a diffuse field meets the plane
            const float cosine = float(std::sqrt((i + 0.5) / kSteps));
            outside += fresnel_dielectric(cosine, float(row.n)) / kSteps;
            inside += fresnel_dielectric(cosine, float(1.0 / row.n)) / kSteps;
        }
        EXPECT_NEAR(outside, row.outside, 1e-5) << row.n;
        EXPECT_NEAR(inside, row.inside, 1e-5) << row.n;
    }
}

TEST(SpecularCases, BeerLambert) {
    const struct {
        float color, distance, path;
        double expected, tolerance;
    } rows[] = {{0.5F, 0.006F, 0.006F, 0.5, 1e-6},
                {0.5F, 0.006F, 0.0005F, 0.9438743127, 1e-6},
                {0.9F, 0.1F, 1.0F, 0.3486784401, 1e-6},
                {0.01F, 0.01F, 0.1F, 1e-20, 3e-6}, // 46 e-foldings of numbers that are rounded to floats
                {1.0F, 1.0F, 5.0F, 1.0, 1e-6}};
    for (const auto& row : rows) {
        Material m = glass(1.5F);
        m.attenuation_color = Rgb(row.color);
        m.attenuation_distance = row.distance;
        EXPECT_NEAR(absorption(m, row.path).g / row.expected, 1.0, row.tolerance) << row.color;
    }
    Material m = glass(1.5F);
    EXPECT_EQ(absorption(m, 1e9F), Rgb(1.0F)) << "no attenuation";
    m.attenuation_color = Rgb(0.0F, 1.0F, 0.5F);
    m.attenuation_distance = 1.0F;
    EXPECT_EQ(absorption(m, 0.0F), Rgb(1.0F));
    EXPECT_EQ(absorption(m, 2.0F), Rgb(0.0F, 1.0F, 0.25F));
    m.attenuation_distance = 0.0F;
    EXPECT_EQ(absorption(m, 2.0F), Rgb(0.0F, 1.0F, 0.0F));
    EXPECT_EQ(absorption(m, std::numeric_limits<float>::infinity()), Rgb(0.0F, 1.0F, 0.0F));
    const FloatTrapsOff no_number_on_purpose;
    EXPECT_EQ(absorption(m, std::numeric_limits<float>::quiet_NaN()), Rgb(1.0F));
}

TEST(SpecularCases, GgxFurnace) {
    const struct {
        float alpha, mu;
        double albedo;
    } rows[] = {
        {0.1F, 1.0F, 0.98832}, {0.1F, 0.7F, 0.98142}, {0.1F, 0.5F, 0.9692},  {0.1F, 0.2F, 0.90454}, {0.1F, 0.05F, 0.91163},
        {0.3F, 1.0F, 0.87737}, {0.3F, 0.7F, 0.84453}, {0.3F, 0.5F, 0.82171}, {0.3F, 0.2F, 0.83851}, {0.3F, 0.05F, 0.93143},
        {0.5F, 1.0F, 0.68785}, {0.5F, 0.7F, 0.68295}, {0.5F, 0.5F, 0.69825}, {0.5F, 0.2F, 0.78993}, {0.5F, 0.05F, 0.91257},
        {0.8F, 1.0F, 0.427},   {0.8F, 0.7F, 0.48192}, {0.8F, 0.5F, 0.54013}, {0.8F, 0.2F, 0.7004},  {0.8F, 0.05F, 0.87401},
        {1.0F, 1.0F, 0.30686}, {1.0F, 0.7F, 0.37889}, {1.0F, 0.5F, 0.45069}, {1.0F, 0.2F, 0.64165}, {1.0F, 0.05F, 0.84778},
    };
    for (const auto& row : rows) {
        const vec3 view(std::sqrt(1.0F - row.mu * row.mu), 0.0F, row.mu);
        constexpr unsigned kSide = 400;
        double sum = 0.0;
        for (unsigned i = 0; i < kSide * kSide; ++i) {
            const vec2 u((float(i % kSide) + 0.5F) / float(kSide), (float(i / kSide) + 0.5F) / float(kSide));
            const vec3 h = ggx_visible_normal(view, row.alpha, u);
            const float weight = ggx_reflected(row.mu, glm::reflect(-view, h).z, row.alpha);
            EXPECT_LE(weight, 1.0F);
            sum += weight;
        }
        EXPECT_NEAR(sum / (kSide * kSide), row.albedo, 0.002) << row.alpha << " " << row.mu;
        if (row.alpha < kDullMetal * kDullMetal) { // the same over the whole way from a material
            const Material m = metal(std::sqrt(row.alpha));
            EXPECT_NEAR(mean_weight(on_plane(m), -view, kSide).weight, row.albedo, 0.002) << row.alpha << " " << row.mu;
            EXPECT_NEAR(specular_albedo(on_plane(m), -view), row.albedo, 0.02) << row.alpha << " " << row.mu;
        }
    }
}

TEST(SpecularCases, GgxLobeWidth) {
    for (const float alpha : {0.0016F, 0.01F, 0.05F, 0.25F, 0.5F, 1.0F}) {
        // The square of the angle, over where half vectors lie: D cos, whose tangent is alpha sqrt(u / (1 - u)).
        double sum = 0.0;
        constexpr int kSteps = 200000;
        for (int i = 0; i < kSteps; ++i) { // even in the square root of 1 - u, which the long tail needs
            const double left = (i + 0.5) / kSteps;
            const double angle = std::atan(alpha * std::sqrt((1 - left * left) / (left * left)));
            sum += angle * angle * 2.0 * left / kSteps;
        }
        EXPECT_NEAR(ggx_rms_tilt(alpha) / std::sqrt(sum), 1.0, 0.02) << alpha;
    }
}

TEST(SpecularCases, GgxIsReciprocal) {
    // Light from a patch of directions to another equals that from the other to it, whatever lies between.
    const Material m = metal(0.45F, 0.7F);
    const auto from_to = [&](const vec2& source, const vec2& target) { // cosines and azimuths at the patch's low corners
        double sum = 0.0;
        constexpr unsigned kSamples = 1U << 20U;
        std::mt19937 random(3);
        std::uniform_real_distribution<float> unit(0.0F, 0.9999F);
        for (unsigned i = 0; i < kSamples; ++i) {
            const float c = source.x + 0.3F * unit(random);
            const float phi = source.y + 0.8F * unit(random);
            const float s = std::sqrt(1.0F - c * c);
            const vec3 in(-s * std::cos(phi), -s * std::sin(phi), -c);
            const vec3 u(unit(random), unit(random), unit(random));
            const SpecularSample way = sample_specular(on_plane(m), in, u);
            const float azimuth = std::atan2(way.direction.y, way.direction.x) - target.y;
            const float turned = azimuth < 0.0F ? azimuth + 2.0F * kPi : azimuth;
            if (way.direction.z >= target.x && way.direction.z < target.x + 0.3F && turned < 0.8F) {
                sum += double(c) * way.weight.g;
            }
        }
        return sum / kSamples;
    };
    const vec2 low(0.1F, 0.0F);
    const vec2 high(0.6F, 2.6F);
    const double there = from_to(low, high);
    EXPECT_GT(there, 0.01);
    EXPECT_NEAR(from_to(high, low) / there, 1.0, 0.015);
}

TEST(SpecularCases, MirrorReflectsItsColourAndWhiteAtGrazing) {
    const Material m = metal(0.0F, 0.9F);
    const SpecularSample s = sample_specular(on_plane(m), arriving(30), {0.3F, 0.6F, 0.9F});
    EXPECT_LT(glm::length(s.direction - vec3(0.5F, 0.0F, std::sqrt(0.75F))), 1e-6F);
    EXPECT_EQ(s.spread, 0.0F);
    EXPECT_FALSE(s.transmitted);
    EXPECT_NEAR(s.weight.g, 0.9F, 1e-5F);
    EXPECT_GT(sample_specular(on_plane(m), arriving(89.9), {0.3F, 0.6F, 0.9F}).weight.g, 0.99F);
    Material half = m;
    half.metallic = 0.6F;
    EXPECT_NEAR(sample_specular(on_plane(half), arriving(0), vec3(0.5F)).weight.g, 0.54F, 1e-6F);
    EXPECT_NEAR(diffuse_reflectance(half).g, 0.36F, 1e-6F) << "the two add up to the colour";
}

TEST(SpecularCases, SolidGlassRefractsBySnellAndKeepsEnergy) {
    for (const FresnelRow& row : kFresnel) {
        const Material m = glass(float(row.n));
        const Mean entering = mean_weight(on_plane(m), arriving(row.degrees), 1, 1U << 12U);
        EXPECT_NEAR(entering.weight, 1.0, 1e-5);
        EXPECT_NEAR(entering.reflected, row.reflectance, 1e-3);
        EXPECT_NEAR(specular_albedo(on_plane(m), arriving(row.degrees)), 1.0, 1e-5);
        const SpecularSample in = sample_specular(on_plane(m), arriving(row.degrees), {0.5F, 0.5F, 0.9999F});
        ASSERT_TRUE(in.transmitted);
        const double angle = degrees_from_radians(std::atan2(std::hypot(in.direction.x, in.direction.y), -in.direction.z));
        EXPECT_NEAR(angle, row.refracted, 1e-3) << row.n << " " << row.degrees;
        EXPECT_NEAR(in.direction.y, 0.0, 1e-6);
        EXPECT_GE(in.direction.x, 0.0F);
        if (row.degrees < 88) { // and out again: the same angle as before
            const SpecularSample out = sample_specular(on_plane(m, false), in.direction, {0.5F, 0.5F, 0.9999F});
            ASSERT_TRUE(out.transmitted) << row.n << " " << row.degrees;
            EXPECT_LT(glm::length(out.direction - arriving(row.degrees)), 1e-4F);
        }
    }
    const Material m = glass(1.5F);
    const SpecularSample total = sample_specular(on_plane(m, false), arriving(45), {0.5F, 0.5F, 0.9999F});
    EXPECT_FALSE(total.transmitted) << "total internal reflection";
    EXPECT_NEAR(total.weight.g, 1.0F, 1e-6F);
    for (const float ior : {1.0F, 0.5F, 0.0F}) { // no bending without an index
        const Material air = glass(ior);
        const SpecularSample s = sample_specular(on_plane(air), arriving(50), vec3(0.0F));
        EXPECT_TRUE(s.transmitted);
        EXPECT_NEAR(s.weight.g, 1.0F, 1e-6F);
        EXPECT_LT(glm::length(s.direction - arriving(50)), 1e-6F);
    }
}

TEST(SpecularCases, TransmissionAndColourScaleWhatGoesThrough) {
    Material m = glass(1.5F);
    m.transmission = 0.8F;
    m.base_color = Rgb(0.5F);
    const Mean both = mean_weight(on_plane(m), arriving(0), 1, 1U << 14U);
    EXPECT_NEAR(both.reflected, 0.04, 1e-4);
    EXPECT_NEAR(both.transmitted, 0.96 * 0.8 * 0.5, 1e-4);
}

TEST(SpecularCases, ClearSheetClosesEnergyWithWhatGoesStraightOn) {
    for (const FresnelRow& row : kFresnel) {
        Scene scene;
        const Material m = glass(float(row.n), 0.0F);
        EXPECT_TRUE(is_clear_sheet(m));
        test::add_rectangle(scene, "pane", {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 100, 100, scene.materials.insert(m));
        const RayScene rays(scene);
        const vec3 in = arriving(row.degrees);
        const Hit hit = rays.nearest({vec3(0.3F, 0.4F, 0.0F) - in * 0.5F, in});
        ASSERT_TRUE(hit);
        const SpecularSample s = sample_specular(on_plane(m), in, vec3(0.7F));
        EXPECT_FALSE(s.transmitted);
        const float through = rays.straight_through(hit, in).g;
        EXPECT_NEAR(s.weight.g + through, 1.0F, 1e-5F);
        EXPECT_NEAR(through, row.pane, row.degrees <= 30 ? 3e-3 : 0.08) << "polarisations are not told apart";
    }
}

TEST(SpecularCases, FrostedSheetSplitsBetweenBothSides) {
    Material m = glass(1.5F, 0.0F);
    m.roughness = 0.4F;
    m.base_color = Rgb(0.5F);
    EXPECT_FALSE(is_clear_sheet(m));
    const Mean tinted = mean_weight(on_plane(m), arriving(20), 64, 16);
    const float both = 2.0F * 0.04F / 1.04F;
    EXPECT_NEAR(tinted.reflected, both, 0.005);
    EXPECT_NEAR(tinted.transmitted, 0.5 * (1.0 - both), 0.02);
    m.base_color = Rgb(1.0F);
    for (const double degrees : {0.0, 40.0, 70.0, 85.0}) { // of white all but what facets hide from each other
        const Material shield = metal(0.4F);
        const double albedo = mean_weight(on_plane(shield), arriving(degrees), 128).weight;
        EXPECT_NEAR(mean_weight(on_plane(m), arriving(degrees), 128, 4).weight, albedo, 0.004) << degrees;
    }
}

TEST(SpecularCases, RoughSolidGlassRefractsAboutSnellsDirection) {
    Material m = glass(1.5F);
    m.roughness = 0.2F;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0.0F, 0.9999F);
    vec3 mean(0.0F);
    float spread = 0.0F;
    for (int i = 0; i < 100000; ++i) {
        const vec3 u(unit(random), unit(random), unit(random));
        const SpecularSample s = sample_specular(on_plane(m), arriving(30), u);
        if (s.transmitted) {
            mean += s.direction * s.weight.g / 100000.0F;
            spread = s.spread;
        }
    }
    EXPECT_NEAR(glm::length(mean), 0.96F, 0.01F);
    const vec3 middle = glm::normalize(mean);
    EXPECT_NEAR(degrees_from_radians(std::atan2(middle.x, -middle.z)), 19.47, 0.3);
    EXPECT_GT(spread, 0.01F);
    EXPECT_LT(spread, 0.06F);
}

TEST(SpecularCases, NothingIsGainedLeaksOrBreaks) {
    std::vector<Material> materials{metal(0.0F), metal(0.2F), metal(0.49F), glass(1.5F), glass(2.42F), glass(1.5F, 0.0F)};
    for (const float roughness : {0.05F, 0.3F, 1.0F}) {
        for (const float thickness : {0.0F, 1.0F}) {
            materials.push_back(glass(1.5F, thickness));
            materials.back().roughness = roughness;
        }
    }
    std::mt19937 random(17);
    std::uniform_real_distribution<float> unit(0.0F, 0.9999F);
    for (const Material& m : materials) {
        ASSERT_TRUE(is_specular(m));
        for (int i = 0; i < 60; ++i) {
            // From straight down to along the plane; shading normals up to 50 degrees off the geometric one.
            const float c = i < 20 ? std::pow(10.0F, -0.4F * float(i)) : unit(random);
            const vec3 in(std::sqrt(std::max(1.0F - c * c, 0.0F)), 0.0F, -c);
            SpecularPoint at = on_plane(m, i % 2 == 0);
            at.slab = i % 7 == 3;
            if (i % 3 != 0) {
                at.normal = glm::normalize(vec3(2.4F * unit(random) - 1.2F, 2.4F * unit(random) - 1.2F, 1.0F));
            }
            double sum = 0.0;
            constexpr int kSamples = 1024;
            for (int k = 0; k < kSamples; ++k) {
                const vec2 u = {(float(k % 32) + unit(random)) / 32.0F, (float(k / 32) + unit(random)) / 32.0F};
                const SpecularSample s = sample_specular(at, in, {u, unit(random)});
                ASSERT_TRUE(is_finite(s.direction) && is_finite(s.weight) && std::isfinite(s.spread));
                EXPECT_NEAR(glm::length(s.direction), 1.0F, 1e-4F);
                if (max_component(s.weight) > 0.0F) {
                    EXPECT_EQ(s.direction.z < 0.0F, s.transmitted) << "light leaks";
                    EXPECT_FALSE(at.slab && m.thickness > 0.0F && s.transmitted);
                }
                sum += s.weight.g;
            }
            EXPECT_LE(sum / kSamples, 1.0 + 1e-5) << m.roughness << " " << m.thickness << " " << c;
        }
        const FloatTrapsOff no_numbers_on_purpose;
        const float nan = std::numeric_limits<float>::quiet_NaN();
        for (const vec3& in : {vec3(1, 0, 0), vec3(0, 0, 1), vec3(0.0F), vec3(nan), vec3(0, 0, -1)}) {
            for (const vec3& n : {vec3(0, 0, 1), vec3(0.0F), vec3(nan), vec3(0, 0, -1)}) {
                for (const vec3& g : {vec3(0, 0, 1), vec3(0.0F), vec3(nan)}) {
                    const SpecularSample s = sample_specular({&m, Rgb(1.0F), n, g, true}, in, {0.0F, 0.0F, 0.999F});
                    EXPECT_TRUE(is_finite(s.weight));
                    EXPECT_TRUE(max_component(s.weight) == 0.0F || is_finite(s.direction));
                }
            }
        }
    }
    EXPECT_EQ(sample_specular({}, {0, 0, -1}, vec3(0.5F)).weight, Rgb(0.0F)) << "no material";
}

TEST(SpecularCases, DullAndDiffuseSurfacesAreNoneOfIt) {
    const Material dull = metal(kDullMetal, 0.8F);
    const Material matt;
    for (const Material* m : {&dull, &matt}) {
        EXPECT_FALSE(is_specular(*m));
        EXPECT_EQ(sample_specular(on_plane(*m), {0, 0, -1}, vec3(0.5F)).weight, Rgb(0.0F));
        EXPECT_EQ(specular_albedo(on_plane(*m), {0, 0, -1}), 0.0F);
        EXPECT_EQ(diffuse_reflectance(*m), Rgb(0.8F));
    }
    EXPECT_EQ(diffuse_reflectance(metal(0.49F, 0.8F)), Rgb(0.0F));
    EXPECT_EQ(diffuse_reflectance(metal(0.0F, 0.8F)), Rgb(0.0F));
    EXPECT_EQ(diffuse_reflectance(glass(1.5F)), Rgb(0.0F));
}

} // namespace
} // namespace atrium
