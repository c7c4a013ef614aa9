// Photometric files in the editor: chosen, dropped onto lamps and beside them, shown, dimmed, taken away; one undo entry
// each.
#include "engine/io/ies_reader.h"
#include "engine/scene/photometric_web.h"
#include "ui/document/sample_room.h"
#include "ui/panels/photometry_box.h"
#include "ui/panels/polar_diagram.h"
#include "ui/viewport/markers.h"
#include "ui/window/photometry_controller.h"
#include "window_fixture.h"

#include <QDragEnterEvent>
#include <QFileDialog>
#include <QLabel>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>

namespace atrium::ui {
namespace {

const QString kDownlight = QStringLiteral(ATRIUM_SOURCE_DIR "/scenes/luminaires/narrow_downlight.ies");
const QString kWasher = QStringLiteral(ATRIUM_SOURCE_DIR "/scenes/luminaires/wall_washer.ies");

class PhotometryTest : public WindowTest {
protected:
    const Light& light_of(const std::string& name) { return *scene().lights.find(node(named(name)).light); }
    /// From the file manager onto a point of the view. False where the window takes no such thing.
    bool drop(const QString& path, const QPoint& point) {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(path)});
        const QPoint at = window->viewport().mapTo(window.get(), point);
        QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(window.get(), &enter);
        if (!enter.isAccepted()) {
            return false;
        }
        QDropEvent event(QPointF(at), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(window.get(), &event);
        return true;
    }
    void wait_for_entries(int count) {
        EXPECT_TRUE(QTest::qWaitFor([&] { return entries() == count; }, 5000)) << entries();
        settle();
    }
    QString words() {
        auto* label = window->findChild<QLabel*>(QStringLiteral("photometry_words"));
        return label->isVisibleTo(window.get()) ? label->text() : QString();
    }
};

TEST_F(PhotometryTest, AssignedShownDimmedAndRemoved) {
    open_sample();
    const NodeId spot = named("Wall spot");
    select(spot);
    settle();
    EXPECT_TRUE(words().isEmpty());
    EXPECT_TRUE(field("Beam angle")->isVisibleTo(window.get()));
    window->photometry().assign(kDownlight, {node(spot).light});
    wait_for_entries(1);
    ASSERT_TRUE(light_of("Wall spot").photometry);
    EXPECT_EQ(light_of("Wall spot").color, Rgb(1.0F, 0.86F, 0.68F)) << "the colour stays";
    EXPECT_TRUE(words().contains(QStringLiteral("narrow_downlight.ies"))) << words().toStdString();
    EXPECT_TRUE(words().contains(QStringLiteral("800 lm"))) << words().toStdString();
    EXPECT_TRUE(words().contains(QStringLiteral("beam 21°"))) << words().toStdString();
    EXPECT_FALSE(window->findChild<NumberField*>(QStringLiteral("Beam angle"))->isVisibleTo(window.get()));
    EXPECT_TRUE(window->findChild<PolarDiagram*>()->isVisibleTo(window.get()));

    type(field("Dimming"), "40 %");
    const Light& light = light_of("Wall spot");
    EXPECT_NEAR(light.intensity, 0.4F * light.photometry->peak(), 1e-3F * light.intensity);
    type(field("Flux"), "300 lm");
    EXPECT_NEAR(flux_of(light_of("Wall spot")), 300.0, 0.01);
    EXPECT_EQ(entries(), 3);

    window->findChild<QPushButton*>(QStringLiteral("photometry_remove"))->click();
    settle();
    EXPECT_FALSE(light_of("Wall spot").photometry);
    EXPECT_NEAR(flux_of(light_of("Wall spot")), 300.0, 0.01) << "the flux stays";
    EXPECT_TRUE(words().isEmpty());
    EXPECT_EQ(entries(), 4);
    for (int i = 0; i < 4; ++i) {
        trigger(ActionId::Undo);
    }
    EXPECT_TRUE(scene() == sample_room());
}

TEST_F(PhotometryTest, DroppedOntoALampAndBesideIt) {
    open_sample();
    const NodeId spot = named("Wall spot");
    select(spot); // a marker that something hides can be dropped on while it is selected
    settle();
    const std::size_t nodes = scene().nodes.size();
    ASSERT_TRUE(drop(kWasher, at(dvec3(scene().world_matrix(spot)[3]))));
    wait_for_entries(1);
    EXPECT_EQ(scene().nodes.size(), nodes);
    ASSERT_TRUE(light_of("Wall spot").photometry);
    EXPECT_EQ(light_of("Wall spot").photometry->data().file_name, "wall_washer.ies");

    // On the floor: a lamp that hangs above, within the room, and shines down.
    const dvec3 floor(-0.9, 0.0, -1.2);
    ASSERT_TRUE(window->viewport().rect().contains(at(floor)));
    ASSERT_TRUE(drop(kDownlight, at(floor)));
    wait_for_entries(2);
    ASSERT_EQ(scene().nodes.size(), nodes + 1);
    const NodeId added = window->document().selection()->active();
    EXPECT_EQ(node(added).name, "narrow_downlight");
    EXPECT_TRUE(scene().lights.find(node(added).light)->photometry);
    const dvec3 place(scene().world_matrix(added)[3]);
    const DBox3 room = scene().bounds();
    EXPECT_GT(place.y, 1.5);
    EXPECT_LT(place.y, room.max.y);
    const dvec3 axis = -dvec3(scene().world_matrix(added)[2]);
    EXPECT_NEAR(axis.y, -1.0, 1e-6);
    trigger(ActionId::Undo);
    trigger(ActionId::Undo);
    EXPECT_TRUE(scene() == sample_room());
}

TEST_F(PhotometryTest, AddedFromTheMenuEvenWithoutAScene) {
    trigger(ActionId::AddLuminaire);
    auto* files = dialog<QFileDialog>();
    ASSERT_NE(files, nullptr);
    files->selectFile(kWasher);
    Q_EMIT files->fileSelected(kWasher);
    files->reject();
    wait_for_entries(1);
    EXPECT_TRUE(window->viewport().isVisible()) << "the start page went";
    const Light* light = scene().lights.find(node(window->document().selection()->active()).light);
    ASSERT_NE(light, nullptr);
    EXPECT_TRUE(light->photometry);
    EXPECT_NEAR(scene().world_matrix(window->document().selection()->active())[3].y, 2.2, 1e-9);
}

TEST_F(PhotometryTest, AFileThatCannotBeReadChangesNothing) {
    open_sample();
    const QString path = folder.filePath(QStringLiteral("damaged.ies"));
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n10\n");
    file.close();
    window->photometry().assign(path, {node(named("Wall spot")).light});
    auto* box = dialog<QMessageBox>();
    ASSERT_NE(box, nullptr);
    EXPECT_TRUE(box->text().contains(QStringLiteral("damaged.ies")));
    EXPECT_TRUE(box->informativeText().contains(QStringLiteral("line 8"))) << box->informativeText().toStdString();
    box->accept();
    EXPECT_EQ(entries(), 0);
    QMimeData text;
    text.setUrls({QUrl::fromLocalFile(QStringLiteral("/tmp/notes.txt"))});
    EXPECT_FALSE(drop(QStringLiteral("/tmp/notes.txt"), {10, 10}));
}

TEST_F(PhotometryTest, TheDiagramShowsTheLobe) {
    const auto web = read_ies(kWasher.toStdString()).value().web;
    Light light;
    set_photometry(light, web);
    PolarDiagram diagram;
    diagram.set_photometry(light.photometry);
    diagram.resize(300, 190);
    QPixmap empty(300, 190), full(300, 190);
    empty.fill(Qt::white);
    full.fill(Qt::white);
    PolarDiagram none;
    none.resize(300, 190);
    none.render(&empty);
    diagram.render(&full);
    // Towards C90, which is to the right: ink there that the mirrored place does not have.
    const QImage image = full.toImage(), blank = empty.toImage();
    int right = 0, left = 0;
    for (int y = 30; y < 140; ++y) {
        for (int x = 1; x < 120; ++x) {
            right += image.pixel(150 + x, y) != blank.pixel(150 + x, y) ? 1 : 0;
            left += image.pixel(150 - x, y) != blank.pixel(150 - x, y) ? 1 : 0;
        }
    }
    EXPECT_GT(right, left + 100) << left;
}

// Seen along -z, +y up; the lamp hangs with its C90 towards the eye's left.
TEST(PhotometryMarker, TheSelectedLampShowsItsLight) {
    Scene scene;
    Light light;
    set_photometry(light, read_ies(kWasher.toStdString()).value().web);
    Node lamp;
    lamp.light = scene.lights.insert(light);
    // -z down, +y (C90) to -x.
    lamp.transform.rotation = glm::angleAxis(kPiD / 2, dvec3(0, 1, 0)) * glm::angleAxis(-kPiD / 2, dvec3(1, 0, 0));
    const NodeId id = scene.nodes.insert(lamp);
    scene.roots.push_back(id);
    CameraController camera;
    camera.set_viewport(800, 600);
    ViewCamera view;
    view.to_world[3] = dvec4(0, 0, 4, 1);
    camera.set_camera(view);
    const auto markers = find_markers(scene);
    ASSERT_EQ(markers.size(), 1U);
    const dvec2 middle = *camera.project(markers[0].position);
    const auto reach = [&](bool selected) {
        OverlayBatch batch;
        draw_markers(batch, markers, camera, [&](NodeId) { return selected; }, {});
        vec2 low(1e9F), high(-1e9F);
        for (const OverlayVertex& v : batch.vertices()) {
            low = glm::min(low, v.position - vec2(middle));
            high = glm::max(high, v.position - vec2(middle));
        }
        return std::pair(low, high);
    };
    const auto [low, high] = reach(true);
    // The lobe points down and to C90 at 37 degrees, 110 pixels long.
    EXPECT_NEAR(double(high.y), 110 * std::cos(radians_from_degrees(36)), 10.0);
    EXPECT_NEAR(double(low.x), -110 * std::sin(radians_from_degrees(38)), 10.0);
    EXPECT_LT(double(high.x), 20.0);
    EXPECT_GT(double(low.y), -20.0) << "nothing upwards";
    EXPECT_LT(double(reach(false).second.y), 45.0) << "a small cone while it is not selected";
}

TEST_F(PhotometryTest, SavedAndOpenedAgain) {
    open_sample();
    window->photometry().assign(kWasher, {node(named("Wall spot")).light});
    wait_for_entries(1);
    const Light before = light_of("Wall spot");
    const QString path = folder.filePath(QStringLiteral("room.atrium"));
    bool saved = false;
    window->files().save_to(path, [&](bool good) { saved = good; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return saved; }, 20000));
    window->files().open(path);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window->files().busy() && entries() == 0; }, 20000));
    settle();
    EXPECT_EQ(light_of("Wall spot"), before);
}

} // namespace
} // namespace atrium::ui
