// The meshes that are shown: conforming, valid, lit where light is, whole where something rests on them.
#include "engine/base/parallel.h"
#include "engine/layers/layer_builder.h"
#include "engine/radiosity/point_gather.h"
#include "engine/raycast/ray_scene.h"
#include "engine/reference/reference.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace atrium {
namespace {

using namespace test;
using Quality = SolverSettings::Quality;

NodeId add_node(Scene& scene, const std::string& name, const Geometry& geometry, const dvec3& at, MaterialId material,
                const dvec3& scale = dvec3(1.0)) {
    Shape shape;
    shape.geometry = geometry;
    Node node;
    node.name = name;
    node.shape = scene.shapes.insert(shape);
    node.materials = {material};
    node.transform.translation = at;
    node.transform.scale = scale;
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

/// A mesh of two parts that share an edge, flat shaded: the split of one must not tear the other.
Geometry folded_mesh() {
    auto data = std::make_shared<MeshData>();
    data->positions = {{-0.5F, 0, 0}, {0.5F, 0, 0}, {0.5F, 0, 0.8F}, {-0.5F, 0, 0.8F}, {0.5F, 0.6F, 0}, {-0.5F, 0.6F, 0}};
    data->indices = {0, 3, 2, 0, 2, 1, 0, 1, 4, 0, 4, 5};
    data->parts = {{0, 6}, {6, 6}};
    return Mesh{data};
}

struct FurnishedRoom {
    Scene scene;
    std::shared_ptr<const Solution> solution;
    NodeId floor, box, screen, mirrored;

    FurnishedRoom() {
        const MaterialId m = add_material(scene, 0.6F);
        add_room(scene, 4, 2.5F, 3, m);
        floor = scene.roots[0];
        box = add_node(scene, "box", Box{{0.6F, 0.5F, 0.7F}}, {1.1, 0.25, 1.3}, m);
        add_node(scene, "column", Cylinder{0.2F, 2.5F, true}, {2.6, 1.25, 1.0}, m);
        add_node(scene, "cone", Cone{0.3F, 0.1F, 0.6F, true}, {3.4, 0.3, 2.4}, m);
        add_node(scene, "ball", Sphere{0.25F}, {2.0, 0.25, 2.3}, m);
        const NodeId folded = add_node(scene, "folded", folded_mesh(), {0.7, 0.9, 2.0}, m);
        scene.nodes.find(folded)->materials = {m, m};
        Material two_sided;
        two_sided.double_sided = true;
        const MaterialId both = scene.materials.insert(two_sided);
        screen = add_rectangle(scene, "screen", {1.9, 0.6, 1.5}, {0, 0, 1}, {1, 0, 0}, 1, 1, both);
        mirrored = add_node(scene, "turned", Box{{0.4F, 0.4F, 0.4F}}, {3.4, 0.2, 0.6}, both, {-1, 1, 1});
        Polygon with_hole{{{-0.5F, -0.5F}, {0.5F, -0.5F}, {0.5F, 0.5F}, {-0.5F, 0.5F}},
                          {{{-0.2F, -0.2F}, {0.2F, -0.2F}, {0.2F, 0.2F}, {-0.2F, 0.2F}}}};
        add_node(scene, "frame", with_hole, {3.0, 1.5, 0.02}, m);
        add_point_light(scene, {0.8, 2.2, 0.7}, 1500);
        add_rectangle(scene, "panel", {3, 2.45, 2}, {0, -1, 0}, {1, 0, 0}, 0.5F, 0.5F, add_material(scene, 0, 2000.0F));
        solution = solve(scene, Quality::Draft).solution;
    }
};
const FurnishedRoom& furnished() {
    static const FurnishedRoom room;
    return room;
}

using Point = std::array<float, 3>;
Point key(const vec3& p) { return {p.x + 0.0F, p.y + 0.0F, p.z + 0.0F}; }

// Vertices of the node that lie strictly inside an edge of the node's triangles.
int t_vertices(const Scene&, const Solution& solution, NodeId node) {
    std::set<Point> points;
    std::set<std::pair<Point, Point>> edges;
    for (const auto& layer : solution.surfaces) {
        if (layer->node != node) {
            continue;
        }
        const DisplayMesh& mesh = *layer->mesh;
        for (const vec3& p : mesh.positions) {
            points.insert(key(p));
        }
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Point a = key(mesh.positions[mesh.indices[i + k]]),
                            b = key(mesh.positions[mesh.indices[i + (k + 1) % 3]]);
                edges.insert({std::min(a, b), std::max(a, b)});
            }
        }
    }
    int found = 0;
    for (const auto& [pa, pb] : edges) {
        const dvec3 a(pa[0], pa[1], pa[2]), b(pb[0], pb[1], pb[2]);
        const dvec3 d = b - a;
        const double length = glm::length(d);
        for (const Point& pp : points) {
            const dvec3 p(pp[0], pp[1], pp[2]);
            const double t = glm::dot(p - a, d) / (length * length);
            if (t > 1e-4 && t < 1 - 1e-4 && glm::length(a + d * t - p) < 1e-6) {
                ++found;
            }
        }
    }
    return found;
}

TEST(Layers, NoVertexLiesInsideANeighboursEdge) {
    const FurnishedRoom& room = furnished();
    ASSERT_TRUE(room.solution);
    std::size_t vertices = 0;
    for (const auto& layer : room.solution->surfaces) {
        vertices += layer->mesh->positions.size();
    }
    EXPECT_GT(vertices, 800U) << "the room is refined at all";
    for (const NodeId id : room.scene.roots) {
        if (room.scene.nodes.find(id)->shape) {
            EXPECT_EQ(t_vertices(room.scene, *room.solution, id), 0) << room.scene.nodes.find(id)->name;
        }
    }
}

TEST(Layers, ClosedShapesStayClosedAfterSplitting) {
    const FurnishedRoom& room = furnished();
    for (const char* name : {"box", "column", "cone", "ball", "turned"}) {
        std::map<std::pair<Point, Point>, int> balance;
        std::size_t triangles = 0;
        for (const auto& layer : room.solution->surfaces) {
            if (room.scene.nodes.find(layer->node)->name != name) {
                continue;
            }
            const DisplayMesh& mesh = *layer->mesh;
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3, ++triangles) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const Point a = key(mesh.positions[mesh.indices[i + k]]),
                                b = key(mesh.positions[mesh.indices[i + (k + 1) % 3]]);
                    balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
                }
            }
        }
        EXPECT_GE(triangles, 12U) << name;
        for (const auto& [edge, sum] : balance) {
            ASSERT_EQ(sum, 0) << name << " has a gap or a flipped triangle";
        }
    }
}

TEST(Layers, IndicesNormalsAndLightAreValid) {
    const FurnishedRoom& room = furnished();
    for (const auto& layer : room.solution->surfaces) {
        const std::string& name = room.scene.nodes.find(layer->node)->name;
        const DisplayMesh& mesh = *layer->mesh;
        const std::size_t n = mesh.positions.size();
        ASSERT_EQ(mesh.indices.size() % 3, 0U);
        std::vector<bool> used(n, false);
        for (const std::uint32_t i : mesh.indices) {
            ASSERT_LT(i, n);
            used[i] = true;
        }
        EXPECT_EQ(std::count(used.begin(), used.end(), false), 0) << name << ": every vertex is part of a triangle";
        EXPECT_EQ(mesh.normals.size(), n);
        EXPECT_EQ(layer->irradiance_front.size(), n);
        EXPECT_TRUE(layer->irradiance_back.empty() || layer->irradiance_back.size() == n);
        for (const auto* direct : {&layer->direct_front, &layer->direct_back}) {
            EXPECT_TRUE(direct->empty() || direct->size() == n);
        }
        EXPECT_TRUE(mesh.light_uv.empty() || mesh.light_uv.size() == n);
        EXPECT_TRUE(mesh.texcoords0.empty() || mesh.texcoords0.size() == n);
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_NEAR(glm::length(mesh.normals[i]), 1.0F, 1e-3F) << name;
        }
        for (const auto* light :
             {&layer->irradiance_front, &layer->irradiance_back, &layer->direct_front, &layer->direct_back}) {
            for (const Rgb& e : *light) {
                EXPECT_TRUE(is_finite(e)) << name;
                EXPECT_TRUE(e.r >= 0 && e.g >= 0 && e.b >= 0) << name;
            }
        }
    }
}

TEST(Layers, AreaAndWindingAreThoseOfTheShape) {
    // Splitting changes neither the area nor the way a face looks; mirrored nodes keep the file's own winding.
    const FurnishedRoom& room = furnished();
    for (const auto& layer : room.solution->surfaces) {
        const Node& node = *room.scene.nodes.find(layer->node);
        const DisplayMesh plain = make_display_mesh(*room.scene.shapes.find(node.shape), layer->part);
        const auto area_vectors = [](const DisplayMesh& mesh) {
            double area = 0.0, along = 0.0;
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
                const vec3 a = mesh.positions[mesh.indices[i]];
                const vec3 n =
                    0.5F * glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
                area += glm::length(n);
                along += glm::dot(n, mesh.normals[mesh.indices[i]]);
            }
            return dvec2(area, along);
        };
        const dvec2 was = area_vectors(plain), is = area_vectors(*layer->mesh);
        EXPECT_NEAR(is.x / was.x, 1.0, 1e-4) << node.name;
        EXPECT_GT(is.y, 0.9 * is.x) << node.name << ": winding and normals agree";
        EXPECT_NEAR(is.y / was.y, 1.0, 0.02) << node.name;
    }
}

TEST(Layers, BackSidesAreThereOnlyWhereTheyAreLit) {
    const FurnishedRoom& room = furnished();
    for (const auto& layer : room.solution->surfaces) {
        const std::string& name = room.scene.nodes.find(layer->node)->name;
        EXPECT_EQ(!layer->irradiance_back.empty(), name == "screen") << name;
    }
    // A two-sided sheet that nothing lights from behind carries no second set of numbers.
    Scene scene;
    Material both;
    both.double_sided = true;
    add_rectangle(scene, "sheet", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 2, 2, scene.materials.insert(both));
    add_point_light(scene, {0, 2, 0}, 1000);
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    ASSERT_EQ(s.solution->surfaces.size(), 1U);
    EXPECT_TRUE(s.solution->surfaces[0]->irradiance_back.empty());
}

TEST(Layers, CoveredFloorTakesTheLightAroundItsBox) {
    const FurnishedRoom& room = furnished();
    for (const auto& layer : room.solution->surfaces) {
        if (layer->node != room.floor) {
            continue;
        }
        const dmat4 world = room.scene.world_matrix(layer->node);
        int outside = 0;
        for (std::size_t i = 0; i < layer->mesh->positions.size(); ++i) {
            const dvec3 p(world * dvec4(dvec3(layer->mesh->positions[i]), 1.0));
            const double dx = std::abs(p.x - 1.1) - 0.3, dz = std::abs(p.z - 1.3) - 0.35;
            const double e = luminance(light_on(*layer, i));
            EXPECT_TRUE(std::isfinite(e));
            if (std::max(dx, dz) > 0.0 && std::max(dx, dz) < 0.15) {
                // What the room itself gives at the vertex, without its mesh.
                EXPECT_GT(e, 5.0) << "a dark halo at " << p.x << ", " << p.z;
                ++outside;
            } else if (std::max(dx, dz) < 0.0) {
                EXPECT_GT(e, 0.5) << "black under the box shines through at its edge: " << p.x << ", " << p.z;
            }
        }
        EXPECT_GT(outside, 3);
    }
}

// Vertices under a box show what makes the light right where the box ends. Their neighbours' light, which they showed once,
// is too bright there: towards the foot of a dark box the floor gets darker.
TEST(Layers, LightBesideAFootIsThatOfTheReference) {
    Scene scene;
    const MaterialId glowing = add_material(scene, 0.5F, 100.0F); // like a furnace: no lamp, all of it is reflected light
    add_room(scene, 4, 2.5F, 3, {add_material(scene, 0.3F), glowing, glowing, glowing, glowing, glowing});
    add_node(scene, "box", Box{{0.5F, 0.5F, 0.5F}}, {1.63, 0.25, 1.37}, add_material(scene, 0.05F));
    const auto solution = solve(scene, Quality::Normal).solution;
    ASSERT_TRUE(solution);
    std::vector<SensorPlace> places;
    std::vector<ReferencePoint> points;
    for (const double gap : {0.004, 0.012}) {
        for (double along = -0.12; along < 0.13; along += 0.04) { // corners have a light of their own
            for (const dvec2& d : {dvec2(along, 0.25 + gap), dvec2(along, -0.25 - gap), dvec2(0.25 + gap, along),
                                   dvec2(-0.25 - gap, along)}) {
                const dvec3 p(1.63 + d.x, 0.0, 1.37 + d.y);
                places.push_back({p, {0, 1, 0}});
                points.push_back({p, {0, 1, 0}});
            }
        }
    }
    ReferenceSettings settings;
    settings.paths = 2048;
    const auto truth = reference_irradiance(scene, points, settings, RunContext{});
    ASSERT_TRUE(truth);
    const std::vector<SensorReading> read = read_surfaces(scene, *solution, places);
    double square = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < read.size(); ++i) {
        const double t = luminance(truth->points[i].irradiance), s = truth->points[i].standard_error / t;
        const double d = luminance(read[i].irradiance) / t - 1.0;
        square += d * d - s * s;
        sum += d;
    }
    const double rms = std::sqrt(square / double(read.size())), mean = sum / double(read.size());
    EXPECT_LT(rms, 0.07) << "0.10 where they show their neighbours' light";
    EXPECT_LT(std::abs(mean), 0.06);
}

TEST(Layers, ALegThatSinksIntoTheFloorHasTheLightOfTheRoom) {
    Scene scene;
    add_room(scene, 4, 3, 4, add_material(scene, 0.6F));
    // Its end lies 2 mm below the floor, under a sky a hundred times as bright as the room.
    const double sunk = 0.002;
    const NodeId leg =
        add_node(scene, "leg", Cylinder{0.01F, 0.09F, true}, {2.0, 0.045 - sunk, 2.0}, add_material(scene, 0.5F));
    add_point_light(scene, {2.0, 2.5, 2.0}, 2000.0);
    scene.environment.sky_radiance = Rgb(20000.0F);
    GiEngine engine;
    const auto solution = engine.solve(scene, {}, {});
    ASSERT_TRUE(solution);
    int ends = 0;
    for (const auto& layer : (*solution)->surfaces) {
        for (std::size_t v = 0; layer->node == leg && v < layer->mesh->positions.size(); ++v) {
            const bool side = std::abs(layer->mesh->normals[v].y) < 0.5F;
            if (side) {
                const double light = luminance(light_on(*layer, v));
                const float height = layer->mesh->positions[v].y;
                ends += height < -0.0449F ? 1 : 0;
                EXPECT_GT(light, 10.0) << height;
                EXPECT_LT(light, 1000.0) << height << ": light from under the floor";
            }
        }
    }
    EXPECT_GT(ends, 8) << "vertices of its end";
}

TEST(Layers, VertexBudgetIsKept) {
    Scene scene;
    add_room(scene, 4, 2.5F, 3, add_material(scene, 0.6F));
    add_point_light(scene, {2, 2.4, 1}, 1500);
    const RayScene rays(scene);
    const DirectLight direct(scene, rays);
    const Hierarchy hierarchy = build_hierarchy(rays, {});
    const PointGather gather(hierarchy, rays, &direct);
    LayerSettings settings;
    settings.base_edge = 1.0F;
    settings.contrast = 0.001F;
    settings.smallest_edge = 0.01F;
    const auto build = [&](std::size_t most) {
        settings.max_vertices = most;
        const LightField field{
            {},
            [](const vec3&, const vec3&) { return DirectSample{}; },
            [&](const vec3& p, const vec3& n) { return gather.irradiance(p, n, {}); },
        };
        return build_layers(
            rays, field, {}, settings, [](std::uint32_t) { return false; }, RunContext{}, 0.0, 1.0);
    };
    const LayerSet few = build(500);
    const LayerSet many = build(5000);
    EXPECT_TRUE(few.complete && many.complete);
    EXPECT_LT(few.vertices, many.vertices);
    // A level that began within the budget is finished so that no T-vertex stays: up to twice the number.
    EXPECT_LT(few.vertices, 1500U);
    for (const LayerSet* set : {&few, &many}) {
        Solution solution;
        solution.surfaces = set->surfaces;
        EXPECT_EQ(t_vertices(scene, solution, scene.roots[0]), 0);
    }
}

// The first picture has to be there at once: light of the vertices alone, asked for once, and nothing between them.
TEST(Layers, WithoutALookBetweenVerticesEachIsAskedOnce) {
    Scene scene;
    add_room(scene, 4, 2.5F, 3, add_material(scene, 0.6F));
    add_node(scene, "box", Box{{0.6F, 0.5F, 0.7F}}, {1.1, 0.25, 1.3}, add_material(scene, 0.6F));
    const RayScene rays(scene);
    LayerSettings settings;
    settings.base_edge = 1.0F;
    settings.contrast = 0.01F;
    std::size_t asked = 0, told = 0;
    const auto build = [&](bool look_between) {
        settings.look_between = look_between;
        asked = told = 0;
        const LightField field{
            [&](std::span<const SurfacePoint> points) {
                told += points.size();
                return true;
            },
            [&](const vec3& p, const vec3&) {
                ++asked;
                return DirectSample{Rgb(100.0F + 60.0F * std::sin(8.0F * (p.x + p.y + p.z))), 0.0F};
            },
            [](const vec3&, const vec3&) { return DirectSample{}; },
        };
        set_thread_limit(1); // `asked` is no atomic number
        LayerSet set = build_layers(
            rays, field, {}, settings, [](std::uint32_t) { return false; }, RunContext{}, 0.0, 1.0);
        set_thread_limit(0);
        return set;
    };
    const LayerSet quick = build(false);
    ASSERT_TRUE(quick.complete);
    EXPECT_EQ(asked, told);
    EXPECT_LE(asked, quick.vertices);
    EXPECT_GT(asked, quick.vertices / 2);
    Solution solution;
    solution.surfaces = quick.surfaces;
    for (const NodeId node : scene.roots) {
        EXPECT_EQ(t_vertices(scene, solution, node), 0);
    }
    const LayerSet close = build(true);
    ASSERT_TRUE(close.complete);
    EXPECT_GT(close.vertices, 2 * quick.vertices) << "this light changes within half a metre";
}

TEST(DisplayMeshTest, UnlitTrianglesOfAPart) {
    Shape shape;
    shape.geometry = folded_mesh();
    const DisplayMesh first = make_display_mesh(shape, 0);
    EXPECT_EQ(first.indices.size(), 6U);
    EXPECT_EQ(first.positions.size(), 6U) << "flat shaded: corners are not shared";
    for (const vec3& n : first.normals) {
        EXPECT_LT(glm::length(n - vec3(0, 1, 0)), 1e-5F);
    }
    EXPECT_TRUE(make_display_mesh(shape, 2).indices.empty()) << "no such part";
    shape.geometry = Box{};
    EXPECT_EQ(make_display_mesh(shape, 0).indices.size(), 36U);
    EXPECT_EQ(make_display_mesh(shape, 0).positions.size(), 24U);
    shape.geometry = Sphere{0.0F};
    EXPECT_TRUE(make_display_mesh(shape, 0).indices.empty());
}

} // namespace
} // namespace atrium
