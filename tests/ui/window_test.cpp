#include "window_fixture.h"

#include "engine/io/image_file.h"
#include "engine/io/scene_file.h"
#include "ui/document/sample_room.h"
#include "ui/panels/number_field.h"
#include "ui/tools/gizmo.h"
#include "ui/window/export_picture_dialog.h"

#include <QCheckBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDragEnterEvent>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalSpy>
#include <QStackedWidget>
#include <QToolButton>
#include <QTreeView>
#include <QWheelEvent>

#include <cstdio>

namespace atrium::ui {
namespace {

TEST_F(WindowTest, StartPageOpensTheSampleRoom) {
    auto* button = window->findChild<QToolButton*>(QStringLiteral("start_sample"));
    ASSERT_NE(button, nullptr);
    EXPECT_TRUE(button->isVisible());
    QTest::mouseClick(button, Qt::LeftButton);
    settle();
    EXPECT_FALSE(button->isVisible());
    EXPECT_TRUE(window->viewport().isVisible());
    EXPECT_EQ(scene().nodes.size(), sample_room().nodes.size());
    EXPECT_FALSE(window->isWindowModified());
}

TEST_F(WindowTest, OpensAFileInTheBackgroundWithoutStalling) {
    const QString path = folder.filePath(QStringLiteral("room.glb"));
    ASSERT_TRUE(write_scene(path.toStdString(), sample_room()));
    QSignalSpy opened(&window->files(), &FileController::opened);
    Watchdog watchdog;
    window->files().open(path);
    EXPECT_TRUE(window->files().busy());
    EXPECT_TRUE(scene().nodes.empty()) << "the answer comes later";
    ASSERT_TRUE(opened.wait(10000));
    settle();
    std::printf("[ stall    ] opening the sample room: %.0f ms at worst\n", watchdog.longest_stall_ms());
    EXPECT_EQ(scene().nodes.size(), sample_room().nodes.size());
    EXPECT_EQ(window->document().path(), path);
    EXPECT_TRUE(window->windowTitle().contains(QStringLiteral("room.glb")));
}

TEST_F(WindowTest, ABrokenFileLeavesTheDocumentAlone) {
    open_sample();
    const Scene before = scene();
    const QString path = folder.filePath(QStringLiteral("broken.gltf"));
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("{\"asset\": ");
    file.close();
    window->files().open(path);
    auto* box = dialog<QMessageBox>();
    ASSERT_NE(box, nullptr);
    EXPECT_TRUE(box->informativeText().contains(QStringLiteral("broken.gltf"))) << box->informativeText().toStdString();
    QTest::keyClick(box, Qt::Key_Return);
    settle();
    EXPECT_TRUE(scene() == before);
}

TEST_F(WindowTest, TreeSelectsBothWaysAndRenamesInPlace) {
    open_sample();
    const NodeId bowl = named("Bowl");
    QTreeView* view = window->tree().view();
    view->expandAll();
    const QModelIndex index = window->tree().view_index(bowl);
    ASSERT_TRUE(index.isValid());
    view->scrollTo(index);
    QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, view->visualRect(index).center());
    EXPECT_EQ(window->document().selection()->active(), bowl);

    select(named("Vase"));
    EXPECT_TRUE(view->selectionModel()->isSelected(window->tree().view_index(named("Vase"))));
    EXPECT_FALSE(view->selectionModel()->isSelected(window->tree().view_index(bowl)));

    select(bowl);
    trigger(ActionId::Rename);
    auto* editor = view->viewport()->findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    type(editor, "Salad bowl");
    EXPECT_EQ(node(bowl).name, "Salad bowl");
    EXPECT_EQ(entries(), 1);
    trigger(ActionId::Undo);
    EXPECT_EQ(node(bowl).name, "Bowl");
}

TEST_F(WindowTest, EyeColumnHidesAndFilterFinds) {
    open_sample();
    const NodeId shelf = named("Shelf");
    QTreeView* view = window->tree().view();
    const QModelIndex eye = window->tree().view_index(shelf).siblingAtColumn(1);
    view->scrollTo(eye);
    QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, view->visualRect(eye).center());
    EXPECT_FALSE(node(shelf).visible);
    EXPECT_EQ(entries(), 1);
    trigger(ActionId::ShowAll);
    EXPECT_TRUE(node(shelf).visible);

    auto* filter = window->findChild<QLineEdit*>(QStringLiteral("tree_filter"));
    filter->setFocus();
    QTest::keyClicks(filter, QStringLiteral("vas"));
    EXPECT_TRUE(window->tree().view_index(named("Vase")).isValid());
    EXPECT_FALSE(window->tree().view_index(shelf).isValid());
}

TEST_F(WindowTest, NumberFieldsTakeUnitsAndLeaveOneEntryEach) {
    open_sample();
    const NodeId shelf = named("Shelf");
    select(shelf);
    NumberField* x = field("Position X");
    type(x, "1 m 25 cm");
    EXPECT_NEAR(node(shelf).transform.translation.x, 1.25, 1e-12);
    type(x, "1,5");
    EXPECT_NEAR(node(shelf).transform.translation.x, 1.5, 1e-12);
    EXPECT_EQ(entries(), 2);
    EXPECT_TRUE(window->isWindowModified());

    type(x, "3 apples");
    EXPECT_NEAR(node(shelf).transform.translation.x, 1.5, 1e-12) << "a bad entry changes nothing";
    EXPECT_TRUE(x->toolTip().contains(QStringLiteral("apples")));
    EXPECT_EQ(entries(), 2);
    QTest::keyClick(x, Qt::Key_Escape);
    EXPECT_EQ(x->text(), QStringLiteral("1.5 m"));

    type(field("Rotation Y"), "90");
    const dvec3 turned = node(shelf).transform.rotation * dvec3(1, 0, 0);
    EXPECT_NEAR(turned.z, -1, 1e-12);
    type(field("Width (X)"), "50 cm");
    EXPECT_FLOAT_EQ(std::get<Box>(scene().shapes.find(node(shelf).shape)->geometry).size.x, 0.5F);
    EXPECT_EQ(entries(), 4);
    for (int i = 0; i < 4; ++i) {
        trigger(ActionId::Undo);
    }
    EXPECT_TRUE(scene() == sample_room());
    EXPECT_FALSE(window->isWindowModified());
}

TEST_F(WindowTest, WheelChangesOnlyTheFocusedField) {
    open_sample();
    const NodeId shelf = named("Shelf");
    select(shelf);
    NumberField* y = field("Position Y");
    window->tree().view()->setFocus();
    const auto wheel = [y](int delta) {
        QWheelEvent event(QPointF(5, 5), y->mapToGlobal(QPointF(5, 5)), {}, {0, delta}, Qt::NoButton, {}, Qt::NoScrollPhase,
                          false);
        QApplication::sendEvent(y, &event);
    };
    const double before = node(shelf).transform.translation.y;
    wheel(120);
    EXPECT_DOUBLE_EQ(node(shelf).transform.translation.y, before);
    EXPECT_EQ(entries(), 0);
    y->setFocus();
    for (int i = 0; i < 4; ++i) {
        wheel(120);
    }
    EXPECT_NEAR(node(shelf).transform.translation.y, before + 0.2, 1e-9);
    window->tree().view()->setFocus(); // ends the burst
    EXPECT_EQ(entries(), 1);
}

TEST_F(WindowTest, DraggingAFieldsLabelIsOneEntryAndEscRollsBack) {
    open_sample();
    const NodeId shelf = named("Shelf");
    select(shelf);
    NumberField* x = field("Position X");
    QLabel* label = nullptr;
    for (QLabel* candidate : window->findChildren<QLabel*>()) {
        if (candidate->buddy() == x) {
            label = candidate;
        }
    }
    ASSERT_NE(label, nullptr);
    const auto move = [label](int pixels) {
        const QPointF at(2 + pixels, 4);
        QMouseEvent event(QEvent::MouseMove, at, label->mapToGlobal(at), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(label, &event);
    };
    const double before = node(shelf).transform.translation.x;
    QTest::mousePress(label, Qt::LeftButton, {}, {2, 4});
    for (int i = 1; i <= 40; ++i) {
        move(i);
    }
    EXPECT_EQ(entries(), 0);
    QTest::mouseRelease(label, Qt::LeftButton, {}, {42, 4});
    EXPECT_EQ(entries(), 1);
    EXPECT_NEAR(node(shelf).transform.translation.x, before + 0.25, 1e-9) << "eight pixels a step of 5 cm";
    settle();
    QTest::mousePress(label, Qt::LeftButton, {}, {2, 4});
    move(80);
    EXPECT_GT(node(shelf).transform.translation.x, before + 0.5);
    QTest::keyClick(x, Qt::Key_Escape);
    QTest::mouseRelease(label, Qt::LeftButton, {}, {82, 4});
    EXPECT_NEAR(node(shelf).transform.translation.x, before + 0.25, 1e-9);
    EXPECT_EQ(entries(), 1);
    settle();
    QTest::keyClick(x, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(scene() == sample_room()) << "undo reaches the document from a field with nothing half typed";
}

TEST_F(WindowTest, SeveralObjectsShowMixedValuesAndChangeTogether) {
    open_sample();
    const NodeId bowl = named("Bowl");
    const NodeId vase = named("Vase");
    window->document().selection()->set({bowl, vase});
    NumberField* x = field("Position X");
    EXPECT_TRUE(x->mixed());
    EXPECT_TRUE(x->text().isEmpty());
    type(x, "0.1");
    EXPECT_NEAR(scene().world_matrix(bowl)[3].x, 0.1, 1e-12);
    EXPECT_NEAR(scene().world_matrix(vase)[3].x, 0.1, 1e-12) << "it stands in a group, and is told from the scene";
    EXPECT_EQ(entries(), 1);
    type(field("Roughness"), "0.3");
    EXPECT_FLOAT_EQ(scene().material_of(node(bowl), 0)->roughness, 0.3F);
    EXPECT_FLOAT_EQ(scene().material_of(node(vase), 0)->roughness, 0.3F);
    EXPECT_EQ(entries(), 2);
}

TEST_F(WindowTest, MaterialAndLampFields) {
    open_sample();
    const NodeId bowl = named("Bowl");
    select(bowl);
    type(field("Reflectance"), "50 %");
    EXPECT_NEAR(luminance(scene().material_of(node(bowl), 0)->base_color), 0.5F, 1e-4F);
    type(field("Luminance"), "2 kcd/m2");
    EXPECT_NEAR(luminance(scene().material_of(node(bowl), 0)->emitted_radiance()), 2000.0F, 0.5F);
    EXPECT_EQ(entries(), 2);

    const NodeId spot = named("Wall spot");
    select(spot);
    type(field("Intensity"), "1,2 kcd");
    EXPECT_FLOAT_EQ(scene().lights.find(node(spot).light)->intensity, 1200.0F);
    type(field("Outer angle"), "80");
    EXPECT_NEAR(scene().lights.find(node(spot).light)->outer_cone, 40 * kPi / 180, 1e-6F);
}

TEST_F(WindowTest, SharedMaterialBecomesUnique) {
    open_sample();
    const NodeId leg = named("Leg 1");
    select(leg);
    settle();
    const MaterialId shared = node(leg).materials.front();
    auto* button = window->findChild<QPushButton*>(QStringLiteral("material_unique"));
    ASSERT_TRUE(button != nullptr && button->isVisibleTo(window.get()));
    button->click();
    settle();
    EXPECT_NE(node(leg).materials.front(), shared);
    EXPECT_EQ(node(named("Leg 2")).materials.front(), shared);
    type(field("Roughness"), "0.9");
    EXPECT_FLOAT_EQ(scene().materials.find(shared)->roughness, 0.35F);
    trigger(ActionId::Undo);
    trigger(ActionId::Undo);
    EXPECT_TRUE(scene() == sample_room());
}

TEST_F(WindowTest, DeleteDuplicateGroupHideByKeys) {
    open_sample();
    const std::size_t count = scene().nodes.size();
    window->viewport().setFocus();
    select(named("Table"));
    QTest::keyClick(&window->viewport(), Qt::Key_D, Qt::ControlModifier);
    EXPECT_EQ(scene().nodes.size(), count + 8) << "the table with five parts and two things on it";
    EXPECT_EQ(node(window->document().selection()->active()).name, "Table 2");
    QTest::keyClick(&window->viewport(), Qt::Key_Delete);
    EXPECT_EQ(scene().nodes.size(), count);
    EXPECT_TRUE(window->document().selection()->nodes().empty());
    window->document().selection()->set({named("Bowl"), named("Vase")});
    QTest::keyClick(&window->viewport(), Qt::Key_G, Qt::ControlModifier);
    EXPECT_EQ(node(named("Bowl")).parent, named("Group"));
    QTest::keyClick(&window->viewport(), Qt::Key_H);
    EXPECT_FALSE(scene().shown(named("Bowl")));
    EXPECT_EQ(entries(), 4);
    for (int i = 0; i < 4; ++i) {
        QTest::keyClick(&window->viewport(), Qt::Key_Z, Qt::ControlModifier);
    }
    EXPECT_TRUE(scene() == sample_room());
}

TEST_F(WindowTest, AddsEveryKindOfObject) {
    open_sample();
    int expected = 0;
    for (const ActionId id : {ActionId::AddPolygon, ActionId::AddBox, ActionId::AddSphere, ActionId::AddCylinder,
                              ActionId::AddCone, ActionId::AddDisc, ActionId::AddPointLight, ActionId::AddSpotLight,
                              ActionId::AddSun, ActionId::AddAreaLight, ActionId::AddCamera}) {
        const std::size_t before = scene().nodes.size();
        trigger(id);
        EXPECT_EQ(scene().nodes.size(), before + 1) << int(id);
        EXPECT_EQ(entries(), ++expected);
        const NodeId added = window->document().selection()->active();
        ASSERT_TRUE(scene().nodes.contains(added));
        EXPECT_TRUE(node(added).shape || node(added).light || node(added).camera);
        settle(); // the panel shows it
    }
    while (window->document().undo_stack()->canUndo()) {
        trigger(ActionId::Undo);
    }
    EXPECT_TRUE(scene() == sample_room());
}

TEST_F(WindowTest, ClickInTheViewSelects) {
    open_sample();
    const NodeId bowl = named("Bowl");
    const dvec3 centre = dvec3(scene().world_matrix(bowl)[3]);
    window->viewport().set_camera(
        {glm::inverse(glm::lookAt(centre + dvec3(0, 0.3, 1.5), centre, dvec3(0, 1, 0))), Camera{}});
    settle();
    QTest::mouseClick(&window->viewport(), Qt::LeftButton, {}, at(centre) + QPoint(7, 4));
    settle();
    EXPECT_EQ(window->document().selection()->active(), bowl);
    EXPECT_TRUE(window->tree().view()->selectionModel()->isSelected(window->tree().view_index(bowl)));
}

TEST_F(WindowTest, GizmoDragIsOneEntry) {
    open_sample();
    const NodeId bowl = named("Bowl");
    const dvec3 centre = dvec3(scene().world_matrix(bowl)[3]);
    window->viewport().set_camera(
        {glm::inverse(glm::lookAt(centre + dvec3(0, 0.3, 1.5), centre, dvec3(0, 1, 0))), Camera{}});
    select(bowl);
    trigger(ActionId::ToolMove);
    settle();
    const double length = Gizmo::kLength * pixel_size(centre);
    Watchdog watchdog;
    drag(at(centre + dvec3(0.8 * length, 0, 0)), at(centre + dvec3(0.8 * length + 0.2, 0, 0)));
    std::printf("[ stall    ] dragging in the sample room: %.0f ms at worst\n", watchdog.longest_stall_ms());
    EXPECT_EQ(entries(), 1);
    EXPECT_NEAR(node(bowl).transform.translation.x, 0.35 + 0.2, 0.06);
    EXPECT_DOUBLE_EQ(node(bowl).transform.translation.y, 0.871);
    trigger(ActionId::Undo);
    EXPECT_TRUE(scene() == sample_room());
    trigger(ActionId::Redo);
    EXPECT_NEAR(node(bowl).transform.translation.x, 0.35 + 0.2, 0.06);
}

TEST_F(WindowTest, SavesAndReopensAnEqualSceneWithItsLight) {
    open_sample();
    const NodeId shelf = named("Shelf");
    select(shelf);
    type(field("Position Z"), "-1.2 m");
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window->engine().stale(); }, 60000)) << "the light was not finished";
    const QString path = folder.filePath(QStringLiteral("saved.atrium"));
    bool saved = false;
    window->files().save_to(path, [&](bool ok) { saved = ok; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return saved; }, 10000));
    EXPECT_FALSE(window->isWindowModified());
    EXPECT_EQ(window->document().path(), path);
    const Scene before = scene();
    window->files().new_scene();
    EXPECT_TRUE(scene().nodes.empty());
    QSignalSpy opened(&window->files(), &FileController::opened);
    window->files().open(path);
    ASSERT_TRUE(opened.wait(10000));
    ASSERT_EQ(scene().nodes.size(), before.nodes.size());
    EXPECT_DOUBLE_EQ(node(named("Shelf")).transform.translation.z, -1.2);
    for (const NodeId id : before.in_tree_order()) {
        const Node& old = *before.nodes.find(id);
        const Node& now = node(named(old.name));
        EXPECT_EQ(now.transform, old.transform) << old.name;
        EXPECT_EQ(bool(now.shape), bool(old.shape));
        if (old.shape) {
            EXPECT_EQ(scene().shapes.find(now.shape)->geometry, before.shapes.find(old.shape)->geometry) << old.name;
        }
    }
    ASSERT_TRUE(window->engine().solution()) << "the stored light is shown at once";
    EXPECT_TRUE(window->engine().solution()->final);
}

TEST_F(WindowTest, ClosingAsksForUnsavedChanges) {
    open_sample();
    select(named("Shelf"));
    type(field("Position X"), "2");
    window->close();
    auto* box = dialog<QMessageBox>("save_changes");
    ASSERT_NE(box, nullptr);
    EXPECT_TRUE(window->isVisible());
    box->button(QMessageBox::Cancel)->click();
    settle();
    EXPECT_TRUE(window->isVisible());
    window->close();
    box = dialog<QMessageBox>("save_changes");
    ASSERT_NE(box, nullptr);
    box->button(QMessageBox::Discard)->click();
    EXPECT_TRUE(QTest::qWaitFor([&] { return !window->isVisible(); }));
}

TEST_F(WindowTest, RecoversAfterAKill) {
    open_sample();
    window->recovery().set_limits(1000000, 1);
    QSignalSpy written(&window->recovery(), &Recovery::written);
    select(named("Shelf"));
    type(field("Position X"), "1.75");
    ASSERT_TRUE(written.count() > 0 || written.wait(10000));
    window.reset(); // without closing: nothing is cleared, as after a kill
    window = std::make_unique<MainWindow>(folder.filePath(QStringLiteral("recovery")));
    window->show();
    window->files().offer_recovery();
    auto* box = dialog<QDialog>("recovery");
    ASSERT_NE(box, nullptr);
    QSignalSpy opened(&window->files(), &FileController::opened);
    QTest::mouseClick(box->findChild<QPushButton*>(QStringLiteral("recover")), Qt::LeftButton);
    ASSERT_TRUE(opened.wait(10000));
    EXPECT_DOUBLE_EQ(node(named("Shelf")).transform.translation.x, 1.75);
    EXPECT_TRUE(window->isWindowModified()) << "recovered work is not saved yet";
    EXPECT_EQ(window->recovery().orphans().size(), 1U) << "the recovered file stays until it is";
    bool saved = false;
    window->files().save_to(folder.filePath(QStringLiteral("back.atrium")), [&](bool ok) { saved = ok; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return saved; }, 10000));
    EXPECT_TRUE(window->recovery().orphans().empty());
}

TEST_F(WindowTest, RendersAPictureOfTheView) {
    open_sample();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window->engine().solution() != nullptr; }, 60000));
    settle();
    trigger(ActionId::ExportPicture);
    auto* settings = dialog<ExportPictureDialog>();
    ASSERT_NE(settings, nullptr);
    const auto fields = settings->findChildren<NumberField*>();
    ASSERT_EQ(fields.size(), 4);
    type(fields[0], "64");
    type(fields[1], "48");
    type(fields[2], "1");
    EXPECT_FALSE(fields[3]->isEnabled()) << "of the final pass alone";
    const QString path = folder.filePath(QStringLiteral("view.png"));
    settings->render(path);
    ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(path); }, 30000));
    const QImage picture(path);
    EXPECT_EQ(picture.size(), QSize(64, 48));
    int lit = 0;
    for (int x = 0; x < 64; ++x) {
        lit += picture.pixelColor(x, 24).lightness() > 20 ? 1 : 0;
    }
    EXPECT_GT(lit, 40) << "the room is lit";
}

TEST_F(WindowTest, RendersAFinalPassWithItsPartsAndStopsWhenAsked) {
    open_sample();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window->engine().solution() != nullptr; }, 60000));
    settle();
    trigger(ActionId::ExportPicture);
    auto* settings = dialog<ExportPictureDialog>();
    ASSERT_NE(settings, nullptr);
    const auto fields = settings->findChildren<NumberField*>();
    const auto boxes = settings->findChildren<QCheckBox*>();
    ASSERT_EQ(fields.size(), 4);
    ASSERT_EQ(boxes.size(), 2);
    boxes[0]->click();
    boxes[1]->click();
    EXPECT_TRUE(fields[3]->isEnabled());
    EXPECT_FALSE(fields[2]->isEnabled());
    type(fields[0], "64");
    type(fields[1], "48");
    type(fields[3], "4096");
    const QString stopped = folder.filePath(QStringLiteral("stopped.exr"));
    settings->render(stopped);
    auto* cancel = settings->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Cancel);
    QPushButton* start = nullptr;
    QTest::qWait(300);
    cancel->click();
    for (QAbstractButton* button : settings->findChild<QDialogButtonBox*>()->buttons()) {
        start = button == cancel ? start : qobject_cast<QPushButton*>(button);
    }
    ASSERT_TRUE(QTest::qWaitFor([&] { return start->isEnabled(); }, 20000));
    EXPECT_FALSE(QFile::exists(stopped));
    type(fields[3], "2");
    const QString path = folder.filePath(QStringLiteral("view.exr"));
    settings->render(path);
    ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(path); }, 60000));
    const auto image = read_image(path.toStdString());
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 64);
    EXPECT_GE(image->channels, 3);
}

TEST_F(WindowTest, ASceneFileDroppedOntoTheWindowOpens) {
    const QString path = folder.filePath(QStringLiteral("dropped.glb"));
    ASSERT_TRUE(write_scene(path.toStdString(), sample_room()));
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path)});
    QSignalSpy opened(&window->files(), &FileController::opened);
    QDragEnterEvent enter({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(window.get(), &enter);
    EXPECT_TRUE(enter.isAccepted());
    QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(window.get(), &drop);
    ASSERT_TRUE(opened.wait(10000));
    EXPECT_EQ(window->document().path(), path);
}

TEST_F(WindowTest, CommandSearchRunsWhatWasTyped) {
    open_sample();
    trigger(ActionId::Commands);
    auto* search = dialog<QDialog>("command_search");
    ASSERT_NE(search, nullptr);
    auto* text = search->findChild<QLineEdit*>();
    QTest::keyClicks(text, QStringLiteral("add a sphere"));
    QTest::keyClick(text, Qt::Key_Return);
    settle();
    EXPECT_EQ(entries(), 1);
    EXPECT_EQ(node(window->document().selection()->active()).name, "Sphere");
}

TEST_F(WindowTest, MovingRowsReparentsInPlace) {
    open_sample();
    const NodeId bowl = named("Bowl");
    const NodeId sofa = named("Sofa");
    const dmat4 place = scene().world_matrix(bowl);
    QAbstractItemModel* model = window->tree().view()->model();
    const std::unique_ptr<QMimeData> rows(model->mimeData({window->tree().view_index(bowl)}));
    ASSERT_TRUE(model->dropMimeData(rows.get(), Qt::MoveAction, -1, -1, window->tree().view_index(sofa)));
    EXPECT_EQ(node(bowl).parent, sofa);
    EXPECT_NEAR(scene().world_matrix(bowl)[3].x, place[3].x, 1e-12);
    EXPECT_EQ(entries(), 1);
    EXPECT_EQ(window->tree().view_index(bowl).parent(), window->tree().view_index(sofa));
    const std::unique_ptr<QMimeData> parent(model->mimeData({window->tree().view_index(sofa)}));
    EXPECT_FALSE(model->canDropMimeData(parent.get(), Qt::MoveAction, -1, -1, window->tree().view_index(bowl)))
        << "nothing goes below itself";
    trigger(ActionId::Undo);
    EXPECT_TRUE(scene() == sample_room());
    EXPECT_EQ(window->tree().view_index(bowl).parent(), window->tree().view_index(named("Table")));
}

TEST_F(WindowTest, ImportSuggestionIsOfferedAndUndoable) {
    Scene small = sample_room();
    // The sample room drawn in millimetres: every length a thousand times as large.
    for (const NodeId id : small.nodes.keys()) {
        small.nodes.find(id)->transform.translation *= 1000.0;
    }
    for (const ShapeId id : small.shapes.keys()) {
        std::visit(
            [](auto& g) {
                using G = std::decay_t<decltype(g)>;
                if constexpr (std::is_same_v<G, Polygon>) {
                    for (vec2& p : g.outer) {
                        p *= 1000.0F;
                    }
                } else if constexpr (std::is_same_v<G, Box>) {
                    g.size *= 1000.0F;
                } else if constexpr (std::is_same_v<G, Sphere> || std::is_same_v<G, Disc>) {
                    g.radius *= 1000.0F;
                } else if constexpr (std::is_same_v<G, Cylinder>) {
                    g.radius *= 1000.0F;
                    g.height *= 1000.0F;
                } else if constexpr (std::is_same_v<G, Cone>) {
                    g.base_radius *= 1000.0F;
                    g.top_radius *= 1000.0F;
                    g.height *= 1000.0F;
                }
            },
            small.shapes.find(id)->geometry);
    }
    const QString path = folder.filePath(QStringLiteral("millimetres.glb"));
    ASSERT_TRUE(write_scene(path.toStdString(), small));
    QSignalSpy opened(&window->files(), &FileController::opened);
    window->files().open(path);
    ASSERT_TRUE(opened.wait(10000));
    settle();
    auto* fix = window->findChild<QPushButton*>(QStringLiteral("import_fix"));
    ASSERT_TRUE(fix->isVisible());
    EXPECT_GT(scene().bounds().size().x, 1000) << "nothing is changed without being asked";
    QTest::mouseClick(fix, Qt::LeftButton);
    settle();
    EXPECT_NEAR(scene().bounds().size().x, 5, 0.01);
    EXPECT_EQ(entries(), 1);
    trigger(ActionId::Undo);
    EXPECT_GT(scene().bounds().size().x, 1000);
}

TEST_F(WindowTest, IconsAreSeenOnLightAndOnDark) {
    const QPalette before = QApplication::palette();
    const auto lightness = [this] {
        const QImage icon = window->action(ActionId::Open)->icon().pixmap(32, 32).toImage();
        double sum = 0;
        double weight = 0;
        for (int y = 0; y < icon.height(); ++y) {
            for (int x = 0; x < icon.width(); ++x) {
                const QColor pixel = icon.pixelColor(x, y);
                sum += double(pixel.lightnessF()) * double(pixel.alphaF());
                weight += double(pixel.alphaF());
            }
        }
        EXPECT_GT(weight, 10);
        return sum / weight;
    };
    QPalette palette = before;
    palette.setColor(QPalette::WindowText, Qt::black);
    QApplication::setPalette(palette);
    EXPECT_LT(lightness(), 0.2);
    palette.setColor(QPalette::WindowText, Qt::white);
    QApplication::setPalette(palette);
    EXPECT_GT(lightness(), 0.8);
    QApplication::setPalette(before);
}

TEST_F(WindowTest, LayersOfLightCanBeLeftOutAndThatIsRemembered) {
    auto* view = window->findChild<ViewportWidget*>();
    ASSERT_NE(view, nullptr);
    EXPECT_TRUE(view->light_shares() == LightShares{});
    trigger(ActionId::ShowDirect);
    EXPECT_TRUE(view->light_shares() == (LightShares{true, false}));
    trigger(ActionId::ShowDiffuse);
    EXPECT_TRUE(view->light_shares() == (LightShares{false, false, true}));
    trigger(ActionId::ShowCaustic); // nothing would be left: the others come back
    EXPECT_TRUE(view->light_shares() == (LightShares{true, true, false}));
    EXPECT_TRUE(window->action(ActionId::ShowDirect)->isChecked());
    TearDown();
    SetUp();
    view = window->findChild<ViewportWidget*>();
    EXPECT_TRUE(view->light_shares() == (LightShares{true, true, false}));
    EXPECT_FALSE(window->action(ActionId::ShowCaustic)->isChecked());
    trigger(ActionId::ShowCaustic);
    EXPECT_TRUE(view->light_shares() == LightShares{});
}

TEST_F(WindowTest, EveryActionHasTextTipAndItsOwnKey) {
    QStringList keys;
    for (const ActionInfo& info : action_table()) {
        const QAction* action = window->action(info.id);
        EXPECT_FALSE(action->text().isEmpty()) << info.key;
        EXPECT_FALSE(action->statusTip().isEmpty()) << info.key;
        EXPECT_EQ(action->icon().isNull(), info.icon[0] == '\0') << info.key;
        const QString key = action->shortcut().toString();
        if (!key.isEmpty()) {
            EXPECT_FALSE(keys.contains(key)) << info.key << " repeats " << key.toStdString();
            keys += key;
        }
    }
    for (const QWidget* widget : window->findChildren<NumberField*>()) {
        EXPECT_FALSE(widget->accessibleName().isEmpty()) << widget->objectName().toStdString();
    }
}

} // namespace
} // namespace atrium::ui
