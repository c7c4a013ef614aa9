#include "ui/tools/gizmo.h"
#include "ui/viewport/view_scene.h"

#include <gtest/gtest.h>

#include <chrono>

namespace atrium::ui {
namespace {

std::shared_ptr<DisplayMesh> soup(std::size_t triangles) {
    auto mesh = std::make_shared<DisplayMesh>();
    std::uint32_t state = 12345;
    const auto next = [&state] {
        state = state * 1664525U + 1013904223U;
        return float(state >> 8U) / float(1U << 24U);
    };
    for (std::size_t i = 0; i < triangles; ++i) {
        const vec3 at(next() * 10, next() * 10, next() * 10);
        for (int k = 0; k < 3; ++k) {
            mesh->indices.push_back(std::uint32_t(mesh->positions.size()));
            mesh->positions.push_back(at + 0.3F * vec3(next(), next(), next()));
            mesh->normals.emplace_back(0, 0, 1);
        }
    }
    return mesh;
}

TEST(MeshBvh, AgreesWithTestingEveryTriangle) {
    const auto mesh = soup(2500);
    const MeshBvh bvh(mesh);
    int hits = 0;
    for (int i = 0; i < 100; ++i) {
        const dvec3 origin(-3.0, 0.1 * i, 4.0 + 0.02 * i);
        const dvec3 direction = glm::normalize(dvec3(5, 5, 5) - origin);
        for (const RaySides sides : {RaySides::Both, RaySides::Front}) {
            double expected = std::numeric_limits<double>::infinity();
            for (std::size_t t = 0; t < mesh->indices.size(); t += 3) {
                auto one = std::make_shared<DisplayMesh>();
                one->positions = {mesh->positions[t], mesh->positions[t + 1], mesh->positions[t + 2]};
                one->indices = {0, 1, 2};
                const auto hit = MeshBvh(one).nearest(origin, direction, expected, sides);
                expected = hit ? hit->t : expected;
            }
            const auto hit = bvh.nearest(origin, direction, std::numeric_limits<double>::infinity(), sides);
            EXPECT_EQ(hit ? hit->t : std::numeric_limits<double>::infinity(), expected);
            hits += hit ? 1 : 0;
        }
    }
    EXPECT_GT(hits, 20);
}

TEST(MeshBvh, AnswersAClickOnAQuarterMillionTrianglesWithinAFrame) {
    const auto mesh = soup(260000);
    const MeshBvh bvh(mesh);
    bvh.build();
    const auto start = std::chrono::steady_clock::now();
    int hits = 0;
    for (int i = 0; i < 10; ++i) {
        hits += bvh.nearest({-1.0, 0.9 * i, 5.0}, glm::normalize(dvec3(1.0, 0.1, 0.05 * i)), 1e9, RaySides::Both) ? 1 : 0;
    }
    const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
    EXPECT_LT(spent.count() / 10.0, 16.0);
    EXPECT_GT(hits, 0);
}

TEST(MeshBvh, NoRaySlipsThroughASeam) {
    for (const Geometry& geometry : {Geometry(Sphere{0.7F}), Geometry(Cylinder{0.3F, 1.1F})}) {
        const MeshBvh bvh(std::make_shared<const DisplayMesh>(make_display_mesh(Shape{"Round", geometry, {}}, 0)));
        const DisplayMesh& mesh = bvh.mesh();
        const vec3 middle = bvh.bounds().centre();
        int missed = 0;
        const auto shoot = [&](const vec3& surface) {
            const dvec3 out = glm::normalize(dvec3(surface - middle));
            const dvec3 origin = dvec3(surface) + out * 3.0;
            missed += bvh.nearest(origin, dvec3(surface) - origin, 10.0, RaySides::Front) ? 0 : 1;
        };
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                const vec3 a = mesh.positions[mesh.indices[i + k]];
                const vec3 b = mesh.positions[mesh.indices[i + (k + 1) % 3]];
                for (const float share : {0.0F, 0.25F, 0.5F, 0.7F}) {
                    const vec3 p = a + (b - a) * share;
                    // A cylinder is open at its rims, where a ray may pass by.
                    if (std::abs(p.y - middle.y) < 0.4F * bvh.bounds().size().y) {
                        shoot(p);
                    }
                }
            }
        }
        EXPECT_EQ(missed, 0);
    }
}

Scene one_polygon(bool double_sided) {
    Scene scene;
    Material material;
    material.double_sided = double_sided;
    Node node;
    node.name = "Wall";
    node.shape = scene.shapes.insert({"Wall", Polygon{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {}}, {}});
    node.materials = {scene.materials.insert(material)};
    node.transform.translation = dvec3(4.5e6, 2.0, 5.3e6); // survey coordinates
    node.transform.scale = dvec3(2.0, 1.0, 3.0);
    scene.roots.push_back(scene.nodes.insert(node));
    return scene;
}

TEST(ViewScene, PicksWhatIsDrawn) {
    for (const bool double_sided : {false, true}) {
        const Scene scene = one_polygon(double_sided);
        ViewScene view;
        view.sync(scene, nullptr);
        const dvec3 centre(4.5e6, 2.0, 5.3e6);
        const auto front = view.pick({centre + dvec3(1.9, 0.9, 5.0), dvec3(0, 0, -1)});
        ASSERT_TRUE(front);
        EXPECT_NEAR(front->distance, 5.0, 1e-6);
        EXPECT_NEAR(front->normal.z, 1.0, 1e-9);
        EXPECT_FALSE(view.pick({centre + dvec3(2.1, 0.9, 5.0), dvec3(0, 0, -1)}));
        // A single-sided back is culled in the picture, so one looks (and clicks) through it.
        EXPECT_EQ(view.pick({centre - dvec3(0, 0, 5.0), dvec3(0, 0, 1)}).has_value(), double_sided);
    }
}

TEST(ViewScene, MirroredNodesKeepTheirFrontAndHiddenOnesAreGone) {
    Scene scene = one_polygon(false);
    Node& node = *scene.nodes.find(scene.roots.front());
    node.transform.translation = dvec3(0.0);
    node.transform.scale = dvec3(-1.0, 1.0, 1.0);
    ViewScene view;
    view.sync(scene, nullptr);
    ASSERT_EQ(view.items().size(), 1U);
    EXPECT_TRUE(view.items().front().mirrored);
    EXPECT_TRUE(view.pick({dvec3(0, 0, 5), dvec3(0, 0, -1)})) << "mirroring in x leaves the front towards +z";
    EXPECT_FALSE(view.pick({dvec3(0, 0, -5), dvec3(0, 0, 1)}));
    node.visible = false;
    view.sync(scene, nullptr);
    EXPECT_TRUE(view.items().empty());
}

TEST(ViewScene, LayerIsUsedUntilItsShapeChanges) {
    Scene scene = one_polygon(false);
    const NodeId id = scene.roots.front();
    auto layer = std::make_shared<SurfaceLayer>();
    layer->node = id;
    layer->mesh = std::make_shared<DisplayMesh>(make_display_mesh(*scene.shapes.find(scene.nodes.find(id)->shape), 0));
    layer->irradiance_front.assign(layer->mesh->positions.size(), Rgb(100.0F));
    auto solution = std::make_shared<Solution>();
    solution->revision = 4;
    solution->mean_radiance = 30.0;
    solution->surfaces = {layer};
    ViewScene view;
    view.sync(scene, solution);
    ASSERT_EQ(view.items().size(), 1U);
    EXPECT_EQ(view.items()[0].layer, layer);
    const auto bvh = view.items()[0].bvh;
    view.sync(scene, solution);
    EXPECT_EQ(view.items()[0].bvh, bvh) << "nothing changed, nothing is built anew";

    const SceneEdit edit{SetResource<Shape>{scene.nodes.find(id)->shape, Shape{"Disc", Disc{0.5F}, {}}}};
    ASSERT_TRUE(apply(scene, edit));
    view.note_edit(scene, edit, 5);
    view.sync(scene, solution);
    EXPECT_EQ(view.items()[0].layer, nullptr) << "the old layer shows the old shape";
    EXPECT_FALSE(view.pick({dvec3(4.5e6 + 1.9, 2.0, 5.3e6 + 3), dvec3(0, 0, -1)}));
    auto newer = std::make_shared<Solution>(*solution);
    newer->revision = 5;
    view.sync(scene, newer);
    EXPECT_EQ(view.items()[0].layer, layer);
}

TEST(ViewScene, WhatHasNoLightIsShownAsNotLitYet) {
    Scene scene = one_polygon(false);
    auto layer = std::make_shared<SurfaceLayer>();
    layer->node = scene.roots.front();
    layer->mesh =
        std::make_shared<DisplayMesh>(make_display_mesh(*scene.shapes.find(scene.nodes.find(layer->node)->shape), 0));
    layer->irradiance_front.assign(layer->mesh->positions.size(), Rgb(0.0F));
    auto solution = std::make_shared<Solution>();
    solution->surfaces = {layer};
    ViewScene view;
    view.sync(scene, solution);
    EXPECT_EQ(view.items().at(0).layer, nullptr);
    solution = std::make_shared<Solution>(*solution);
    solution->mean_radiance = 3.0; // light elsewhere: here it is dark
    view.sync(scene, solution);
    EXPECT_EQ(view.items().at(0).layer, layer);
}

TEST(Gizmo, HandlesAreWhereTheyAreDrawnAtAnyDistance) {
    for (const double distance : {0.5, 3.0, 40.0}) {
        CameraController camera;
        camera.set_viewport(800, 600);
        ViewCamera view;
        view.to_world[3] = dvec4(0.0, 0.0, distance, 1.0);
        camera.set_camera(view);
        camera.orbit({60, 50}, dvec3(0.0));
        const Gizmo gizmo;
        const double size = Gizmo::kLength * camera.pixel_size(dvec3(0.0));
        EXPECT_EQ(gizmo.at(camera, *camera.project({0.8 * size, 0, 0})), Handle::AxisX);
        EXPECT_EQ(gizmo.at(camera, *camera.project({0, 0.8 * size, 0})), Handle::AxisY);
        EXPECT_EQ(gizmo.at(camera, *camera.project({0, 0, 0.8 * size})), Handle::AxisZ);
        EXPECT_EQ(gizmo.at(camera, *camera.project({0.4 * size, 0.4 * size, 0})), Handle::PlaneZ);
        EXPECT_EQ(gizmo.at(camera, *camera.project(dvec3(0.0))), Handle::Centre);
        EXPECT_EQ(gizmo.at(camera, {20, 20}), Handle::None);
    }
}

TEST(Gizmo, NearestOnAxisMeetsTheAxis) {
    const dvec3 origin(1, 2, 3);
    const dvec3 axis(0, 1, 0);
    const dvec3 target = origin + axis * 0.7;
    const Ray ray{dvec3(6, 4, 9), glm::normalize(target - dvec3(6, 4, 9))};
    const auto t = nearest_on_axis(ray, origin, axis);
    ASSERT_TRUE(t);
    EXPECT_NEAR(*t, 0.7, 1e-9);
    EXPECT_FALSE(nearest_on_axis({dvec3(1, 9, 3), dvec3(0, -1, 0)}, origin, axis));
}

TEST(Gizmo, PlanesAndAngles) {
    EXPECT_FALSE(meet_plane({dvec3(0, 1, 0), dvec3(1, 0, 0)}, dvec3(0.0), dvec3(0, 1, 0)));
    EXPECT_FALSE(meet_plane({dvec3(0, 1, 0), dvec3(0, 1, 0)}, dvec3(0.0), dvec3(0, 1, 0))) << "behind the eye";
    EXPECT_NEAR(angle_about({0, 1, 0}, {1, 0, 0}, {0, 0, -1}), kPiD / 2, 1e-12);
}

} // namespace
} // namespace atrium::ui
