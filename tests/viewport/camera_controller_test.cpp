#include "ui/viewport/camera_controller.h"

#include <gtest/gtest.h>

namespace atrium::ui {
namespace {

CameraController make_camera(const dvec3& eye = {1.0, 1.6, 4.0}) {
    CameraController c;
    c.set_viewport(800, 600);
    DBox3 room;
    room.add(dvec3(0.0));
    room.add(dvec3(5.0, 3.0, 6.0));
    c.set_scene_bounds(room);
    ViewCamera view;
    view.to_world[3] = dvec4(eye, 1.0);
    c.set_camera(view);
    return c;
}

TEST(CameraController, RayAndProjectionAreInverse) {
    CameraController c = make_camera();
    c.look({130, -40});
    const dvec2 point(613, 122);
    const Ray ray = c.ray(point);
    const auto back = c.project(ray.at(3.7));
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->x, point.x, 1e-9);
    EXPECT_NEAR(back->y, point.y, 1e-9);
    EXPECT_FALSE(c.project(ray.at(-1.0)));
}

TEST(CameraController, ProjectionMatrixAgreesWithProject) {
    CameraController c = make_camera();
    c.look({50, 30});
    const dvec3 world(0.4, 1.1, 0.3);
    const dvec4 clip = c.projection() * c.rotation() * dvec4(world - c.eye(), 1.0);
    const auto point = c.project(world);
    ASSERT_TRUE(point);
    EXPECT_NEAR((clip.x / clip.w * 0.5 + 0.5) * 800, point->x, 1e-9);
    EXPECT_NEAR((0.5 - clip.y / clip.w * 0.5) * 600, point->y, 1e-9);
}

TEST(CameraController, OrbitKeepsThePivotUnderTheCursor) {
    CameraController c = make_camera();
    const dvec3 pivot(2.0, 0.8, 1.0);
    const auto before = c.project(pivot);
    const double distance = glm::length(c.eye() - pivot);
    c.orbit({57, 23}, pivot);
    const auto after = c.project(pivot);
    ASSERT_TRUE(before && after);
    EXPECT_NEAR(after->x, before->x, 1e-6);
    EXPECT_NEAR(after->y, before->y, 1e-6);
    EXPECT_NEAR(glm::length(c.eye() - pivot), distance, 1e-9);
    EXPECT_NEAR(c.right().y, 0.0, 1e-12) << "the horizon stays level";
}

TEST(CameraController, LookingNeverTipsOver) {
    CameraController c = make_camera();
    for (int i = 0; i < 100; ++i) {
        c.look({3, 100});
    }
    EXPECT_GT(c.up().y, 0.0);
    for (int i = 0; i < 100; ++i) {
        c.look({-3, -100});
    }
    EXPECT_GT(c.up().y, 0.0);
}

TEST(CameraController, PanMovesThePivotWithTheCursor) {
    CameraController c = make_camera();
    const dvec3 pivot(1.5, 1.0, 1.0);
    const auto before = c.project(pivot);
    c.pan({40, -25}, pivot);
    const auto after = c.project(pivot);
    ASSERT_TRUE(before && after);
    EXPECT_NEAR(after->x - before->x, 40, 1e-6);
    EXPECT_NEAR(after->y - before->y, -25, 1e-6);
}

TEST(CameraController, DollyKeepsTheTargetUnderTheCursorAndNeverStops) {
    CameraController c = make_camera();
    const dvec3 target(2.0, 0.5, 0.0);
    const auto before = c.project(target);
    c.dolly(3, target);
    const auto after = c.project(target);
    ASSERT_TRUE(before && after);
    EXPECT_NEAR(after->x, before->x, 1e-6);
    EXPECT_NEAR(after->y, before->y, 1e-6);
    // In front of a wall one goes on through it, in finite steps.
    for (int i = 0; i < 60; ++i) {
        const dvec3 wall = c.eye() + c.forward() * 0.2;
        const dvec3 eye = c.eye();
        c.dolly(1, wall);
        ASSERT_GT(glm::length(c.eye() - eye), 0.05);
    }
}

TEST(CameraController, FramedBoxLiesInTheView) {
    CameraController c = make_camera();
    DBox3 box;
    box.add(dvec3(2.0, 0.0, 1.0));
    box.add(dvec3(2.5, 0.9, 1.4));
    c.frame(box);
    for (int i = 0; i < 8; ++i) {
        const auto p = c.project({(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                                  (i & 4) != 0 ? box.max.z : box.min.z});
        ASSERT_TRUE(p);
        EXPECT_GT(p->x, 0);
        EXPECT_LT(p->x, 800);
        EXPECT_GT(p->y, 0);
        EXPECT_LT(p->y, 600);
    }
}

TEST(CameraController, SurveyCoordinatesKeepTheirPrecision) {
    const dvec3 offset(4.5e6, 0.0, 5.3e6);
    CameraController near_zero = make_camera({1, 2, 3});
    CameraController far_away = make_camera(offset + dvec3(1, 2, 3));
    const auto a = near_zero.project({1.3, 1.9, 0.4});
    const auto b = far_away.project(offset + dvec3(1.3, 1.9, 0.4));
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(a->x, b->x, 1e-3);
    EXPECT_NEAR(a->y, b->y, 1e-3);
}

TEST(CameraController, NearPlaneIsCentimetresInsideAndGrowsOutside) {
    EXPECT_GE(make_camera().near_plane(), 0.01);
    EXPECT_LE(make_camera().near_plane(), 0.05);
    EXPECT_GT(make_camera({500, 2, 3}).near_plane(), 100.0);
}

TEST(CameraController, WalkingKeepsLevelAndItsSpeed) {
    CameraController c = make_camera();
    c.look({0, 200}); // head down: the feet do not follow
    const dvec3 start = c.eye();
    c.walk({1, 1, 0, false}, 2.0);
    EXPECT_NEAR(c.eye().y, start.y, 1e-12);
    EXPECT_NEAR(glm::length(c.eye() - start), 2.0 * CameraController::kWalkSpeed, 1e-9);
    c.walk({0, 0, 0, true}, 1.0);
    for (int i = 0; i < 100; ++i) {
        c.settle_on_floor(0.35, 0.02);
    }
    EXPECT_NEAR(c.eye().y, 0.35 + CameraController::kEyeHeight, 1e-3);
}

TEST(CameraController, SetCameraDropsRollAndSurvivesNonsense) {
    CameraController c = make_camera();
    ViewCamera rolled;
    rolled.to_world = dmat4(dvec4(0, 1, 0, 0), dvec4(-1, 0, 0, 0), dvec4(0, 0, 1, 0), dvec4(7, 8, 9, 1));
    c.set_camera(rolled);
    EXPECT_NEAR(c.forward().z, -1.0, 1e-9);
    EXPECT_NEAR(c.right().y, 0.0, 1e-12);
    ViewCamera broken;
    broken.to_world[3] = dvec4(std::nan(""), 0, 0, 1);
    c.set_camera(broken);
    EXPECT_EQ(c.eye(), dvec3(7, 8, 9));
}

Scene scene_with_boxes(const std::vector<dvec3>& places) {
    Scene scene;
    const ShapeId shape = scene.shapes.insert({"Box", Box{vec3(1.0F)}, {}});
    for (const dvec3& place : places) {
        Node node;
        node.shape = shape;
        node.transform.translation = place;
        scene.roots.push_back(scene.nodes.insert(node));
    }
    return scene;
}

TEST(RobustBounds, OneFarOutlierDoesNotSpoilTheView) {
    std::vector<dvec3> places;
    for (int i = 0; i < 9; ++i) {
        places.emplace_back(i % 3, 0.0, i / 3);
    }
    const DBox3 plain = robust_bounds(scene_with_boxes(places));
    places.emplace_back(9000.0, 0.0, 0.0);
    const DBox3 with_outlier = robust_bounds(scene_with_boxes(places));
    EXPECT_EQ(plain.min, with_outlier.min);
    EXPECT_EQ(plain.max, with_outlier.max);
    EXPECT_TRUE(robust_bounds(Scene{}).empty());
}

TEST(InitialView, TakesTheFilesCameraUnlessItLooksAway) {
    Scene scene = scene_with_boxes({{0, 0, 0}, {2, 0, 0}});
    Node node;
    node.camera = scene.cameras.insert({});
    node.transform.translation = dvec3(1.0, 0.5, 4.0);
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    EXPECT_EQ(dvec3(initial_view(scene).to_world[3]), dvec3(1.0, 0.5, 4.0));
    scene.nodes.find(id)->transform.translation = dvec3(1.0, 0.5, -4.0); // looks along -z, away from the boxes
    EXPECT_NE(dvec3(initial_view(scene).to_world[3]), dvec3(1.0, 0.5, -4.0));
}

TEST(InitialView, OfAThingIsFromOutsideAndShowsAllOfIt) {
    const Scene scene = scene_with_boxes({{0, 0, 0}, {0.6, 0, 0}});
    const DBox3 bounds = robust_bounds(scene);
    ASSERT_LT(bounds.size().y, 2.0);
    CameraController camera;
    camera.set_viewport(800, 600);
    camera.set_camera(initial_view(scene));
    for (int i = 0; i < 8; ++i) {
        const auto p =
            camera.project({(i & 1) != 0 ? bounds.max.x : bounds.min.x, (i & 2) != 0 ? bounds.max.y : bounds.min.y,
                            (i & 4) != 0 ? bounds.max.z : bounds.min.z});
        ASSERT_TRUE(p) << "behind the camera";
        EXPECT_GT(std::min(p->x, p->y), 0.0);
        EXPECT_LT(p->x, 800.0);
        EXPECT_LT(p->y, 600.0);
    }
}

} // namespace
} // namespace atrium::ui
