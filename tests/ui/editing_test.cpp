// Clipboard, snapping, dropping, showing alone and cameras.
#include "ui/document/insert_commands.h"
#include "ui/document/sample_room.h"
#include "ui/document/scene_mime.h"
#include "ui/tools/snapping.h"
#include "window_fixture.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QMouseEvent>

namespace atrium::ui {
namespace {

TEST(Snapping, NearestFaceOfWhatIsBesideWins) {
    const DBox3 moving{dvec3(0, 0, 0), dvec3(1, 1, 1)};
    const DBox3 wall{dvec3(1.04, 0, -3), dvec3(1.2, 3, 3)};
    const DBox3 far_away{dvec3(1.01, 0, 8), dvec3(2, 1, 9)};
    const DBox3 others[] = {far_away, wall};
    auto faces = snap_to_faces(moving, others, 0.05, 0.5);
    ASSERT_TRUE(faces[0]);
    EXPECT_NEAR(faces[0]->shift, 0.04, 1e-12);
    EXPECT_NEAR(faces[0]->plane, 1.04, 1e-12);
    ASSERT_TRUE(faces[1]) << "both stand on y = 0";
    EXPECT_EQ(faces[1]->shift, 0.0);
    EXPECT_FALSE(faces[2]);
    EXPECT_FALSE(snap_to_faces(moving, others, 0.03, 0.5)[0]);
    EXPECT_FALSE(snap_to_faces(DBox3(), others, 1.0, 1.0)[0]);
}

TEST(Clipboard, ExtractedNodesSurviveTheFileAndKeepTheirPlace) {
    const Scene room = sample_room();
    NodeId vase;
    room.nodes.for_each([&](NodeId id, const Node& n) { vase = n.name == "Vase" ? id : vase; });
    const Scene piece = extract_nodes(room, {vase, vase});
    ASSERT_EQ(piece.roots.size(), 1U);
    const auto bytes = scene_to_bytes(piece);
    ASSERT_TRUE(bytes);
    const auto back = scene_from_bytes(*bytes);
    ASSERT_TRUE(back) << back.error().message();
    const DBox3 was = room.subtree_bounds(vase);
    const DBox3 now = back->subtree_bounds(back->roots.front());
    EXPECT_LT(glm::length(was.min - now.min) + glm::length(was.max - now.max), 1e-5);
    EXPECT_EQ(back->materials.size(), piece.materials.size());
    EXPECT_FALSE(scene_from_bytes(QByteArray("nonsense")));
}

class EditingTest : public WindowTest {};

TEST_F(EditingTest, CopyAndPasteAreOneEntryAndCutTakesAway) {
    open_sample();
    const Scene before = scene();
    const NodeId vase = named("Vase");
    const DBox3 was = scene().subtree_bounds(vase);
    select(vase);
    QTest::keyClick(&window->viewport(), Qt::Key_C, Qt::ControlModifier);
    EXPECT_EQ(entries(), 0);
    QTest::keyClick(&window->viewport(), Qt::Key_V, Qt::ControlModifier);
    EXPECT_EQ(entries(), 1);
    const NodeId copy = window->document().selection()->active();
    EXPECT_NE(copy, vase);
    EXPECT_EQ(node(copy).name, "Vase 2");
    EXPECT_EQ(scene().materials.size(), before.materials.size()) << "the same materials are used";
    trigger(ActionId::Undo);
    EXPECT_TRUE(scene() == before);
    select(vase);
    trigger(ActionId::Cut);
    EXPECT_FALSE(scene().nodes.contains(vase));
    trigger(ActionId::PasteInPlace);
    EXPECT_EQ(entries(), 2);
    const DBox3 now = scene().subtree_bounds(window->document().selection()->active());
    EXPECT_LT(glm::length(was.min - now.min) + glm::length(was.max - now.max), 1e-6);
}

TEST_F(EditingTest, DataOfAnotherProgramWindowArePasted) {
    open_sample();
    const Scene piece = extract_nodes(scene(), {named("Vase")});
    auto* foreign = new QMimeData; // bytes only, as they come from another process
    foreign->setData(SceneMime::type_of(SceneMime::Kind::Nodes), *scene_to_bytes(piece));
    QGuiApplication::clipboard()->setMimeData(foreign);
    trigger(ActionId::Paste);
    ASSERT_TRUE(QTest::qWaitFor([&] { return entries() == 1; }, 10000));
    EXPECT_EQ(node(window->document().selection()->active()).name, "Vase 2");
}

TEST_F(EditingTest, MaterialsAreCopiedOntoTheSelection) {
    open_sample();
    const NodeId vase = named("Vase");
    const NodeId shelf = named("Shelf");
    const Material wanted = *scene().material_of(node(vase), 0);
    ASSERT_FALSE(wanted == *scene().material_of(node(shelf), 0));
    select(vase);
    trigger(ActionId::CopyMaterial);
    select(shelf);
    trigger(ActionId::PasteMaterial);
    EXPECT_EQ(entries(), 1);
    EXPECT_TRUE(*scene().material_of(node(shelf), 0) == wanted);
}

TEST_F(EditingTest, DropToSurfaceLowersAndLifts) {
    open_sample();
    const NodeId vase = named("Vase");
    const double stood = scene().subtree_bounds(vase).min.y;
    select(vase);
    for (const double lift : {0.4, -0.03}) {
        Transform moved = node(vase).transform;
        const double rests = scene().subtree_bounds(vase).min.y;
        moved.translation.y += lift;
        ASSERT_TRUE(window->document().apply(SceneEdit{SetTransform{vase, moved}}, QStringLiteral("Move")));
        settle();
        const int had = entries();
        QTest::keyClick(&window->viewport(), Qt::Key_End);
        EXPECT_EQ(entries(), had + 1);
        EXPECT_NEAR(scene().subtree_bounds(vase).min.y, rests, 2e-3) << lift;
    }
    EXPECT_NEAR(scene().subtree_bounds(vase).min.y, stood, 0.02);
}

TEST_F(EditingTest, SnapTogglesAndCtrlTurnsItRound) {
    trigger(ActionId::New); // nothing else is there to be flush with
    Snapping steps = window->viewport().snapping();
    steps.grid = 0.25;
    window->viewport().set_snapping(steps);
    trigger(ActionId::AddBox);
    const NodeId box = window->document().selection()->active();
    trigger(ActionId::FrameAll);
    trigger(ActionId::ToolMove);
    settle();
    for (const bool on : {false, true}) {
        for (const bool ctrl : {false, true}) {
            window->action(ActionId::Snap)->setChecked(on);
            const dvec3 start = node(box).transform.translation;
            const QPoint from = at(scene().world_bounds(box).centre() + dvec3(0.15, 0.1, 0.15));
            drag(from, from + QPoint(int(0.6 / pixel_size(start)), 41), ctrl ? Qt::ControlModifier : Qt::NoModifier);
            const dvec3 moved = node(box).transform.translation - start;
            ASSERT_GT(glm::length(moved), 0.2) << on << ctrl;
            double off = 0.0; // the grid, at most of the axes
            for (int axis = 0; axis < 3; ++axis) {
                off = std::max(off, std::abs(std::remainder(moved[axis], 0.25)));
            }
            EXPECT_EQ(off < 1e-6, on != ctrl) << on << ctrl << ": " << moved.x << ' ' << moved.y << ' ' << moved.z;
            trigger(ActionId::Undo);
            settle();
        }
    }
    window->action(ActionId::Snap)->setChecked(false);
}

TEST_F(EditingTest, ABodyDragSlidesOntoWhatIsUnderTheCursor) {
    open_sample();
    const dvec3 floor = window->viewport().placement_point();
    trigger(ActionId::AddBox);
    const NodeId box = window->document().selection()->active();
    Transform high = node(box).transform;
    high.translation.y += 0.6; // hangs in the air: the slide brings it down
    ASSERT_TRUE(window->document().apply(SceneEdit{SetTransform{box, high}}, QStringLiteral("Move")));
    window->action(ActionId::SlideOnSurfaces)->setChecked(true);
    trigger(ActionId::ToolMove);
    trigger(ActionId::SelectNone); // no handles in the way of the hand
    settle();
    const int had = entries();
    const QPoint from = at(scene().world_bounds(box).centre() + dvec3(0.2, 0.2, 0.2));
    drag(from, at(floor + dvec3(0.1, 0, 0.1)));
    EXPECT_EQ(entries(), had + 1);
    EXPECT_NEAR(scene().world_bounds(box).min.y, floor.y, 1e-3);
    window->action(ActionId::SlideOnSurfaces)->setChecked(false);
}

TEST_F(EditingTest, IsolateShowsTheSelectionAloneAndChangesNothing) {
    open_sample();
    const Scene before = scene();
    const NodeId vase = named("Vase");
    select(vase);
    trigger(ActionId::FrameSelection);
    const dvec3 middle = scene().subtree_bounds(vase).centre();
    trigger(ActionId::Isolate);
    EXPECT_TRUE(window->action(ActionId::Isolate)->isChecked());
    settle();
    // A click beside the vase meets the room no more.
    QTest::mouseClick(&window->viewport(), Qt::LeftButton, {}, QPoint(12, 12));
    EXPECT_TRUE(window->document().selection()->nodes().empty());
    QTest::mouseClick(&window->viewport(), Qt::LeftButton, {}, at(middle));
    EXPECT_EQ(window->document().selection()->active(), vase);
    trigger(ActionId::Isolate);
    settle();
    QTest::mouseClick(&window->viewport(), Qt::LeftButton, {}, QPoint(12, 12));
    EXPECT_FALSE(window->document().selection()->contains(vase));
    EXPECT_FALSE(window->document().selection()->nodes().empty());
    EXPECT_TRUE(scene() == before);
    EXPECT_EQ(entries(), 0);
}

TEST_F(EditingTest, CamerasAreSteppedThrough) {
    open_sample();
    trigger(ActionId::NextCamera);
    const dvec3 first(window->viewport().camera().to_world[3]);
    trigger(ActionId::FrameAll);
    trigger(ActionId::AddCamera);
    const dvec3 second(scene().world_matrix(window->document().selection()->active())[3]);
    ASSERT_GT(glm::length(first - second), 0.1);
    trigger(ActionId::NextCamera);
    EXPECT_LT(glm::length(dvec3(window->viewport().camera().to_world[3]) - second), 1e-6);
    trigger(ActionId::NextCamera);
    EXPECT_LT(glm::length(dvec3(window->viewport().camera().to_world[3]) - first), 1e-6) << "round again";
    trigger(ActionId::PreviousCamera);
    EXPECT_LT(glm::length(dvec3(window->viewport().camera().to_world[3]) - second), 1e-6);
}

TEST_F(EditingTest, LockKeepsAndUnlocks) {
    open_sample();
    const NodeId vase = named("Vase");
    select(vase);
    trigger(ActionId::Lock);
    EXPECT_TRUE(node(vase).locked);
    trigger(ActionId::Cut);
    EXPECT_TRUE(scene().nodes.contains(vase));
    trigger(ActionId::Lock);
    EXPECT_FALSE(node(vase).locked);
}

} // namespace
} // namespace atrium::ui
