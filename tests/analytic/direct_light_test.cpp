// Light that comes straight from lamps, sun and sky, and the dark where none may come: closed forms (cases named as in
// shared/validation).
#include "engine/base/float_traps.h"
#include "engine/radiosity/direct_light.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace test;
using Quality = SolverSettings::Quality;

NodeId add_light(Scene& scene, const Light& light, const dvec3& at, const dquat& turn = dquat(1, 0, 0, 0)) {
    Node node;
    node.light = scene.lights.insert(light);
    node.transform.translation = at;
    node.transform.rotation = turn;
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

// Turns a light's -z downwards.
const dquat kDown = glm::angleAxis(-kPiD / 2, dvec3(1, 0, 0));

double e_at(const Scene& scene, const vec3& point, const vec3& normal, unsigned sun = 1, unsigned sky = 0) {
    const RayScene rays(scene);
    const DirectLight direct(scene, rays);
    return luminance(direct.irradiance(point - vec3(rays.origin()), normal, sun, sky).irradiance);
}

// LIGHT-KHR-SPOT: 500 cd, cones of 0.2 and 0.5 rad.
TEST(DirectLight, SpotFalloffAndFluxOfKhrLightsPunctual) {
    Scene scene;
    Light spot;
    spot.kind = Light::Kind::Spot;
    spot.intensity = 500;
    spot.inner_cone = 0.2F;
    spot.outer_cone = 0.5F;
    add_light(scene, spot, {0, 0, 0});
    const double expected[][2] = {{0, 1},   {0.1, 1}, {0.2, 1}, {0.3, 0.5756153899}, {0.4, 0.1799846543}, {0.5, 0},
                                  {0.6, 0}, {1.6, 0}, {3.14, 0}};
    for (const auto& [angle, relative] : expected) {
        const vec3 d(float(std::sin(angle)), 0, float(-std::cos(angle)));
        EXPECT_NEAR(e_at(scene, 2.0F * d, -d), 500.0 * relative / 4.0, 1e-3) << angle;
    }
    const RayScene rays(scene);
    EXPECT_NEAR(DirectLight(scene, rays).emitted_flux() / 169.9437032, 1.0, 1e-5);
}

TEST(DirectLight, SpotShinesAlongItsNodeWhateverTheNodesScale) {
    Scene scene;
    Light spot;
    spot.kind = Light::Kind::Spot;
    spot.intensity = 90;
    const NodeId id = add_light(scene, spot, {1, 3, 1}, kDown);
    scene.nodes.find(id)->transform.scale = {5, 0.1, 3};
    EXPECT_NEAR(e_at(scene, {1, 0, 1}, {0, 1, 0}), 10.0, 1e-4);
    EXPECT_EQ(e_at(scene, {1, 4, 1}, {0, -1, 0}), 0.0);
}

// LIGHT-ISO: 1000 lm, receiver plane below.
TEST(DirectLight, IsotropicPointSource) {
    const struct {
        double h, x, e;
    } cases[] = {{3, 0, 8.841941283},    {3, 2, 5.093266048},     {1, 0.001, 79.57735218},
                 {0.01, 0, 795774.7155}, {1e-4, 0, 7957747155.0}, {100, 0, 0.007957747155}};
    for (const auto& c : cases) {
        Scene scene;
        add_point_light(scene, {0, c.h, 0}, 1000);
        EXPECT_NEAR(e_at(scene, {float(c.x), 0, 0}, {0, 1, 0}) / c.e, 1.0, 1e-5) << c.h;
        EXPECT_EQ(e_at(scene, {float(c.x), 0, 0}, {0, -1, 0}), 0.0) << "from behind";
    }
    Scene scene;
    add_point_light(scene, {0, 0, 0}, 1000);
    EXPECT_EQ(e_at(scene, {0, 0, 0}, {0, 1, 0}), 0.0) << "at the light itself: defined, not infinite";
}

TEST(DirectLight, LampsThatAreOffHiddenOrBlackDoNotShine) {
    const FloatTrapsOff no_number_on_purpose;
    for (int way = 0; way < 5; ++way) {
        Scene scene;
        const NodeId id = add_point_light(scene, {0, 2, 0}, 1000);
        Light& light = *scene.lights.find(scene.nodes.find(id)->light);
        light.enabled = way != 0;
        scene.nodes.find(id)->visible = way != 1;
        light.intensity = way == 2 ? 0.0F : (way == 3 ? std::numeric_limits<float>::quiet_NaN() : light.intensity);
        light.color = way == 4 ? Rgb(0.0F) : light.color;
        EXPECT_EQ(e_at(scene, {0, 0, 0}, {0, 1, 0}), 0.0) << way;
    }
}

// CIE171-5.2: a Lambertian point source of I0 = 1000 cd, 3 m above the receiver: here a 1 cm square of the same intensity.
TEST(DirectLight, LambertianPointSourceOfCie52) {
    Scene scene;
    add_rectangle(scene, "source", {0, 3, 0}, {0, -1, 0}, {1, 0, 0}, 0.01F, 0.01F,
                  add_material(scene, 0, 1000.0F / 1e-4F * kPi));
    add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, add_material(scene, 0));
    const struct {
        double x, z, e;
    } points[] = {{0, 0, 111.1111111},   {0.5, 0, 105.1862673},  {1, 0, 90.0},       {1.5, 0, 71.11111111},
                  {0.5, 0.5, 99.722992}, {1, 0.5, 85.66329566},  {1.5, 0.5, 68.053}, {1, 1, 74.38016529},
                  {1.5, 1, 59.97501041}, {1.5, 1.5, 49.38271605}};
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    for (const auto& p : points) {
        const dvec3 at(p.x, 0, p.z);
        EXPECT_NEAR(luminance(s.engine.gather_free(at, {0, 1, 0}).irradiance) / p.e, 1.0, 1e-3) << p.x << ", " << p.z;
        EXPECT_NEAR(luminance(read_surface(scene, *s.solution, at, {0, 1, 0}).irradiance) / p.e, 1.0, 0.05);
    }
}

// LIGHT-SHAPES: 1000 lm from a Lambertian square of 1 m facing the receiver; X-TINY-LIGHT: from one of 0.1 mm.
TEST(DirectLight, SquareEmittersNearFarAndTiny) {
    const struct {
        double edge, h, e;
    } cases[] = {{1, 0.1, 968.339557}, {1, 1, 239.4564705}, {1, 3, 34.1067949}, {1e-4, 3, 35.367765}};
    for (const auto& c : cases) {
        Scene scene;
        const auto edge = float(c.edge);
        add_rectangle(scene, "source", {0, c.h, 0}, {0, -1, 0}, {1, 0, 0}, edge, edge,
                      add_material(scene, 0, 1000.0F / (edge * edge)));
        add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, add_material(scene, 0));
        const Solved s = solve(scene, Quality::Draft);
        ASSERT_TRUE(s.solution);
        EXPECT_NEAR(luminance(s.engine.gather_free({0, 0, 0}, {0, 1, 0}).irradiance) / c.e, 1.0, 2e-3)
            << c.edge << " at " << c.h;
        EXPECT_TRUE(std::isfinite(s.solution->mean_radiance));
    }
}

// LIGHT-SHAPES: a sphere's illuminance falls with the square of the distance from its centre, at any radius.
TEST(DirectLight, GlowingSphere) {
    for (const float r : {0.05F, 0.5F, 1.5F}) {
        Scene scene;
        Shape shape;
        shape.geometry = Sphere{r};
        Node node;
        node.shape = scene.shapes.insert(shape);
        node.materials = {add_material(scene, 0, 1000.0F / (4 * kPi * r * r))};
        node.transform.translation = {0, 2, 0};
        scene.roots.push_back(scene.nodes.insert(node));
        add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, add_material(scene, 0));
        const Solved s = solve(scene, Quality::Draft);
        ASSERT_TRUE(s.solution);
        // The polyhedron of 32 segments shows 0.6 % less than the sphere; the rest is the harmonics of its face groups.
        EXPECT_NEAR(luminance(s.engine.gather_free({0, 0, 0}, {0, 1, 0}).irradiance) / 19.89436789, 1.0, 0.04) << r;
    }
}

Scene sun_scene(double edge_height) {
    Scene scene;
    Light sun;
    sun.kind = Light::Kind::Directional;
    sun.intensity = 1000;
    sun.angular_diameter_degrees = 2.0F * 0.2666F;
    add_light(scene, sun, {0, 0, 0}, kDown);
    // Half plane x < 0 at the edge's height.
    add_rectangle(scene, "roof", {-5, edge_height, 0}, {0, -1, 0}, {1, 0, 0}, 10, 10, add_material(scene, 0));
    return scene;
}

// SHADOW-SUN: the visible part of the sun's disc behind a straight edge.
TEST(DirectLight, PenumbraOfAHalfPlaneInTheSun) {
    constexpr double kHalfWidth = 3.0 * 0.0046530814;
    const double expected[][2] = {{-1.2, 0},
                                  {-1, 0},
                                  {-0.75, 0.07214680641},
                                  {-0.5, 0.1955011095},
                                  {-0.25, 0.3425188212},
                                  {0, 0.5},
                                  {0.25, 0.6574811788},
                                  {0.5, 0.8044988905},
                                  {0.75, 0.9278531936},
                                  {1, 1},
                                  {1.2, 1}};
    const Scene scene = sun_scene(3);
    for (const auto& [x, visible] : expected) {
        const vec3 point(float(x * kHalfWidth), 0, 0.1F);
        EXPECT_NEAR(e_at(scene, point, {0, 1, 0}, 4096) / 1000.0, visible, 0.004) << x;
        EXPECT_NEAR(e_at(scene, point, {0, 1, 0}, 64) / 1000.0, visible, 0.05) << x;
    }
    // A parallel beam has no penumbra.
    Scene parallel = scene;
    parallel.lights.find(parallel.nodes.find(parallel.roots[0])->light)->angular_diameter_degrees = 0.0F;
    EXPECT_EQ(e_at(parallel, {-1e-3F, 0, 0.1F}, {0, 1, 0}, 64), 0.0);
    EXPECT_NEAR(e_at(parallel, {1e-3F, 0, 0.1F}, {0, 1, 0}, 64), 1000.0, 1e-3);
}

TEST(DirectLight, SunsOwnVarianceCoversTheErrorOfFewRays) {
    const Scene scene = sun_scene(3);
    const RayScene rays(scene);
    const DirectLight direct(scene, rays);
    const vec3 o(rays.origin());
    const DirectSample half = direct.irradiance(vec3(0, 0, 0.1F) - o, {0, 1, 0}, 16, 0);
    EXPECT_GT(half.variance, 0.0F);
    EXPECT_LT(std::abs(luminance(half.irradiance) - 500.0F), 3.0F * std::sqrt(half.variance));
    EXPECT_EQ(direct.irradiance(vec3(2, 0, 0.1F) - o, {0, 1, 0}, 16, 0).variance, 0.0F);
}

// X-GRAZING: the sun at an elevation of 0.1 degrees on a table of 10 m.
TEST(DirectLight, GrazingSun) {
    Scene scene;
    Light sun;
    sun.kind = Light::Kind::Directional;
    sun.intensity = 100000;
    sun.angular_diameter_degrees = 0.0F;
    add_light(scene, sun, {0, 0, 0}, glm::angleAxis(-0.1 * kPiD / 180, dvec3(1, 0, 0)));
    add_rectangle(scene, "table", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 10, 10, add_material(scene, 0.5F));
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    EXPECT_NEAR(mean_irradiance(scene, *s.solution) / 174.53284, 1.0, 0.01);
}

// Uniform sky of radiance L: pi L on an open plane, half of it on a wall that stands on wide black ground.
// Of the sun's disc the part above the horizon shines: 100,000 lx times the mean of max(0, sin) over it, here by a sum over
// a fine grid. Whatever the number of rays, also where all of their points lie below.
TEST(DirectLight, SunHalfBelowTheHorizon) {
    constexpr double kRadius = 0.265; // degrees
    for (const double elevation : {0.5, 0.3, 0.2, 0.1, 0.0, -0.1, -0.2, -0.26, -0.3}) {
        double sum = 0.0, count = 0.0;
        constexpr int kGrid = 400;
        for (int i = 0; i < kGrid; ++i) {
            for (int j = 0; j < kGrid; ++j) {
                const double x = 2.0 * (i + 0.5) / kGrid - 1.0, y = 2.0 * (j + 0.5) / kGrid - 1.0;
                if (x * x + y * y < 1.0) {
                    sum += std::max(std::sin(radians_from_degrees(elevation + kRadius * y)), 0.0);
                    count += 1.0;
                }
            }
        }
        const double expected = 1e5 * sum / count;
        Scene scene;
        Light sun;
        sun.kind = Light::Kind::Directional;
        sun.intensity = 1e5F;
        sun.angular_diameter_degrees = float(2.0 * kRadius);
        add_light(scene, sun, {0, 0, 0}, glm::angleAxis(-radians_from_degrees(elevation), dvec3(1, 0, 0)));
        for (const unsigned rays : {1U, 8U, 32U, 128U}) {
            EXPECT_NEAR(e_at(scene, {0, 0, 0}, {0, 1, 0}, rays), expected, 0.002 * expected + 1e-3)
                << elevation << " degrees, " << rays << " rays";
        }
    }
}

TEST(DirectLight, UniformSkyOnPlaneAndWall) {
    Scene scene;
    scene.environment.sky_radiance = Rgb(1000.0F, 2000.0F, 3000.0F);
    const MaterialId black = add_material(scene, 0);
    add_rectangle(scene, "ground", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 2000, 2000, black);
    const NodeId wall = add_rectangle(scene, "wall", {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, 2, 2, black);
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    const Rgb open = s.engine.gather_free({300, 0, 300}, {0, 1, 0}).irradiance;
    const Rgb upright = s.engine.gather_free({0.1, 1.2, 0}, {0, 0, 1}).irradiance;
    for (int c = 0; c < 3; ++c) {
        const float l = scene.environment.sky_radiance[c];
        EXPECT_NEAR(open[c] / (kPi * l), 1.0F, 1e-3F);
        EXPECT_NEAR(upright[c] / (kPi * l), 0.5F, 0.01F);
    }
    EXPECT_NEAR(mean_irradiance(scene, *s.solution, wall) / luminance(scene.environment.sky_radiance * kPi), 0.5, 0.02);
}

// X-DYNAMIC: a sun patch of 1e5 lx and a night light's hundredth of a lux in one scene, in two rooms.
TEST(DirectLight, SunAndNightLightInOneSolution) {
    Scene scene;
    const MaterialId black = add_material(scene, 0);
    const NodeId outside = add_rectangle(scene, "terrace", {-10, 0, 2}, {0, 1, 0}, {1, 0, 0}, 4, 4, black);
    add_room(scene, 4, 3, 4, black);
    // The sun passes outward-culled walls' backs as it passes anything: they stop it.
    Light sun;
    sun.kind = Light::Kind::Directional;
    sun.intensity = 100000;
    add_light(scene, sun, {0, 0, 0}, kDown);
    const double cd = 0.01 * 4.0;
    add_point_light(scene, {2, 2, 2}, cd * 4 * kPiD);
    const Solved s = solve(scene, Quality::Normal);
    ASSERT_TRUE(s.solution);
    EXPECT_NEAR(mean_irradiance(scene, *s.solution, outside) / 1e5, 1.0, 0.01);
    EXPECT_NEAR(luminance(read_surface(scene, *s.solution, {2, 0, 2}, {0, 1, 0}).irradiance) / 0.01, 1.0, 0.01);
}

// X-SLIVER: the floor of CIE171-5.3 cut into 1000 strips of 4 m by 4 mm.
TEST(DirectLight, SliversOnTheFloorChangeNothing) {
    Scene scene;
    const MaterialId black = add_material(scene, 0);
    add_room(scene, 4, 3, 4, black);
    add_rectangle(scene, "source", {2, 3, 2}, {0, -1, 0}, {1, 0, 0}, 1, 1, add_material(scene, 0, 1000.0F * kPi));
    auto data = std::make_shared<MeshData>();
    constexpr int kStrips = 1000;
    for (int i = 0; i <= kStrips; ++i) {
        const float x = 4.0F * float(i) / kStrips;
        data->positions.insert(data->positions.end(), {{x, 0, 0}, {x, 0, 4}});
    }
    for (std::uint32_t i = 0; i < kStrips; ++i) {
        const std::uint32_t a = 2 * i;
        data->indices.insert(data->indices.end(), {a, a + 1, a + 2, a + 2, a + 1, a + 3});
    }
    data->parts = {{0, std::uint32_t(data->indices.size())}};
    Shape shape;
    shape.geometry = Mesh{data};
    Node& floor = *scene.nodes.find(scene.roots[0]);
    floor.shape = scene.shapes.insert(shape);
    floor.transform = {};
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    const double floor53[][2] = {{0.25, 61.42409854}, {0.75, 79.25515732}, {1.25, 95.66727633}, {1.75, 105.7782422}};
    for (const auto& [z, e] : floor53) {
        EXPECT_NEAR(luminance(s.engine.gather_free({2, 0, z}, {0, 1, 0}).irradiance) / e, 1.0, 0.005) << z;
        EXPECT_NEAR(luminance(read_surface(scene, *s.solution, {2, 0, z}, {0, 1, 0}).irradiance) / e, 1.0, 0.05) << z;
    }
}

// X-COPLANAR: a carpet a micrometre above the floor and one exactly on it get the whole light and pass none on downwards.
TEST(DirectLight, CarpetsOnTheFloor) {
    for (const double height : {0.0, 1e-6, 1e-3}) {
        Scene scene;
        add_room(scene, 4, 3, 4, add_material(scene, 0));
        const NodeId carpet =
            add_rectangle(scene, "carpet", {2, height, 2}, {0, 1, 0}, {1, 0, 0}, 2, 2, add_material(scene, 0));
        add_point_light(scene, {2, 2, 2}, 1000);
        const Solved s = solve(scene, Quality::Normal);
        ASSERT_TRUE(s.solution);
        for (const auto& layer : s.solution->surfaces) {
            if (layer->node != carpet) {
                continue;
            }
            for (std::size_t i = 0; i < layer->mesh->positions.size(); ++i) {
                const vec3 p = layer->mesh->positions[i];
                const double d2 = p.x * p.x + p.y * p.y + (2 - height) * (2 - height);
                const double e = 1000 / (4 * kPiD) * (2 - height) / (d2 * std::sqrt(d2));
                EXPECT_NEAR(luminance(light_on(*layer, i)) / e, 1.0, 0.02) << height;
            }
        }
    }
}

// X-LEAK: two rooms of 4 x 3 x 4 m share a wall; light in one only.
struct LeakCase {
    const char* name;
    double thickness;
    bool one_wall;   ///< a single rectangle as the shared wall, else one per room
    bool area_light; ///< a glowing panel, else a bare point light
};
void PrintTo(const LeakCase& c, std::ostream* out) { *out << c.name; }

class Leak : public testing::TestWithParam<LeakCase> {};

TEST_P(Leak, TheDarkRoomStaysDark) {
    const LeakCase& c = GetParam();
    Scene scene;
    const MaterialId m = add_material(scene, 0.7F);
    add_room(scene, 4, 3, 4, m);
    const std::size_t first = scene.roots.size();
    add_room(scene, 4, 3, 4, m);
    for (std::size_t i = first; i < scene.roots.size(); ++i) {
        scene.nodes.find(scene.roots[i])->transform.translation.x += 4 + c.thickness;
    }
    if (c.one_wall) { // it is two-sided then, or the second room would have no wall
        Material both = *scene.materials.find(m);
        both.double_sided = true;
        scene.nodes.find(scene.roots[3])->materials = {scene.materials.insert(both)};
        scene.nodes.erase(scene.roots[first + 2]);
        scene.roots.erase(scene.roots.begin() + std::ptrdiff_t(first + 2));
    }
    if (c.area_light) {
        add_rectangle(scene, "panel", {2, 2.999, 2}, {0, -1, 0}, {1, 0, 0}, 1, 1, add_material(scene, 0, 2000.0F));
    } else {
        add_point_light(scene, {3.5, 2, 2}, 2000);
    }
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    double lit = 0.0, dark = 0.0;
    std::size_t dark_vertices = 0;
    for (const auto& layer : s.solution->surfaces) {
        const dmat4 world = scene.world_matrix(layer->node);
        const bool second =
            dvec3(world[3]).x > 4.0 + c.thickness + 1e-6 || (!c.one_wall && layer->node == scene.roots[first + 2]);
        const bool shared = dvec3(world[3]).x == 4.0 && !second;
        for (std::size_t i = 0; i < layer->irradiance_front.size(); ++i) {
            if (second) {
                dark = std::max(dark, double(luminance(light_on(*layer, i))));
                ++dark_vertices;
            } else {
                lit = std::max(lit, double(luminance(light_on(*layer, i))));
            }
        }
        if (shared && c.one_wall) {
            for (std::size_t i = 0; i < layer->irradiance_back.size(); ++i) {
                dark = std::max(dark, double(luminance(light_on(*layer, i, true))));
            }
        }
    }
    EXPECT_GT(dark_vertices, 50U);
    EXPECT_GT(lit, 10.0);
    EXPECT_LT(dark, 1e-6 * lit);
    for (const dvec3& p : {dvec3(4.01, 1.5, 2), dvec3(4.5, 0.01, 0.01), dvec3(7.9, 2.9, 3.9)}) {
        EXPECT_LT(luminance(s.engine.gather_free(p, glm::normalize(dvec3(-1, 0.3, 0.2))).irradiance), 1e-6 * lit);
    }
}
INSTANTIATE_TEST_SUITE_P(
    SharedWall, Leak,
    testing::Values(LeakCase{"one_wall_panel", 0.0, true, true}, LeakCase{"one_wall_lamp", 0.0, true, false},
                    LeakCase{"two_walls_panel", 0.0, false, true}, LeakCase{"two_walls_lamp", 0.0, false, false},
                    LeakCase{"millimetre_panel", 1e-3, false, true}, LeakCase{"millimetre_lamp", 1e-3, false, false}),
    [](const auto& tested) { return std::string(tested.param.name); });

} // namespace
} // namespace atrium
