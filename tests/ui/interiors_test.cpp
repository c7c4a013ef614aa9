// Every shared interior through the whole window: opened, lit, walked through, edited, saved and reopened.
#include "window_fixture.h"

#include "engine/scene/daylight.h"

#include <QFileInfo>
#include <QPushButton>
#include <QSignalSpy>

#include <cstdio>

namespace atrium::ui {
namespace {

class Interiors : public WindowTest, public testing::WithParamInterface<const char*> {
protected:
    /// The first node, in tree order, that shows a shape.
    [[nodiscard]] NodeId first_object() {
        for (const NodeId id : scene().in_tree_order()) {
            if (node(id).shape && !node(id).locked) {
                return id;
            }
        }
        return {};
    }
    void open(const QString& path) {
        QSignalSpy opened(&window->files(), &FileController::opened);
        window->files().open(path);
        ASSERT_TRUE(opened.count() > 0 || opened.wait(30000)) << path.toStdString();
    }
};

TEST_P(Interiors, OpenedLitWalkedEditedSavedReopened) {
    const QString path = QStringLiteral(ATRIUM_SHARED_DIR "/scenes/interiors/%1.glb").arg(QLatin1String(GetParam()));
    if (!QFileInfo::exists(path)) {
        GTEST_SKIP() << "no shared scenes here";
    }
    open(path);
    SolverSettings draft;
    draft.quality = SolverSettings::Quality::Draft;
    ASSERT_TRUE(window->document().apply({SetSolverSettings{draft}}, QStringLiteral("Draft")));
    if (has_no_light(scene())) {
        auto* add = window->findChild<QPushButton*>(QStringLiteral("daylight_add"));
        ASSERT_TRUE(add != nullptr && add->isVisible());
        QTest::mouseClick(add, Qt::LeftButton);
        EXPECT_FALSE(has_no_light(scene()));
    }
    const std::uint64_t wanted = window->document().revision();
    const auto lit = [&] {
        const auto solution = window->engine().solution();
        return solution && solution->revision >= wanted && !solution->surfaces.empty() && solution->mean_radiance > 0.0;
    };
    ASSERT_TRUE(QTest::qWaitFor(lit, 150000)) << "no picture";
    const double first_picture = window->engine().solution()->statistics.time.first_picture;

    // Walking: forward moves the eye over the floor and never changes its height by more than a step of a stair.
    ViewportWidget& view = window->viewport();
    view.setFocus();
    view.set_walk_mode(true);
    settle();
    const dvec3 start(view.camera().to_world[3]);
    QTest::keyPress(&view, Qt::Key_W);
    QTest::qWait(400);
    QTest::keyRelease(&view, Qt::Key_W);
    settle();
    const dvec3 moved = dvec3(view.camera().to_world[3]) - start;
    EXPECT_GT(glm::length(dvec3(moved.x, 0.0, moved.z)), 0.05);
    QTest::keyClick(&view, Qt::Key_Escape);
    EXPECT_FALSE(view.walk_mode());

    const NodeId object = first_object();
    ASSERT_TRUE(object);
    Transform to = node(object).transform;
    to.translation.x += 0.25;
    ASSERT_TRUE(window->document().apply({SetTransform{object, to}}, QStringLiteral("Move")));
    window->document().undo();
    window->document().redo();
    EXPECT_EQ(node(object).transform, to);

    const Scene before = scene();
    const QString project = folder.filePath(QStringLiteral("saved.atrium"));
    bool saved = false;
    window->files().save_to(project, [&](bool ok) { saved = ok; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return saved; }, 60000));
    window->files().new_scene();
    open(project);
    const std::vector<NodeId> old_nodes = before.in_tree_order();
    const std::vector<NodeId> new_nodes = scene().in_tree_order();
    ASSERT_EQ(new_nodes.size(), old_nodes.size());
    for (std::size_t i = 0; i < old_nodes.size(); ++i) {
        EXPECT_EQ(node(new_nodes[i]).name, before.nodes.find(old_nodes[i])->name);
        EXPECT_EQ(node(new_nodes[i]).transform, before.nodes.find(old_nodes[i])->transform) << node(new_nodes[i]).name;
    }
    std::printf("[ interior ] %s: first picture %.1f s at draft, %zu nodes\n", GetParam(), first_picture, new_nodes.size());
}

INSTANTIATE_TEST_SUITE_P(Shared, Interiors,
                         testing::Values("cornell_box", "cornell_glass_spheres", "office_simple", "office_b90",
                                         "classroom_leuven", "fzk_house_bim", "small_house", "wooden_staircase"),
                         [](const auto& scene_name) { return std::string(scene_name.param); });

} // namespace
} // namespace atrium::ui
