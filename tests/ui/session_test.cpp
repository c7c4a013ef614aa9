// A session as an architect has it, by mouse and keys, in a process of its own that is killed at the end; then recovery.
// Says what held the window for longer than a frame. ATRIUM_SCREENSHOTS=FOLDER leaves pictures there.
#include "timed_application.h"
#include "window_fixture.h"

#include "engine/io/scene_file.h"
#include "ui/document/insert_commands.h"
#include "ui/document/scene_mime.h"
#include "ui/panels/caustic_panel.h"
#include "ui/panels/library_panel.h"
#include "ui/window/recovery_dialog.h"

#include <QAbstractItemModel>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QLineEdit>
#include <QListView>
#include <QProcess>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableView>

#include <csignal>
#include <unistd.h>

namespace atrium::ui {
namespace {

constexpr char kFolder[] = "ATRIUM_SESSION_FOLDER";
constexpr int kLightMs = 240000; // a patience, not a measurement

QString session_folder() { return QString::fromLocal8Bit(qgetenv(kFolder)); }
QString in_session(const char* name) { return session_folder() + QLatin1Char('/') + QLatin1StringView(name); }

class SessionWork : public WindowTest {
protected:
    void SetUp() override {
        if (session_folder().isEmpty()) {
            GTEST_SKIP() << "part of Session.SurvivesAKill";
        }
        window = std::make_unique<MainWindow>(in_session("recovery"));
        window->resize(1360, 860);
        window->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(window.get()));
        QApplication::setActiveWindow(window.get());
        application().start();
    }
    static TimedApplication& application() { return *static_cast<TimedApplication*>(QCoreApplication::instance()); }
    void step(const char* what) {
        application().set_activity(what);
        std::printf("[ session  ] %s\n", what);
        std::fflush(stdout);
    }
    void picture(const char* name) {
        if (const QByteArray to = qgetenv("ATRIUM_SCREENSHOTS"); !to.isEmpty()) {
            window->grab().save(QString::fromLocal8Bit(to) + QLatin1Char('/') + QLatin1StringView(name));
        }
    }
    bool wait_for_light() {
        return QTest::qWaitFor([this] { return window->engine().solution() && !window->engine().stale(); }, kLightMs);
    }
    void keys(Qt::Key key, Qt::KeyboardModifiers held = {}) {
        QApplication::setActiveWindow(window.get()); // after a dialog nobody gives the focus back: no window manager here
        QTest::keyClick(&window->viewport(), key, held);
        settle();
    }
    /// Picks an entry in the library and drags it over the view, as the window system reports a drag.
    void drag_from_library(const char* search, const char* key, const QPoint& to) {
        auto* field = window->findChild<QLineEdit*>(QStringLiteral("library_search"));
        ASSERT_NE(field, nullptr);
        field->setFocus();
        field->clear();
        QTest::keyClicks(field, QLatin1StringView(search));
        settle();
        const QModelIndex index = window->library().view_index(QLatin1StringView(key));
        ASSERT_TRUE(index.isValid()) << key;
        QListView* list = window->library().view();
        QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualRect(index).center());
        const std::unique_ptr<QMimeData> mime(list->model()->mimeData({index}));
        ASSERT_NE(mime, nullptr);
        ViewportWidget* view = &window->viewport();
        const QPoint start(4, view->height() / 2);
        QDragEnterEvent enter(start, Qt::CopyAction, mime.get(), Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(view, &enter);
        ASSERT_TRUE(enter.isAccepted());
        constexpr int kSteps = 12;
        for (int i = 1; i <= kSteps; ++i) {
            QDragMoveEvent move(start + (to - start) * i / kSteps, Qt::CopyAction, mime.get(), Qt::LeftButton,
                                Qt::NoModifier);
            QApplication::sendEvent(view, &move);
            settle();
        }
        QDropEvent drop(QPointF(to), Qt::CopyAction, mime.get(), Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(view, &drop);
        settle();
    }
    /// A point of the view where this object is in front, near the projection of `world`.
    QPoint seen(NodeId id, const dvec3& world) {
        const QPoint middle = at(world);
        for (int ring = 0; ring < 40; ++ring) {
            for (int i = 0; i < 12; ++i) {
                const double angle = 2 * kPiD * i / 12;
                const QPoint p = middle + QPoint(int(6 * ring * std::cos(angle)), int(6 * ring * std::sin(angle)));
                if (window->viewport().rect().adjusted(8, 8, -8, -8).contains(p) &&
                    window->viewport().drop_place(p).node == id) {
                    return p;
                }
            }
        }
        ADD_FAILURE() << node(id).name << " is not in sight";
        return middle;
    }
};

TEST_F(SessionWork, AnAfternoon) {
    const QString project = in_session("room.atrium");
    step("open");
    QSignalSpy opened(&window->files(), &FileController::opened);
    window->files().open(project);
    ASSERT_TRUE(opened.count() > 0 || opened.wait(60000));
    keys(Qt::Key_PageDown, Qt::ControlModifier); // the camera from the door
    ASSERT_TRUE(wait_for_light());
    const Scene untouched = scene();
    window->recovery().set_limits(1000000, 1000000);

    step("import a file");
    keys(Qt::Key_I, Qt::ControlModifier);
    auto* files = dialog<QFileDialog>();
    ASSERT_NE(files, nullptr);
    auto* name = files->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
    ASSERT_NE(name, nullptr);
    name->setFocus();
    QTest::keyClick(name, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(name, in_session("bowl.glb"));
    QTest::keyClick(name, Qt::Key_Return);
    ASSERT_TRUE(QTest::qWaitFor([&] { return entries() == 1; }, 60000));
    EXPECT_EQ(node(window->document().selection()->active()).name, "bowl");

    step("place a lamp from the library");
    keys(Qt::Key_B, Qt::ControlModifier);
    const NodeId ceiling = named("Ceiling");
    drag_from_library("spot", "spot", seen(ceiling, scene().world_bounds(ceiling).centre()));
    ASSERT_EQ(entries(), 2);
    const NodeId spot = window->document().selection()->active();
    EXPECT_EQ(node(spot).name.substr(0, 4), "Spot");
    EXPECT_NEAR(scene().subtree_bounds(spot).max.y, scene().world_bounds(ceiling).min.y, 0.02)
        << "it hangs from the ceiling";

    step("aim it");
    const dquat before_aim = node(spot).transform.rotation;
    type(field("Rotation X"), "150");
    ASSERT_EQ(entries(), 3);
    EXPECT_LT(std::abs(glm::dot(before_aim, node(spot).transform.rotation)), 0.9999);

    step("paint a wall");
    const NodeId wall = named("Wall west");
    drag_from_library("blue paint", "paint_blue_30", seen(wall, scene().world_bounds(wall).centre()));
    ASSERT_EQ(entries(), 4);
    ASSERT_NE(scene().material_of(node(wall), 0), nullptr);
    EXPECT_EQ(scene().material_of(node(wall), 0)->name, "Blue paint, LRV 30");

    step("hang a mirror");
    drag_from_library("wall mirror", "wall_mirror", seen(wall, scene().world_bounds(wall).centre() + dvec3(0, 0.2, -0.5)));
    ASSERT_EQ(entries(), 5);
    const NodeId mirror = window->document().selection()->active();
    EXPECT_EQ(node(mirror).name.substr(0, 11), "Wall mirror");
    EXPECT_LT(scene().subtree_bounds(mirror).size().x, 0.2) << "flat on the west wall";

    step("drag the vase");
    const NodeId vase = named("Glass vase");
    keys(Qt::Key_B, Qt::ControlModifier); // the library goes, the view is wide again
    const dvec3 origin = scene().world_matrix(vase)[3];
    window->viewport().set_camera({glm::inverse(glm::lookAt(origin + dvec3(0.7, 0.9, 1.4), origin, dvec3(0, 1, 0))),
                                   window->viewport().camera().lens});
    settle();
    QTest::mouseClick(&window->viewport(), Qt::LeftButton, {}, seen(vase, scene().world_bounds(vase).centre()));
    settle();
    ASSERT_EQ(window->document().selection()->active(), vase);
    keys(Qt::Key_W);
    ASSERT_EQ(window->viewport().tool(), ToolKind::Move);
    const DBox3 body = scene().world_bounds(vase); // held by its side, off the handles
    const QPoint side = seen(vase, dvec3(body.min.x + 0.1 * body.size().x, body.centre().y, body.centre().z));
    drag(side, side + QPoint(90, 10));
    ASSERT_EQ(entries(), 6);
    EXPECT_GT(glm::length(dvec3(scene().world_matrix(vase)[3]) - origin), 0.1);
    picture("session_vase.png");

    step("wait for the light");
    ASSERT_TRUE(wait_for_light());

    step("look at a caustic");
    keys(Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
    QTableView* table = window->caustics().table();
    ASSERT_TRUE(QTest::qWaitFor([&] { return table->model()->rowCount() > 0; }, 30000));
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, table->visualRect(table->model()->index(0, 0)).center());
    settle();
    ASSERT_TRUE(window->caustics().current());
    const NodeId receiver = window->caustics().current()->record.node;
    EXPECT_EQ(window->document().selection()->nodes(), std::vector<NodeId>{receiver});
    picture("session_caustics.png");

    step("override its resolution");
    auto* texel = window->caustics().findChild<NumberField*>(QStringLiteral("Texel size"));
    ASSERT_NE(texel, nullptr);
    type(texel, "8");
    ASSERT_EQ(entries(), 7);
    EXPECT_FLOAT_EQ(node(receiver).caustics.texel, 0.008F);

    step("undo everything");
    const Scene edited = scene();
    for (int i = 0; i < 7; ++i) {
        keys(Qt::Key_Z, Qt::ControlModifier);
    }
    EXPECT_FALSE(window->document().undo_stack()->canUndo());
    EXPECT_TRUE(scene() == untouched);
    EXPECT_FALSE(window->isWindowModified());

    step("redo everything");
    for (int i = 0; i < 7; ++i) {
        keys(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    }
    EXPECT_TRUE(scene() == edited);

    step("save");
    QSignalSpy saved(&window->files(), &FileController::saved);
    keys(Qt::Key_S, Qt::ControlModifier);
    ASSERT_TRUE(saved.count() > 0 || saved.wait(60000));
    EXPECT_FALSE(window->isWindowModified());

    step("one more edit, kept by the autosave");
    window->recovery().set_limits(1000000, 1);
    QSignalSpy written(&window->recovery(), &Recovery::written);
    select(vase);
    keys(Qt::Key_D, Qt::ControlModifier);
    ASSERT_TRUE(written.count() > 0 || written.wait(60000));

    double painting = 0;
    int stalls = 0;
    for (const auto& stall : application().stalls()) {
        if (stall.painting) {
            painting = std::max(painting, stall.ms);
        } else {
            ++stalls;
            std::printf("[ stall    ] %5.0f ms  %s: %s %s\n", stall.ms, stall.activity.c_str(), stall.receiver.c_str(),
                        stall.event.c_str());
        }
    }
    std::printf("[ stall    ] %d over 16 ms that are not painting; painting %.0f ms at worst\n", stalls, painting);
    std::fflush(stdout);
    EXPECT_EQ(application().paints_on_news(), 0) << "news of the light is painted with the next frame";
    if (!HasFailure()) {
        kill(getpid(), SIGKILL);
    }
}

class Session : public WindowTest {};

TEST_F(Session, SurvivesAKill) {
    QTemporaryDir place;
    const auto file = [&](const char* name) { return place.filePath(QLatin1StringView(name)); };
    auto room = read_scene(ATRIUM_SOURCE_DIR "/scenes/sunlit_room/sunlit_room.gltf");
    ASSERT_TRUE(room) << room.error().message();
    room->scene.settings.quality = SolverSettings::Quality::Draft;
    ASSERT_TRUE(write_scene(file("room.atrium").toStdString(), room->scene));
    NodeId bowl;
    room->scene.nodes.for_each([&](NodeId id, const Node& n) { bowl = n.name == "Fruit bowl" ? id : bowl; });
    ASSERT_TRUE(write_scene(file("bowl.glb").toStdString(), extract_nodes(room->scene, {bowl})));
    window.reset(); // the other process has the screen

    QProcess work;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QLatin1StringView(kFolder), place.path());
    work.setProcessEnvironment(environment);
    work.setProcessChannelMode(QProcess::ForwardedChannels);
    work.start(QCoreApplication::applicationFilePath(), {QStringLiteral("--gtest_filter=SessionWork.*")});
    ASSERT_TRUE(work.waitForFinished(9 * 60000));
    ASSERT_EQ(work.exitStatus(), QProcess::CrashExit) << "it failed before its end and was not killed";
    ASSERT_EQ(work.exitCode(), SIGKILL);

    const auto saved = read_scene(file("room.atrium").toStdString());
    ASSERT_TRUE(saved) << saved.error().message();
    window = std::make_unique<MainWindow>(file("recovery"));
    window->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window.get()));
    window->files().offer_recovery();
    auto* offer = dialog<RecoveryDialog>();
    ASSERT_NE(offer, nullptr);
    ASSERT_TRUE(QTest::qWaitFor([&] { return offer->drawn(); }, 60000));
    if (const QByteArray to = qgetenv("ATRIUM_SCREENSHOTS"); !to.isEmpty()) {
        offer->grab().save(QString::fromLocal8Bit(to) + QStringLiteral("/session_recovery.png"));
    }
    QSignalSpy opened(&window->files(), &FileController::opened);
    QTest::mouseClick(offer->findChild<QPushButton*>(QStringLiteral("recover")), Qt::LeftButton);
    ASSERT_TRUE(opened.count() > 0 || opened.wait(60000));
    EXPECT_TRUE(window->isWindowModified());
    EXPECT_EQ(scene().nodes.size(), saved->scene.nodes.size() + 1) << "the copied vase was not saved, and is here";
    (void)named("Glass vase 2");
    EXPECT_EQ(window->document().path(), file("room.atrium"));
    QSignalSpy done(&window->files(), &FileController::saved);
    QApplication::setActiveWindow(window.get()); // the offer had the focus
    QTest::keyClick(&window->viewport(), Qt::Key_S, Qt::ControlModifier);
    ASSERT_TRUE(done.count() > 0 || done.wait(60000));
    EXPECT_TRUE(window->recovery().orphans().empty());
    const auto again = read_scene(file("room.atrium").toStdString());
    ASSERT_TRUE(again);
    EXPECT_EQ(again->scene.nodes.size(), scene().nodes.size());
}

} // namespace
} // namespace atrium::ui
