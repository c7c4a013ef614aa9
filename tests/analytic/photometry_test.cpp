// Photometric lamps against closed forms: E = I(direction) cos / d^2 straight and over mirrors, in the engine's direct
// light, its finished layers and the reference; particles against the flux through what they are aimed at.
#include "engine/base/rng.h"
#include "engine/particles/particle_map.h"
#include "engine/radiosity/mirror_light.h"
#include "engine/reference/reference.h"
#include "engine/scene/photometric_web.h"
#include "tests/support/light_cases.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace test;

// Linear in both angles between 0, 90, ... and 360 degrees, and so told exactly by a file with these.
double around(double h) {
    constexpr std::array<double, 5> kAt{1.0, 1.5, 0.7, 0.4, 1.0};
    const auto i = std::min(std::size_t(h / 90.0), std::size_t(3));
    return kAt[i] + (kAt[i + 1] - kAt[i]) * (h / 90.0 - double(i));
}
double intensity(double v, double h) { return v < 90.0 ? 1000.0 * (1.0 - v / 90.0) * around(h) : 0.0; }

/// What it sends towards a direction in its own axes.
double intensity_towards(const dvec3& d) {
    const double h = degrees_from_radians(std::atan2(d.y, d.x));
    return intensity(degrees_from_radians(std::acos(-d.z)), h < 0.0 ? h + 360.0 : h);
}

std::shared_ptr<const PhotometricWeb> lopsided_web(std::vector<float> tilt = {}, std::vector<float> part = {}) {
    PhotometricData data;
    for (int v = 0; v <= 90; v += 15) {
        data.vertical.push_back(float(v));
    }
    for (int h = 0; h <= 360; h += 30) {
        data.horizontal.push_back(float(h));
        for (const float v : data.vertical) {
            data.candela.push_back(float(intensity(double(v), double(h))));
        }
    }
    data.tilt = std::move(tilt);
    data.tilt_part = std::move(part);
    return std::make_shared<const PhotometricWeb>(std::move(data));
}

NodeId add_lamp(Scene& scene, const std::shared_ptr<const PhotometricWeb>& web, const dvec3& at, const dquat& turn) {
    Light light;
    set_photometry(light, web);
    Node node;
    node.name = "lamp";
    node.light = scene.lights.insert(std::move(light));
    node.transform.translation = at;
    node.transform.rotation = turn;
    scene.roots.push_back(scene.nodes.insert(node));
    return scene.roots.back();
}

/// Illuminance at a point, in the open.
double expected(const dvec3& lamp, const dquat& turn, const dvec3& p, const dvec3& n) {
    const dvec3 d = p - lamp;
    const double distance = glm::length(d);
    const double cosine = -glm::dot(n, d) / distance;
    return cosine > 0.0 ? intensity_towards(glm::conjugate(turn) * (d / distance)) * cosine / (distance * distance) : 0.0;
}

const dquat kDown = glm::angleAxis(-kPiD / 2, dvec3(1, 0, 0)); // -z to -y
const dquat kAskew =
    glm::normalize(glm::angleAxis(-1.1, glm::normalize(dvec3(1.0, 0.3, -0.2))) * glm::angleAxis(0.7, dvec3(0, 0, 1)));

struct Place {
    dvec3 p, n;
};
/// On a floor below and on two walls beside a lamp at (0, 2.5, 0).
std::vector<Place> places() {
    std::vector<Place> out;
    for (std::uint32_t k = 0; k < 60; ++k) {
        const vec2 u = sobol_owen2(k, 0, 3U);
        const double a = 4.0 * u.x - 2.0, b = 4.0 * u.y - 2.0;
        out.push_back({{a, 0.0, b}, {0, 1, 0}});
        out.push_back({{2.0, 1.25 + 0.6 * a, b}, {-1, 0, 0}});
        out.push_back({{a, 1.25 + 0.6 * b, -2.0}, {0, 0, 1}});
    }
    return out;
}

TEST(Photometry, EngineAndReferenceInTheOpen) {
    const dvec3 at(0, 2.5, 0);
    for (const dquat& turn : {kDown, kAskew, dquat(1, 0, 0, 0)}) {
        Scene scene;
        const NodeId id = add_lamp(scene, lopsided_web(), at, turn);
        scene.nodes.find(id)->transform.scale = {3.0, 0.5, 2.0}; // has no part in it
        scene.lights.find(scene.nodes.find(id)->light)->color = {1.0F, 0.5F, 0.25F};
        const RayScene rays(scene);
        const DirectLight direct(scene, rays);
        std::vector<ReferencePoint> points;
        for (const Place& q : places()) {
            points.push_back({q.p, q.n});
        }
        ReferenceSettings settings;
        settings.paths = 16;
        const auto reference = reference_irradiance(scene, points, settings, RunContext{});
        ASSERT_TRUE(reference);
        int lit = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double e = expected(at, turn, points[i].position, points[i].normal);
            const Rgb ours =
                direct.irradiance(vec3(points[i].position - rays.origin()), vec3(points[i].normal), 1, 0).irradiance;
            const Rgb theirs = reference->points[i].irradiance;
            lit += e > 0.1 ? 1 : 0;
            // Single precision of angles: a millionth of the brightest.
            EXPECT_NEAR(double(ours.r), e, 1e-4 * e + 1e-3) << i;
            EXPECT_NEAR(double(theirs.r), e, 1e-4 * e + 1e-3) << i;
            EXPECT_NEAR(double(ours.g), 0.5 * double(ours.r), 1e-5 * e);
            EXPECT_NEAR(double(ours.b), 0.25 * double(ours.r), 1e-5 * e);
        }
        EXPECT_GT(lit, 60);
        EXPECT_NEAR(direct.emitted_flux(), double(luminance(Rgb(1.0F, 0.5F, 0.25F))) * lopsided_web()->flux(), 0.01);
    }
}

TEST(Photometry, TiltCountsAwayFromStraightDown) {
    // Half the light at 60 degrees; turned about its own axis it hangs as before.
    const auto web = lopsided_web({0, 60, 90}, {1.0F, 0.5F, 0.2F});
    const dvec3 at(0, 2.5, 0);
    const auto tilted = [&](double degrees) {
        return kDown * glm::angleAxis(radians_from_degrees(degrees), dvec3(0, 1, 0));
    };
    for (const auto& [turn, part] : {std::pair(kDown, 1.0),
                                     {tilted(60), 0.5},
                                     {tilted(-30), 0.75},
                                     {tilted(90), 0.2},
                                     {kDown * glm::angleAxis(1.0, dvec3(0, 0, 1)), 1.0}}) {
        Scene scene;
        add_lamp(scene, web, at, turn);
        const RayScene rays(scene);
        const DirectLight direct(scene, rays);
        const ReferencePoint point{{0.3, 0, 0.4}, {0, 1, 0}};
        const double e = part * expected(at, turn, point.position, point.normal);
        ReferenceSettings settings;
        settings.paths = 16;
        EXPECT_NEAR(luminance(direct.irradiance(vec3(point.position), vec3(point.normal), 1, 0).irradiance), e,
                    1e-4 * e + 1e-3);
        EXPECT_NEAR(luminance(reference_irradiance(scene, {point}, settings, RunContext{})->points[0].irradiance), e,
                    1e-4 * e + 1e-3);
        EXPECT_NEAR(direct.emitted_flux() / web->flux(), part, 1e-5);
    }
}

// A black room: what the finished layers show is the lamp's light alone.
TEST(Photometry, FinishedLayers) {
    Scene scene;
    add_room(scene, 4.0F, 3.0F, 4.0F, add_material(scene, 0.0F));
    const dvec3 at(1.7, 2.5, 1.6);
    add_lamp(scene, lopsided_web(), at, kAskew);
    GiEngine engine;
    SolveOptions options;
    options.quality = SolverSettings::Quality::Normal;
    const auto solution = engine.solve(scene, options, {});
    ASSERT_TRUE(solution);
    std::vector<SensorPlace> sensors;
    for (const Place& q : places()) {
        sensors.push_back({q.n.y > 0.0   ? dvec3(2.0 + 0.9 * q.p.x, 0, 2.0 + 0.9 * q.p.z)
                           : q.n.x < 0.0 ? dvec3(4.0, q.p.y + 0.2, 2.0 + 0.9 * q.p.z)
                                         : dvec3(2.0 + 0.9 * q.p.x, q.p.y + 0.2, 0.0),
                           q.n});
    }
    const auto readings = read_surfaces(scene, **solution, sensors);
    double worst = 0.0, sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const double e = expected(at, kAskew, sensors[i].point, sensors[i].normal);
        if (e > 5.0) {
            const double error = luminance(readings[i].irradiance) / e - 1.0;
            worst = std::max(worst, std::abs(error));
            sum += error;
            ++count;
        }
    }
    std::printf("finished layers: mean %.3f %%, worst %.2f %% of %d\n", 100.0 * sum / count, 100.0 * worst, count);
    EXPECT_GT(count, 60);
    EXPECT_LT(std::abs(sum / count), 0.001);
    EXPECT_LT(worst, 0.01); // between texels it is interpolated
    EXPECT_NEAR((*solution)->statistics.energy.emitted / lopsided_web()->flux(), 1.0, 1e-5);
}

MaterialId add_mirror(Scene& scene, float rho) {
    Material m;
    m.base_color = Rgb(rho);
    m.metallic = 1.0F;
    m.roughness = 0.0F;
    return scene.materials.insert(m);
}

TEST(Photometry, MirrorImages) {
    // A mirror at x = 0 and a wall at x = 4 that looks at it; the lamp shines askew towards the mirror.
    Scene scene;
    add_rectangle(scene, "mirror", {0, 1.5, 2}, {1, 0, 0}, {0, 0, -1}, 4, 4, add_mirror(scene, 0.9F));
    const dvec3 at(1, 1.5, 2);
    const dquat turn =
        glm::normalize(glm::angleAxis(kPiD / 2, dvec3(0, 1, 0)) * glm::angleAxis(0.3, dvec3(1, 2, 0.5) / std::sqrt(5.25)));
    add_lamp(scene, lopsided_web(), at, turn);
    const RayScene rays(scene);
    const DirectLight direct(scene, rays);
    const MirrorLight mirrors(rays);
    const Hierarchy none;
    const PointGather gather(none, rays);
    int lit = 0;
    for (std::uint32_t k = 0; k < 100; ++k) {
        const vec2 u = sobol_owen2(k, 0, 5U);
        const dvec3 p(4.0, 4.0 * u.x - 0.5, 4.0 * u.y);
        const dvec3 image(-p.x, p.y, p.z); // light goes to it, through the mirror
        const dvec3 d = image - at;
        const double distance = glm::length(d);
        const double cosine = -d.x / distance; // at the wall and at the mirror alike
        const double rho = 0.9 + 0.1 * std::pow(1.0 - cosine, 5.0);
        const double e = rho * intensity_towards(glm::conjugate(turn) * (d / distance)) * cosine / (distance * distance);
        const Rgb ours =
            mirrors.irradiance(vec3(p - rays.origin()), {-1, 0, 0}, GatherSettings{}, &direct, &gather).irradiance;
        EXPECT_NEAR(luminance(ours), e, 1e-4 * e + 1e-4);
        lit += e > 1.0 ? 1 : 0;
    }
    EXPECT_GT(lit, 50);
    // The reference's particles find the same by chance: means over texels of the wall.
    const dvec3 corner(4.0, 0.0, 0.0), u(0, 3, 0), v(0, 0, 4);
    constexpr std::size_t kTexels = 4;
    CausticReferenceSettings settings;
    settings.particles = 4'000'000;
    const auto caustics = reference_caustics(scene, {corner, u, v, {-1, 0, 0}}, kTexels, kTexels, settings, RunContext{});
    ASSERT_TRUE(caustics);
    for (std::size_t t = 0; t < kTexels * kTexels; ++t) {
        constexpr int kSide = 50;
        double mean = 0.0;
        for (int i = 0; i < kSide * kSide; ++i) {
            const double a = (double(t % kTexels) + (i % kSide + 0.5) / kSide) / kTexels;
            const double b = (double(t / kTexels) + (i / kSide + 0.5) / kSide) / kTexels;
            const dvec3 p = corner + a * u + b * v;
            const dvec3 d = dvec3(-p.x, p.y, p.z) - at;
            const double distance = glm::length(d), cosine = -d.x / distance;
            mean += (0.9 + 0.1 * std::pow(1.0 - cosine, 5.0)) * intensity_towards(glm::conjugate(turn) * (d / distance)) *
                    cosine / (distance * distance) / (kSide * kSide);
        }
        const double error = caustics->standard_error[t];
        EXPECT_LT(error, 0.02 * mean + 0.1) << t;
        EXPECT_NEAR(luminance(caustics->irradiance[t]), mean, 4.0 * error + 1e-3 * mean) << t;
    }
}

/// Flux through a rectangle in front of the lamp, by midpoints.
double flux_through(const dvec3& lamp, const dquat& turn, const dvec3& corner, const dvec3& u, const dvec3& v,
                    const std::function<double(double cosine)>& weight) {
    constexpr int kSide = 400;
    const dvec3 n = glm::normalize(glm::cross(u, v));
    double sum = 0.0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const dvec3 p = corner + u * ((i % kSide + 0.5) / kSide) + v * ((i / kSide + 0.5) / kSide);
        const double cosine = std::abs(glm::dot(n, glm::normalize(p - lamp)));
        sum += weight(cosine) * expected(lamp, turn, p, glm::dot(n, p - lamp) > 0.0 ? -n : n);
    }
    return sum * glm::length(glm::cross(u, v)) / (kSide * kSide);
}

ParticleMap traced(const Scene& scene, const RayScene& rays, const SpecularTargets& targets, const DirectLight& direct) {
    (void)scene;
    return {rays, targets, direct, {}, {}, ParticleSettings{200'000, 256, 1}, RunContext{}};
}

TEST(Photometry, ParticlesCarryTheFluxTowardsAMirror) {
    Scene scene;
    add_rectangle(scene, "mirror", {0, 1.5, 2}, {1, 0, 0}, {0, 0, 1}, 2.0F, 1.0F, add_mirror(scene, 0.9F));
    add_rectangle(scene, "wall", {4, 1.5, 2}, {-1, 0, 0}, {0, 0, 1}, 60.0F, 60.0F, add_material(scene, 0.0F));
    const dvec3 at(0.8, 1.7, 1.6);
    const dquat turn = glm::normalize(glm::angleAxis(kPiD / 2, dvec3(0, 1, 0)) * glm::angleAxis(0.6, dvec3(0, 1, 0)));
    add_lamp(scene, lopsided_web(), at, turn);
    const RayScene rays(scene);
    const SpecularTargets targets(rays);
    const DirectLight direct(scene, rays);
    const ParticleMap map = traced(scene, rays, targets, direct);
    ASSERT_TRUE(map.complete());
    const auto through = [&](const std::function<double(double)>& weight) {
        return flux_through(at, turn, {0, 1.0, 1.0}, {0, 1, 0}, {0, 0, 2}, weight);
    };
    const double sent = through([](double) { return 1.0; });
    const double mirrored = through([](double c) { return 0.9 + 0.1 * std::pow(1.0 - c, 5.0); });
    const ParticleEnergy& e = map.energy();
    EXPECT_GT(sent, 50.0);
    EXPECT_NEAR(e.emitted / sent, 1.0, 0.002);
    EXPECT_NEAR(e.stored / mirrored, 1.0, 0.002);
    EXPECT_NEAR(e.emitted, e.absorbed + e.escaped + e.stored + e.imaged + e.cut, 1e-6 * e.emitted);
}

// A furnace: all that the lamp sends meets mirrors, which lose nothing, and ends on a black ceiling.
TEST(Photometry, ParticlesEmitTheWholeFlux) {
    Scene scene;
    const MaterialId mirror = add_mirror(scene, 1.0F);
    add_room(scene, 3.0F, 2.0F, 4.0F, {mirror, add_material(scene, 0.0F), mirror, mirror, mirror, mirror});
    const auto web = lopsided_web(); // nothing above 90 degrees
    add_lamp(scene, web, {1.2, 1.9, 1.5}, kDown);
    const RayScene rays(scene);
    const SpecularTargets targets(rays);
    const DirectLight direct(scene, rays);
    const ParticleMap map = traced(scene, rays, targets, direct);
    ASSERT_TRUE(map.complete());
    const ParticleEnergy& e = map.energy();
    std::printf("furnace: file %.3f lm, emitted %.3f, stored %.3f, cut %.4f\n", web->flux(), e.emitted, e.stored, e.cut);
    EXPECT_NEAR(e.emitted / web->flux(), 1.0, 0.002);
    EXPECT_NEAR(e.stored / web->flux(), 1.0, 0.003);
    EXPECT_NEAR(e.emitted, e.absorbed + e.escaped + e.stored + e.imaged + e.cut, 1e-6 * e.emitted);
}

} // namespace
} // namespace atrium
