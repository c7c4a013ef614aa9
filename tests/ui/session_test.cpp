// A session as an architect has it, by mouse and keys, in a process of its own that is killed at the end; then recovery.
// Says what held the window for longer than a frame. ATRIUM_SCREENSHOTS=FOLDER leaves pictures there.
#include "session_work.h"

#include "engine/io/scene_file.h"
#include "ui/document/insert_commands.h"
#include "ui/panels/caustic_panel.h"
#include "ui/panels/caustic_table_model.h"
#include "ui/window/recovery_dialog.h"

#include <QAbstractItemModel>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QLineEdit>
#include <QPointer>
#include <QProcess>
#include <QPushButton>
#include <QSignalSpy>
#include <QSortFilterProxyModel>
#include <QTableView>

#include <csignal>
#include <unistd.h>

namespace atrium::ui {
namespace {

constexpr char kFolder[] = "ATRIUM_SESSION_FOLDER";

QString in_session(const char* name) {
    return QString::fromLocal8Bit(qgetenv(kFolder)) + QLatin1Char('/') + QLatin1StringView(name);
}

/// The largest relative change of light at places that were lit before.
double largest_change(const std::vector<double>& before, const std::vector<double>& after) {
    double out = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        out = before[i] > 0 && after[i] > 0 ? std::max(out, std::abs(after[i] / before[i] - 1.0)) : out;
    }
    return out;
}

int vases(const Scene& scene) {
    int out = 0;
    scene.nodes.for_each([&](NodeId, const Node& n) { out += n.name.starts_with("Glass vase") ? 1 : 0; });
    return out;
}

/// How far places are from what they were, all taken together.
double change_of_all(const std::vector<double>& before, const std::vector<double>& after) {
    double a = 0, b = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const bool both = before[i] > 0 && after[i] > 0;
        a += both ? before[i] : 0;
        b += both ? after[i] : 0;
    }
    return std::abs(b / a - 1.0);
}

TEST_F(SessionWork, AnAfternoon) {
    const Stage& stage = session_stage();
    const QString project = in_session("room.atrium");
    step("open");
    QSignalSpy opened(&window->files(), &FileController::opened);
    window->files().open(project);
    ASSERT_TRUE(opened.count() > 0 || opened.wait(60000));
    for (int i = 0; i < stage.camera; ++i) {
        keys(Qt::Key_PageDown, Qt::ControlModifier);
    }
    const Scene untouched = scene();
    window->recovery().set_limits(1000000, 1000000);
    int done = 0; // entries of undo
    if (stage.daylight) {
        step("let the sun in");
        trigger(ActionId::AddDaylight);
        ASSERT_EQ(entries(), ++done);
    }

    step("import a file");
    keys(Qt::Key_I, Qt::ControlModifier);
    auto* files = dialog<QFileDialog>();
    ASSERT_NE(files, nullptr);
    auto* name = files->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
    ASSERT_NE(name, nullptr);
    name->setFocus();
    // The dialog reads folders in a thread of its own: a name typed before it knows the file leaves Open disabled until
    // the text changes again, and the list of names that complete it may take Return for itself. So as a user does:
    // type it again.
    const QPointer<QFileDialog> open(files);
    const auto* accept = files->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open);
    ASSERT_NE(accept, nullptr);
    for (int k = 0; k < 20 && open && open->isVisible(); ++k) {
        QTest::keyClick(name, Qt::Key_A, Qt::ControlModifier);
        QTest::keyClicks(name, in_session("bowl.glb"));
        if (QTest::qWaitFor([&] { return accept->isEnabled(); }, 1000)) {
            QTest::keyClick(name, Qt::Key_Return);
            (void)QTest::qWaitFor([&] { return !open || !open->isVisible(); }, 2000);
        }
    }
    ASSERT_TRUE(!open || !open->isVisible())
        << name->text().toStdString() << (accept->isEnabled() ? ", Open is enabled" : ", Open is disabled");
    ++done;
    ASSERT_TRUE(QTest::qWaitFor([&] { return entries() == done; }, 60000));
    EXPECT_EQ(node(window->document().selection()->active()).name, "bowl");

    step("place a lamp from the library");
    keys(Qt::Key_B, Qt::ControlModifier);
    ASSERT_TRUE(QTest::qWaitFor([this] { return bool(window->viewport().shown_solution()); }, 400000)) << "a first picture";
    drag_from_library("spot", "spot", window->viewport().rect().center());
    ASSERT_EQ(entries(), ++done);
    const NodeId spot = window->document().selection()->active();
    EXPECT_EQ(node(spot).name.substr(0, 4), "Spot");
    EXPECT_LT((node(spot).transform.rotation * dvec3(0, 1, 0)).y, -0.9) << "it hangs from the ceiling";

    step("aim it");
    const dquat before_aim = node(spot).transform.rotation;
    type(field("Rotation X"), "150");
    ASSERT_EQ(entries(), ++done);
    EXPECT_LT(std::abs(glm::dot(before_aim, node(spot).transform.rotation)), 0.9999);

    step("paint a wall");
    const auto place = wall_in_view();
    ASSERT_TRUE(place) << "there is no wall in view";
    const NodeId wall = stage.wall == nullptr ? place->second : named(stage.wall);
    const QPoint on_wall = stage.wall == nullptr ? place->first : seen(wall, scene().world_bounds(wall).centre());
    drag_from_library("blue paint", "paint_blue_30", on_wall);
    ASSERT_EQ(entries(), ++done);
    ASSERT_NE(scene().material_of(node(wall), 0), nullptr);
    EXPECT_EQ(scene().material_of(node(wall), 0)->name, "Blue paint, LRV 30");

    step("hang a mirror");
    drag_from_library("wall mirror", "wall_mirror", on_wall);
    ASSERT_EQ(entries(), ++done);
    const NodeId mirror = window->document().selection()->active();
    EXPECT_EQ(node(mirror).name.substr(0, 11), "Wall mirror");
    const dvec3 flat = scene().subtree_bounds(mirror).size();
    EXPECT_LT(std::min(flat.x, flat.z), 0.35 * std::max(flat.x, flat.z)) << "flat on the wall";

    step("stand a vase beside the sun");
    if (stage.look) {
        window->viewport().set_camera({glm::inverse(glm::lookAt(stage.look->first, stage.look->second, dvec3(0, 1, 0))),
                                       window->viewport().camera().lens});
        settle();
    }
    Crossing way{stage.from, stage.middle, stage.to, stage.lit};
    if (stage.support == nullptr) {
        ASSERT_TRUE(wait_for_light());
        keys(Qt::Key_B, Qt::ControlModifier); // the view is wide without the library
        ASSERT_TRUE(wait_for_update());
        const auto found = sun_on_floor();
        ASSERT_TRUE(found) << "no sun on the floor in view";
        way = *found;
        const ViewCamera now = window->viewport().camera();
        window->viewport().set_camera(
            {glm::inverse(glm::lookAt(dvec3(now.to_world[3]), way.middle, dvec3(0, 1, 0))), now.lens});
        keys(Qt::Key_B, Qt::ControlModifier);
    }
    drag_from_library("glass vase", ":/library/furniture/glass_vase.glb",
                      stage.support == nullptr ? at(way.from) : seen(named(stage.support), way.from));
    ASSERT_EQ(entries(), ++done);
    const NodeId vase = window->document().selection()->active();
    EXPECT_EQ(node(vase).name.substr(0, 10), "Glass vase");
    EXPECT_LT(glm::length(origin(vase) - way.from), 0.25);
    keys(Qt::Key_B, Qt::ControlModifier); // the library goes, the view is wide again

    step("wait for the light");
    ASSERT_TRUE(wait_for_light());
    ASSERT_TRUE(wait_for_update());
    picture("furnished");
    const std::vector<double> before = lux(way.lit);
    ASSERT_GT(std::count_if(before.begin(), before.end(), [](double e) { return e > 0; }), 3) << "sunlit places in view";

    step("drag the vase through the sun");
    ASSERT_EQ(window->viewport().tool(), ToolKind::Select);
    const DBox3 body = scene().world_bounds(vase);
    const QPoint held = seen(vase, body.centre());
    QTest::mouseClick(&window->viewport(), Qt::LeftButton, {}, held);
    settle();
    ASSERT_EQ(window->document().selection()->active(), vase);
    hold(held);
    carry(vase, way.middle);
    EXPECT_LT(glm::length(origin(vase) - way.middle), 0.06) << "it follows the hand";
    ASSERT_TRUE(wait_for_update());
    const std::vector<double> under = lux(way.lit);
    picture("vase_in_the_sun");
    EXPECT_GT(largest_change(before, under), 0.2) << "it stands in the sun: its shadow and its caustic fall on lit places";
    carry(vase, way.to);
    let_go();
    ASSERT_EQ(entries(), ++done) << "one drag, one entry";
    EXPECT_LT(glm::length(origin(vase) - way.to), 0.06);
    ASSERT_TRUE(wait_for_rest());
    const std::vector<double> after = lux(way.lit);
    EXPECT_LT(change_of_all(before, after), 0.15) << "it has left the sun as it was";
    std::printf(
        "[ session  ] sunlit places: %.0f %% changed at most while it stood there, all together %.1f %% afterwards\n",
        100 * largest_change(before, under), 100 * change_of_all(before, after));

    step("put it back into the sun");
    hold(seen(vase, scene().world_bounds(vase).centre()));
    carry(vase, way.middle);
    let_go();
    ASSERT_EQ(entries(), ++done);
    const std::unordered_set<NodeId> receivers = surfaces(way.lit);
    ASSERT_TRUE(wait_for_rest());

    step("look at its caustic");
    keys(Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
    QTableView* table = window->caustics().table();
    ASSERT_TRUE(QTest::qWaitFor([&] { return table->model()->rowCount() > 0; }, 30000));
    const auto* sorted = qobject_cast<const QSortFilterProxyModel*>(table->model());
    ASSERT_NE(sorted, nullptr);
    QModelIndex row;
    for (int i = 0; i < sorted->rowCount() && !row.isValid(); ++i) {
        const CausticRow& one = window->caustics().model().row(sorted->mapToSource(sorted->index(i, 0)).row());
        row = receivers.contains(one.record.node) ? sorted->index(i, 0) : row;
    }
    ASSERT_TRUE(row.isValid()) << "no caustic on the surfaces that the vase stands before";
    table->scrollTo(row);
    settle();
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, table->visualRect(row).center());
    settle();
    ASSERT_TRUE(window->caustics().current());
    const NodeId receiver = window->caustics().current()->record.node;
    EXPECT_TRUE(receivers.contains(receiver));
    EXPECT_EQ(window->document().selection()->nodes(), std::vector<NodeId>{receiver});
    picture("caustics");

    step("override its resolution");
    auto* texel = window->caustics().findChild<NumberField*>(QStringLiteral("Texel size"));
    ASSERT_NE(texel, nullptr);
    type(texel, "8");
    ASSERT_EQ(entries(), ++done);
    EXPECT_FLOAT_EQ(node(receiver).caustics.texel, 0.008F);

    step("undo everything");
    const Scene edited = scene();
    for (int i = 0; i < done; ++i) {
        keys(Qt::Key_Z, Qt::ControlModifier);
    }
    EXPECT_FALSE(window->document().undo_stack()->canUndo());
    EXPECT_TRUE(scene() == untouched);
    EXPECT_FALSE(window->isWindowModified());

    step("redo everything");
    for (int i = 0; i < done; ++i) {
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
            std::printf("[ stall    ] %5.0f ms (%.0f on the wall from %.3f s)  %s: %s %s\n", stall.ms, stall.wall_ms,
                        stall.began * 1e-3, stall.activity.c_str(), stall.receiver.c_str(), stall.event.c_str());
        }
    }
    std::printf("[ stall    ] %d over 16 ms that are not painting; painting %.0f ms at worst\n", stalls, painting);
    std::fflush(stdout);
    EXPECT_EQ(application().paints_on_news(), 0) << "news of the light is painted with the next frame";
    if (!HasFailure()) {
        kill(getpid(), SIGKILL);
    }
}

class Session : public WindowTest, public testing::WithParamInterface<Stage> {};

TEST_P(Session, SurvivesAKill) {
    const Stage& stage = GetParam();
    const QString source = QLatin1String(stage.shared ? ATRIUM_SHARED_DIR "/scenes/" : ATRIUM_SOURCE_DIR "/scenes/") +
                           QLatin1String(stage.file);
    if (stage.shared && !QFileInfo::exists(source)) {
        GTEST_SKIP() << "no shared scenes here";
    }
    QTemporaryDir place;
    const auto file = [&](const char* name) { return place.filePath(QLatin1StringView(name)); };
    auto room = read_scene(source.toStdString());
    ASSERT_TRUE(room) << room.error().message();
    room->scene.settings.quality = SolverSettings::Quality::Draft;
    ASSERT_TRUE(write_scene(file("room.atrium").toStdString(), room->scene));
    auto bowls = read_scene(ATRIUM_SOURCE_DIR "/scenes/sunlit_room/sunlit_room.gltf");
    ASSERT_TRUE(bowls) << bowls.error().message();
    NodeId bowl;
    bowls->scene.nodes.for_each([&](NodeId id, const Node& n) { bowl = n.name == "Fruit bowl" ? id : bowl; });
    ASSERT_TRUE(write_scene(file("bowl.glb").toStdString(), extract_nodes(bowls->scene, {bowl})));
    window.reset(); // the other process has the screen

    QProcess work;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QLatin1StringView(kFolder), place.path());
    environment.insert(QStringLiteral("ATRIUM_SESSION_STAGE"), QLatin1String(stage.name));
    work.setProcessEnvironment(environment);
    work.setProcessChannelMode(QProcess::ForwardedChannels);
    work.start(QCoreApplication::applicationFilePath(), {QStringLiteral("--gtest_filter=SessionWork.*")});
    ASSERT_TRUE(work.waitForFinished(13 * 60000));
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
        offer->grab().save(QStringLiteral("%1/%2_recovery.png").arg(QString::fromLocal8Bit(to), QLatin1String(stage.name)));
    }
    QSignalSpy opened(&window->files(), &FileController::opened);
    QTest::mouseClick(offer->findChild<QPushButton*>(QStringLiteral("recover")), Qt::LeftButton);
    ASSERT_TRUE(opened.count() > 0 || opened.wait(60000));
    EXPECT_TRUE(window->isWindowModified());
    EXPECT_EQ(scene().nodes.size(), saved->scene.nodes.size() + 1) << "the copied vase was not saved, and is here";
    EXPECT_EQ(vases(scene()), vases(saved->scene) + 1);
    EXPECT_EQ(window->document().path(), file("room.atrium"));
    QSignalSpy done(&window->files(), &FileController::saved);
    QApplication::setActiveWindow(window.get()); // the offer had the focus
    QTest::keyClick(&window->viewport(), Qt::Key_S, Qt::ControlModifier);
    ASSERT_TRUE(done.count() > 0 || done.wait(60000));
    EXPECT_TRUE(window->recovery().orphans().empty());
    const auto again = read_scene(file("room.atrium").toStdString());
    ASSERT_TRUE(again);
    EXPECT_EQ(again->scene.nodes.size(), scene().nodes.size());

    window->files().new_scene();
    settle();
    QSignalSpy reopened(&window->files(), &FileController::opened);
    window->files().open(file("room.atrium"));
    ASSERT_TRUE(reopened.count() > 0 || reopened.wait(60000));
    EXPECT_EQ(scene().nodes.size(), again->scene.nodes.size());
    EXPECT_EQ(vases(scene()), vases(again->scene));
}

INSTANTIATE_TEST_SUITE_P(On, Session, testing::ValuesIn(session_stages()),
                         [](const auto& stage) { return std::string(stage.param.name); });

} // namespace
} // namespace atrium::ui
