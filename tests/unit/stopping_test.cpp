// Every phase that walks over a mesh asks whether to go on, often enough for a mesh of millions, and ends once told to.
#include "engine/geometry/mesh_topology.h"
#include "engine/geometry/planar_regions.h"
#include "engine/geometry/surface_charts.h"
#include "engine/geometry/welding.h"
#include "engine/layers/caustic_layer.h"
#include "engine/layers/layer_builder.h"
#include "engine/measure/error_audit.h"
#include "engine/measure/light_difference.h"
#include "engine/radiosity/hierarchy.h"
#include "engine/radiosity/mirror_light.h"
#include "engine/raycast/scene_charts.h"
#include "engine/raycast/slabs.h"
#include "engine/reference/reference.h"
#include "tests/support/charted.h"
#include "tests/support/moving_caustics.h"
#include "tests/support/rooms.h"

#include <atomic>
#include <cstdio>
#include <gtest/gtest.h>

namespace atrium::test {
namespace {

constexpr std::uint32_t kSide = 200; // quads along each side of the sheet
constexpr std::size_t kTriangles = 2 * std::size_t(kSide) * kSide;
constexpr std::uint32_t kFewer = 40; // of the one that is solved

/// A sheet of bumps: no two quads are in one plane, so every phase has each triangle to itself.
Mesh bumpy(std::uint32_t side = kSide) {
    auto mesh = std::make_shared<MeshData>();
    for (std::uint32_t j = 0; j <= side; ++j) {
        for (std::uint32_t i = 0; i <= side; ++i) {
            const float x = float(i) / float(side), z = float(j) / float(side);
            mesh->positions.emplace_back(2.0F * x, 0.05F * std::sin(71.0F * x) * std::sin(67.0F * z), 2.0F * z);
        }
    }
    for (std::uint32_t j = 0; j < side; ++j) {
        for (std::uint32_t i = 0; i < side; ++i) {
            const std::uint32_t a = j * (side + 1) + i, b = a + 1, c = a + side + 1, d = c + 1;
            mesh->indices.insert(mesh->indices.end(), {a, c, b, b, c, d});
        }
    }
    mesh->parts = {{0, std::uint32_t(mesh->indices.size())}};
    return {mesh};
}

Scene bumpy_scene(const Material& material, std::uint32_t side = kSide) {
    Scene scene;
    add_room(scene, 4, 2.5F, 4, add_material(scene, 0.5F));
    add_point_light(scene, {2, 2.2, 2}, 1000);
    Node node;
    node.name = "bumps";
    node.shape = scene.shapes.insert(Shape{"bumps", bumpy(side), {}});
    node.materials = {scene.materials.insert(material)};
    node.transform.translation = {1, 0.5, 1};
    scene.roots.push_back(scene.nodes.insert(node));
    return scene;
}

Material matt() {
    Material m;
    m.base_color = Rgb(0.6F);
    m.double_sided = true;
    return m;
}

/// Counts the questions, and says yes to the n-th and all after it.
class Asked {
public:
    explicit Asked(std::uint64_t stop_at = ~0ULL) : watch_([this, stop_at] { return ++questions_ >= stop_at; }) {
        context_.stop.watch(&watch_);
    }
    [[nodiscard]] const RunContext& context() const { return context_; }
    [[nodiscard]] std::uint64_t questions() const { return questions_; }

private:
    std::atomic<std::uint64_t> questions_ = 0;
    std::function<bool()> watch_;
    RunContext context_;
};

/// `phase` asks at least once in 4,096 triangles that it walks over, `walks` times in all, and whenever the answer is yes
/// asks no more than `after` times again: had any loop gone on, it would have asked at its old pace.
void expect_stops(const char* name, double walks, std::uint64_t after, const std::function<void(const RunContext&)>& phase) {
    Asked all;
    phase(all.context());
    const std::uint64_t questions = all.questions();
    EXPECT_GE(double(questions), walks * double(kTriangles) / 4096.0) << name;
    std::uint64_t most = 0;
    for (const double share : {0.0, 0.25, 0.5, 0.75, 0.95}) {
        const auto at = std::uint64_t(1.0 + share * double(questions - 1));
        Asked some(at);
        phase(some.context());
        most = std::max(most, some.questions() - at);
        EXPECT_LE(some.questions(), at + after) << name << " stopped at question " << at << " of " << questions;
    }
    std::printf("%s: %llu questions, at most %llu more after the answer\n", name, static_cast<unsigned long long>(questions),
                static_cast<unsigned long long>(most));
}

TEST(Stopping, GeometryOfAMesh) {
    const Mesh geometry = bumpy();
    const MeshData& mesh = *geometry.data;
    std::vector<uvec3> triangles;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        triangles.emplace_back(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
    }
    expect_stops("is_closed", 1, 0, [&](const RunContext& c) { EXPECT_FALSE(is_closed(mesh, c)); });
    expect_stops("weld", 1, 0, [&](const RunContext& c) { (void)weld(mesh.positions, triangles, 1e-5F, c); });
    const WeldedTriangles welded = weld(mesh.positions, triangles, 1e-5F);
    expect_stops("edge_rings", 2, 2, [&](const RunContext& c) { (void)edge_rings(welded, c); });
    expect_stops("planar_regions", 4, 8, [&](const RunContext& c) {
        const PlanarRegions found = planar_regions(mesh.positions, triangles, {}, c);
        EXPECT_EQ(found.regions.empty(), c.stop.stop_requested());
    });
    ChartSettings settings;
    settings.smallest_extent = 0.0F;
    settings.smallest_width = 0.0F;
    expect_stops("build_charts", 5, 10, [&](const RunContext& c) {
        const SurfaceCharts charts = build_charts(mesh.positions, triangles, {}, settings, c);
        EXPECT_EQ(charts.empty(), c.stop.stop_requested());
    });
}

TEST(Stopping, RaySceneAndWhatIsMadeOfIt) {
    Material glass;
    glass.transmission = 1.0F;
    glass.roughness = 0.0F;
    glass.thickness = 0.1F;
    Material mirror;
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    const Scene scene = bumpy_scene(matt());
    expect_stops("ray scene", 1, 8, [&](const RunContext& c) { const RayScene rays(scene, c); });
    expect_stops("ray scene with glass", 1, 8,
                 [&, in_glass = bumpy_scene(glass)](const RunContext& c) { const RayScene rays(in_glass, c); });
    const RayScene in_mirror(bumpy_scene(mirror));
    expect_stops("flat mirrors", 4, 8 + kTriangles, [&](const RunContext& c) { const MirrorLight light(in_mirror, c); });
    const RayScene rays(scene);
    // Each surface of the room asks once.
    expect_stops("charts of all", 4, 24, [&](const RunContext& c) { (void)chart_surfaces(rays, {}, c); });
    expect_stops("hierarchy", 4, 24, [&](const RunContext& c) {
        const Hierarchy h = build_hierarchy(rays, {}, c);
        EXPECT_EQ(h.empty(), c.stop.stop_requested());
    });
    // Parallel loops ask once for every chunk of vertices that is left, and once for every vertex where they go on.
    expect_stops("layers", 8, kTriangles / 16, [&](const RunContext& c) {
        const LightField field{{},
                               [](const vec3& p, const vec3&) {
                                   return DirectSample{Rgb(1.0F + p.x), 0.01F};
                               },
                               [](const vec3&, const vec3&) { return DirectSample{}; }};
        const LayerSet set = build_layers(
            rays, field, {}, {}, [](std::uint32_t) { return false; }, c, 0.0, 1.0);
        EXPECT_EQ(set.complete, !c.stop.stop_requested());
        EXPECT_EQ(set.surfaces.empty(), c.stop.stop_requested());
    });
}

TEST(Stopping, CausticTextures) {
    const Charted c(rectangle(4, 4));
    const auto landings = spot(c, kTriangles, {1.5F, 2.0F}, 0.8F);
    for (const bool paper : {false, true}) {
        CausticSettings settings;
        settings.paper = paper;
        ASSERT_FALSE(c.build(landings, settings).textures.empty());
        // Landings are looked at again and again, and laid down one by one.
        expect_stops(paper ? "caustics of 2001" : "caustics", 3, 16, [&](const RunContext& context) {
            const CausticSide side = build_caustics(landings, c.charts, c.mesh->positions, c.triangles, settings, context);
            EXPECT_EQ(side.textures.empty(), context.stop.stop_requested());
            EXPECT_EQ(side.records.empty(), context.stop.stop_requested());
        });
    }
    const Staged at(stage().scene);
    ParticleSettings settings;
    settings.particles = kTriangles;
    const ParticleMap map(at.rays, at.targets, at.direct, at.emitters, {}, settings, RunContext{});
    const std::vector<SurfaceCharts> charts = chart_surfaces(at.rays, {});
    expect_stops("caustics of all surfaces", 1, 64, [&](const RunContext& context) {
        const CausticLight light = build_caustic_light(at.rays, charts, map, {}, nullptr, {}, context);
        EXPECT_EQ(light.empty(), context.stop.stop_requested());
    });
}

TEST(Stopping, SolveAndAudit) {
    const Scene scene = bumpy_scene(matt(), kFewer);
    SolveOptions options;
    options.quality = SolverSettings::Quality::Draft;
    options.skip_first_picture = true;
    std::shared_ptr<const Solution> solution;
    {
        GiEngine engine;
        solution = *engine.solve(scene, options, {});
    }
    expect_stops("solve", 8, 4096, [&](const RunContext& c) {
        GiEngine engine;
        const bool solved = engine.solve(scene, options, c).has_value();
        EXPECT_EQ(solved, !c.stop.stop_requested());
    });
    AuditSettings few = audit_settings(SolverSettings::Quality::Draft);
    few.points = 16;
    few.least_paths = few.most_paths = 16;
    expect_stops("audit", 2, 64, [&](const RunContext& c) {
        const bool audited = audit_error(scene, *solution, few, c).has_value();
        EXPECT_EQ(audited, !c.stop.stop_requested());
    });
}

} // namespace
} // namespace atrium::test
