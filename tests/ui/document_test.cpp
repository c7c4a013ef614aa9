#include "ui/document/document.h"
#include "ui/document/gesture.h"
#include "ui/document/insert_commands.h"
#include "ui/document/recovery.h"
#include "ui/document/sample_room.h"

#include "engine/io/scene_file.h"

#include <gtest/gtest.h>

#include <QDir>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

namespace atrium::ui {
namespace {

NodeId named(const Scene& scene, const std::string& name) {
    NodeId found;
    scene.nodes.for_each([&](NodeId id, const Node& node) {
        if (node.name == name) {
            found = id;
        }
    });
    return found;
}

class DocumentTest : public testing::Test {
protected:
    DocumentTest() {
        document.reset(sample_room(), {}, {});
        bowl = named(document.scene(), "Bowl");
        vase = named(document.scene(), "Vase");
    }
    SceneEdit move(NodeId id, double x) const {
        Transform t = document.scene().nodes.find(id)->transform;
        t.translation.x = x;
        return SceneEdit{SetTransform{id, t}};
    }
    double x_of(NodeId id) const { return document.scene().nodes.find(id)->transform.translation.x; }
    int entries() { return document.undo_stack()->count(); }

    Document document;
    NodeId bowl;
    NodeId vase;
};

TEST_F(DocumentTest, GestureIsOneEntryWithStartAndEnd) {
    const Scene before = document.scene();
    {
        Gesture gesture(document, QStringLiteral("Move"));
        for (int i = 1; i <= 100; ++i) {
            // Two objects at once: a group per mouse move.
            ASSERT_TRUE(document.apply(SceneEdit{EditGroup{{move(bowl, i * 0.01), move(vase, i * 0.02)}}}, {}));
        }
        EXPECT_EQ(entries(), 0);
        gesture.commit();
    }
    EXPECT_EQ(entries(), 1);
    EXPECT_DOUBLE_EQ(x_of(bowl), 1.0);
    EXPECT_DOUBLE_EQ(x_of(vase), 2.0);
    const Scene after = document.scene();
    QSignalSpy edits(&document, &Document::edited);
    document.undo();
    EXPECT_EQ(edits.count(), 1);
    EXPECT_TRUE(document.scene() == before);
    document.redo();
    EXPECT_TRUE(document.scene() == after);
}

TEST_F(DocumentTest, DestroyedGestureRollsBack) {
    const Scene before = document.scene();
    {
        const Gesture gesture(document, QStringLiteral("Move"));
        ASSERT_TRUE(document.apply(move(bowl, 3), {}));
        ASSERT_TRUE(document.apply(delete_nodes({vase}), {}));
    }
    EXPECT_TRUE(document.scene() == before);
    EXPECT_EQ(entries(), 0);
    EXPECT_TRUE(document.undo_stack()->isClean());
}

TEST_F(DocumentTest, NothingChangedLeavesNoEntry) {
    const std::uint64_t revision = document.revision();
    ASSERT_TRUE(document.apply(move(bowl, x_of(bowl)), {}));
    EXPECT_EQ(document.revision(), revision);
    const double start = x_of(bowl);
    Gesture gesture(document, QStringLiteral("Move"));
    ASSERT_TRUE(document.apply(move(bowl, 7), {}));
    ASSERT_TRUE(document.apply(move(bowl, start), {}));
    gesture.commit();
    EXPECT_EQ(entries(), 0);
    EXPECT_TRUE(document.undo_stack()->isClean());
}

TEST_F(DocumentTest, UndoIsIgnoredWhileTheMouseHoldsAnObject) {
    ASSERT_TRUE(document.apply(move(bowl, 1), {}));
    Gesture gesture(document, QStringLiteral("Move"));
    ASSERT_TRUE(document.apply(move(bowl, 2), {}));
    document.undo();
    EXPECT_DOUBLE_EQ(x_of(bowl), 2);
    gesture.commit();
    document.undo();
    EXPECT_DOUBLE_EQ(x_of(bowl), 1);
}

TEST_F(DocumentTest, RefusedEditChangesNothing) {
    const Scene before = document.scene();
    const auto done = document.apply(SceneEdit{SetParent{named(before, "Table"), bowl, 0}}, {});
    ASSERT_FALSE(done);
    EXPECT_FALSE(done.error().message().empty());
    EXPECT_TRUE(document.scene() == before);
    EXPECT_EQ(entries(), 0);
}

TEST_F(DocumentTest, DeletedNodesLeaveTheSelection) {
    document.selection()->set({vase, bowl});
    ASSERT_TRUE(document.apply(delete_nodes({bowl}), {}));
    EXPECT_EQ(document.selection()->nodes(), std::vector<NodeId>{vase});
}

TEST_F(DocumentTest, CommandsUndoExactly) {
    const Scene before = document.scene();
    const NodeId table = named(before, "Table");
    const std::vector<Command> commands = {duplicate_nodes(before, {table, bowl}),
                                           group_nodes(before, {bowl, named(before, "Shelf")}, "Group"),
                                           wrap_roots(before, 0.001, true, "Fix"),
                                           merge_scene(before, sample_room(), "Second room"),
                                           {reparent_nodes(before, {bowl}, {}, 0), {}}};
    for (const Command& command : commands) {
        const auto done = document.apply(command.edit, QStringLiteral("x"));
        ASSERT_TRUE(done) << done.error().message();
        EXPECT_FALSE(document.scene() == before);
        for (const NodeId id : command.select) {
            EXPECT_TRUE(document.scene().nodes.contains(id));
        }
        document.undo();
        EXPECT_TRUE(document.scene() == before);
    }
}

TEST_F(DocumentTest, GroupingAndMovingInTheTreeKeepsPlaces) {
    const dmat4 place = document.scene().world_matrix(bowl);
    const Command group = group_nodes(document.scene(), {bowl, named(document.scene(), "Shelf")}, "Group");
    ASSERT_TRUE(document.apply(group.edit, {}));
    ASSERT_TRUE(document.apply(reparent_nodes(document.scene(), {bowl}, {}, SIZE_MAX), {}));
    const dmat4 now = document.scene().world_matrix(bowl);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            EXPECT_NEAR(now[column][row], place[column][row], 1e-12);
        }
    }
}

TEST_F(DocumentTest, MergedSceneRefersToItsOwnCopies) {
    const Scene room = sample_room();
    const std::size_t nodes = document.scene().nodes.size();
    const Command merge = merge_scene(document.scene(), room, "Second");
    ASSERT_TRUE(document.apply(merge.edit, {}));
    EXPECT_EQ(document.scene().nodes.size(), 2 * nodes + 1);
    EXPECT_EQ(document.scene().materials.size(), 2 * room.materials.size());
    for (const NodeId id : document.scene().in_tree_order(merge.select.front())) {
        const Node& node = *document.scene().nodes.find(id);
        EXPECT_EQ(bool(node.shape), document.scene().shapes.contains(node.shape));
        for (const MaterialId material : node.materials) {
            EXPECT_TRUE(document.scene().materials.contains(material));
        }
    }
}

TEST(FreeName, CountsOn) {
    Scene scene;
    for (const char* name : {"Chair", "Chair 2", "Lamp 2"}) {
        Node node;
        node.name = name;
        scene.roots.push_back(scene.nodes.insert(node));
    }
    EXPECT_EQ(free_name(scene, "Table"), "Table");
    EXPECT_EQ(free_name(scene, "Chair"), "Chair 3");
    EXPECT_EQ(free_name(scene, "Chair 2"), "Chair 3");
    EXPECT_EQ(free_name(scene, "Lamp 2"), "Lamp 3");
}

TEST_F(DocumentTest, RecoveryOutlivesAKill) {
    const QTemporaryDir folder;
    {
        Recovery recovery(document, folder.path());
        recovery.set_limits(1000000, 3);
        QSignalSpy written(&recovery, &Recovery::written);
        for (int i = 1; i <= 3; ++i) {
            ASSERT_TRUE(document.apply(move(bowl, i), QStringLiteral("Move")));
        }
        ASSERT_TRUE(written.wait(10000));
        EXPECT_TRUE(recovery.orphans().empty()) << "its own file is not left behind yet";
    } // as a kill leaves it: clear() was not called
    Document next;
    Recovery recovery(next, folder.path());
    const auto left = recovery.orphans();
    ASSERT_EQ(left.size(), 1U);
    EXPECT_TRUE(left.front().date.isValid());
    const auto loaded = read_scene(left.front().path.toStdString());
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_DOUBLE_EQ(loaded->scene.nodes.find(named(loaded->scene, "Bowl"))->transform.translation.x, 3);
    EXPECT_EQ(recovery.orphans().size(), 1U) << "looking at it does not remove it";
    Recovery::discard(left.front());
    EXPECT_TRUE(recovery.orphans().empty());
}

TEST_F(DocumentTest, CleanExitRemovesTheRecoveryFile) {
    const QTemporaryDir folder;
    {
        Recovery recovery(document, folder.path());
        recovery.set_limits(1000000, 1);
        QSignalSpy written(&recovery, &Recovery::written);
        ASSERT_TRUE(document.apply(move(bowl, 1), QStringLiteral("Move")));
        ASSERT_TRUE(written.wait(10000));
        // A second write is under way when the program ends.
        ASSERT_TRUE(document.apply(move(bowl, 2), QStringLiteral("Move")));
        recovery.clear();
    }
    QThreadPool::globalInstance()->waitForDone();
    EXPECT_EQ(QDir(folder.path()).entryList(QDir::Files), QStringList());
}

} // namespace
} // namespace atrium::ui
