// Positions in metres whatever the scale of the groups above, and a light that is told from its own successor.
#include "ui/document/insert_commands.h"
#include "ui/document/placement_frame.h"
#include "window_fixture.h"

#include <QComboBox>
#include <QLabel>

#include <chrono>
#include <thread>

namespace atrium::ui {
namespace {

/// As CAD programs export: millimetres, +Z up, below a root that turns both into ours.
struct Exported {
    Scene scene;
    NodeId root, group, box;

    explicit Exported(const dvec3& scale = dvec3(0.001)) {
        root = add("Root", {}, {{1.0, 2.0, 3.0}, glm::angleAxis(-0.5 * kPiD, dvec3(1, 0, 0)), scale});
        group = add("Group", root, {{500.0, 0.0, 0.0}, glm::angleAxis(0.3, dvec3(0, 0, 1)), dvec3(2.0)});
        box = add("Crate", group, {{100.0, 200.0, 300.0}, {1, 0, 0, 0}, dvec3(1.0)});
        scene.nodes.find(box)->shape = scene.shapes.insert({"crate", Box{vec3(400.0F, 200.0F, 100.0F)}, {}});
    }
    NodeId add(const char* name, NodeId parent, const Transform& transform) {
        Node node;
        node.name = name;
        node.parent = parent;
        node.transform = transform;
        const NodeId id = scene.nodes.next_key();
        EXPECT_TRUE(atrium::apply(scene, {AddNode{id, node}}));
        return id;
    }
    [[nodiscard]] dvec3 world(NodeId id) const { return dvec3(scene.world_matrix(id)[3]); }
    void place(const std::vector<NodeId>& nodes, PlacementFrame frame, const std::function<void(FramedPlacement&)>& how) {
        const auto change = [&](FramedPlacement& p, NodeId /*id*/) { how(p); };
        ASSERT_TRUE(atrium::apply(scene, place_nodes(scene, nodes, frame, change)));
    }
};

TEST(PlacementFrame, PositionsAreMetresOfTheScene) {
    Exported one;
    EXPECT_LT(glm::length(placement_in(one.scene, one.box, PlacementFrame::World).position - one.world(one.box)), 1e-12);
    const dvec3 before = one.world(one.box);
    one.place({one.box}, PlacementFrame::World, [](FramedPlacement& p) { p.position.y = 0.25; });
    EXPECT_LT(glm::length(one.world(one.box) - dvec3(before.x, 0.25, before.z)), 1e-12);
    EXPECT_LT(glm::length(placement_in(one.scene, one.box, PlacementFrame::World).position - one.world(one.box)), 1e-12);
}

TEST(PlacementFrame, AlongTheGroupsAxesTheyAreMetresToo) {
    Exported one;
    const dvec3 told = placement_in(one.scene, one.box, PlacementFrame::Parent).position;
    EXPECT_LT(glm::length(told - dvec3(0.2, 0.4, 0.6)), 1e-12) << "0.001 times 2";
    const dvec3 before = one.world(one.box);
    one.place({one.box}, PlacementFrame::Parent, [](FramedPlacement& p) { p.position.z += 0.5; });
    EXPECT_LT(glm::length(one.world(one.box) - before - dvec3(0, 0.5, 0)), 1e-12) << "the group's Z is our Y";
}

TEST(PlacementFrame, TurnsAboutTheAxesOfTheScene) {
    Exported one;
    const dquat wanted = glm::angleAxis(0.7, glm::normalize(dvec3(0.3, 1.0, -0.2)));
    one.place({one.box}, PlacementFrame::World, [&](FramedPlacement& p) { p.rotation = wanted; });
    const dmat3 turned(one.scene.world_matrix(one.box));
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LT(glm::length(turned[axis] / 0.002 - dmat3(glm::mat3_cast(wanted))[axis]), 1e-9);
    }
}

TEST(PlacementFrame, WhatIsLeftAloneStaysToTheLastBit) {
    Exported one(dvec3(0.1, 0.3, 0.7)); // sheared below
    const Scene before = one.scene;
    one.place({one.root, one.group, one.box}, PlacementFrame::World, [](FramedPlacement& p) { p.position += dvec3(0.0); });
    EXPECT_TRUE(one.scene == before);
}

TEST(PlacementFrame, AGroupAndItsChildEndWhereTheyWerePut) {
    Exported one(dvec3(0.1, 0.3, 0.7));
    one.place({one.box, one.root, one.group}, PlacementFrame::World, [](FramedPlacement& p) { p.position.x = 4.0; });
    EXPECT_NEAR(one.world(one.root).x, 4.0, 1e-12);
    EXPECT_NEAR(one.world(one.group).x, 4.0, 1e-12);
    EXPECT_NEAR(one.world(one.box).x, 4.0, 1e-12);
}

TEST(PlacementFrame, NothingBreaksBelowAGroupWithoutExtent) {
    Exported one(dvec3(0.001, 0.0, 0.001));
    const Scene before = one.scene;
    for (const PlacementFrame frame : {PlacementFrame::World, PlacementFrame::Parent}) {
        one.place({one.group}, frame, [](FramedPlacement& p) { p.position.y = 7.0; });
        const dvec3 own = one.scene.nodes.find(one.group)->transform.translation;
        EXPECT_TRUE(std::isfinite(own.x) && std::isfinite(own.y) && std::isfinite(own.z));
    }
    EXPECT_EQ(one.scene.nodes.find(one.root)->transform, before.nodes.find(one.root)->transform);
}

class PlacementTest : public WindowTest {};

TEST_F(PlacementTest, FieldsShowMetresHaveRoomAndKeepUndo) {
    const Exported exported;
    window->document().reset(exported.scene, {}, {});
    settle();
    const Scene before = scene();
    select(exported.box);
    const dvec3 at = exported.world(exported.box);
    for (const auto& [name, value] : {std::pair{"Position X", at.x}, {"Position Y", at.y}, {"Position Z", at.z}}) {
        NumberField* shown = field(name);
        EXPECT_NEAR(shown->value(), value, 1e-9) << name;
        EXPECT_TRUE(shown->text().endsWith(QStringLiteral(" m")));
        EXPECT_TRUE(shown->toolTip().contains(QStringLiteral("scene"))) << shown->toolTip().toStdString();
    }
    NumberField* x = field("Position X");
    type(x, "-57.9123 m");
    EXPECT_EQ(x->text(), QStringLiteral("-57.9123 m"));
    EXPECT_LT(x->fontMetrics().horizontalAdvance(x->text()), x->width() - 6) << "it has room";
    EXPECT_NEAR(dvec3(scene().world_matrix(exported.box)[3]).x, -57.9123, 1e-9);
    EXPECT_NEAR(dvec3(scene().world_matrix(exported.box)[3]).y, at.y, 1e-9);
    type(x, "-123456.7891");
    EXPECT_LT(x->fontMetrics().horizontalAdvance(x->text()), x->width() - 6) << x->text().toStdString();
    EXPECT_TRUE(x->toolTip().contains(QStringLiteral("-123456.7891 m"))) << "the whole number is in the tool tip";
    type(x, x->text().toUtf8().constData());
    EXPECT_EQ(entries(), 2) << "typing what is shown does not round what is there";
    EXPECT_NEAR(dvec3(scene().world_matrix(exported.box)[3]).x, -123456.7891, 1e-6);
    trigger(ActionId::Undo);
    trigger(ActionId::Undo);
    EXPECT_TRUE(scene() == before);

    auto* frame = window->findChild<QComboBox*>(QStringLiteral("Measured from"));
    ASSERT_NE(frame, nullptr);
    EXPECT_TRUE(frame->isVisible());
    QTest::keyClick(frame, Qt::Key_Down);
    EXPECT_NEAR(field("Position X")->value(), 0.2, 1e-9);
    EXPECT_NEAR(field("Position Y")->value(), 0.4, 1e-9);
    EXPECT_TRUE(scene() == before) << "looking at it otherwise is no edit";
    EXPECT_TRUE(window->document().undo_stack()->canRedo());
}

TEST_F(PlacementTest, SeveralObjectsOfSeveralGroupsMoveTogether) {
    Exported exported;
    const NodeId lone = exported.add("Lone", {}, {{9.0, 0.0, 1.0}, {1, 0, 0, 0}, dvec3(1.0)});
    window->document().reset(exported.scene, {}, {});
    settle();
    window->document().selection()->set({exported.box, lone});
    EXPECT_TRUE(field("Position Z")->mixed());
    type(field("Position Z"), "1.5");
    EXPECT_EQ(entries(), 1);
    EXPECT_NEAR(dvec3(scene().world_matrix(exported.box)[3]).z, 1.5, 1e-12);
    EXPECT_DOUBLE_EQ(node(lone).transform.translation.z, 1.5);
    EXPECT_FALSE(field("Position Z")->mixed());
    select(lone);
    settle();
    EXPECT_FALSE(window->findChild<QComboBox*>(QStringLiteral("Measured from"))->isVisible()) << "it is in no group";
    select(exported.box);
    settle();
    const auto* size = window->findChild<QLabel*>(QStringLiteral("Size"));
    ASSERT_NE(size, nullptr);
    EXPECT_TRUE(size->text().contains(QStringLiteral("0.2"))) << "100 mm high, twice: " << size->text().toStdString();
}

TEST_F(PlacementTest, LightThatIsOnItsWayToTheWindowIsNotYetTheLight) {
    open_sample();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window->engine().stale(); }, 120000));
    const auto before = window->engine().solution();
    EXPECT_TRUE(window->engine().follows());
    const NodeId vase = named("Vase");
    Transform moved = node(vase).transform;
    moved.translation.x += 0.1;
    ASSERT_TRUE(window->document().apply(SceneEdit{SetTransform{vase, moved}}, QStringLiteral("Move")));
    EXPECT_FALSE(window->engine().follows());
    const auto answered = [&] {
        const SessionStatus now = window->engine().status();
        return now.shown_revision == now.posted_revision;
    };
    for (int k = 0; k < 6000 && !answered(); ++k) { // the event loop does not turn
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_TRUE(answered());
    EXPECT_EQ(window->engine().solution(), before);
    EXPECT_FALSE(window->engine().follows()) << "the answer is there, and is not what the window has";
    EXPECT_TRUE(window->engine().stale());
    ASSERT_TRUE(QTest::qWaitFor([&] { return window->engine().follows(); }, 60000));
    EXPECT_NE(window->engine().solution(), before);
    Node renamed = node(vase);
    renamed.name = "Carafe";
    ASSERT_TRUE(window->document().apply(SceneEdit{SetNode{vase, renamed}}, QStringLiteral("Rename")));
    EXPECT_TRUE(window->engine().follows()) << "a name is no light";
}

} // namespace
} // namespace atrium::ui
