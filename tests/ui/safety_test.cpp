// Nothing that was made is lost: locks, files that others changed or took away, full disks, crashes, damage, second
// thoughts.
#include "window_fixture.h"

#include "engine/io/scene_file.h"
#include "ui/document/file_guard.h"
#include "ui/document/sample_room.h"
#include "ui/window/notice_bar.h"
#include "ui/window/recovery_dialog.h"

#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>

#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace atrium::ui {
namespace {

/// No file grows beyond this while it lives: a full disk, also for root.
class SmallDisk {
public:
    explicit SmallDisk(rlim_t bytes) {
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit small{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    ~SmallDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    rlimit before_{};
    void (*handler_)(int) = nullptr;
};

class Safety : public WindowTest {
protected:
    void SetUp() override {
        WindowTest::SetUp();
        QDir().mkpath(folder.filePath(QStringLiteral("project")));
        path = folder.filePath(QStringLiteral("project/room.atrium"));
        ASSERT_TRUE(write_scene(path.toStdString(), sample_room()));
    }
    void open(MainWindow& in) {
        QSignalSpy opened(&in.files(), &FileController::opened);
        in.files().open(path);
        ASSERT_TRUE(opened.count() > 0 || opened.wait(20000));
    }
    void move_shelf(double x) {
        const NodeId shelf = named("Shelf");
        Transform place = node(shelf).transform;
        place.translation.x = x;
        ASSERT_TRUE(window->document().apply({SetTransform{shelf, place}}, QStringLiteral("Move")));
    }
    static double shelf_in(const QString& file) {
        const auto loaded = read_scene(file.toStdString());
        double x = std::numeric_limits<double>::quiet_NaN();
        EXPECT_TRUE(loaded) << loaded.error().message();
        if (loaded) {
            loaded->scene.nodes.for_each(
                [&](NodeId, const Node& n) { x = n.name == "Shelf" ? n.transform.translation.x : x; });
        }
        return x;
    }
    void press(QMessageBox* box, const QString& text) {
        for (QAbstractButton* button : box->buttons()) {
            QString shown = button->text();
            if (shown.remove(QLatin1Char('&')) == text) {
                QTest::mouseClick(button, Qt::LeftButton);
                settle();
                return;
            }
        }
        FAIL() << "no button " << text.toStdString();
    }
    bool wait_idle() {
        return QTest::qWaitFor([this] { return !window->files().busy() && !window->recovery().busy(); }, 20000);
    }
    NoticeBar* notice(const char* name) { return window->findChild<NoticeBar*>(QLatin1StringView(name)); }
    QString path;
};

TEST_F(Safety, ASecondEditorIsToldAndChooses) {
    open(*window);
    MainWindow second(folder.filePath(QStringLiteral("recovery")));
    second.show();
    const auto box_of_second = [&] {
        QMessageBox* box = nullptr;
        EXPECT_TRUE(QTest::qWaitFor([&] {
            box = second.findChild<QMessageBox*>(QStringLiteral("project_locked"));
            return box != nullptr && box->isVisible();
        }));
        return box;
    };
    second.files().open(path);
    QMessageBox* box = box_of_second();
    ASSERT_NE(box, nullptr);
    EXPECT_TRUE(box->informativeText().contains(QString::number(getpid()))) << box->informativeText().toStdString();
    press(box, QStringLiteral("Cancel"));
    EXPECT_TRUE(second.document().path().isEmpty());
    QTest::qWait(50); // the box is deleted
    second.files().open(path);
    box = box_of_second();
    ASSERT_NE(box, nullptr);
    QSignalSpy opened(&second.files(), &FileController::opened);
    press(box, QStringLiteral("Open Read-Only"));
    ASSERT_TRUE(opened.count() > 0 || opened.wait(20000));
    EXPECT_TRUE(second.files().read_only());
    EXPECT_TRUE(second.windowTitle().contains(QStringLiteral("read-only")));
    second.files().save();
    QFileDialog* dialog = nullptr;
    EXPECT_TRUE(QTest::qWaitFor([&] { return (dialog = second.findChild<QFileDialog*>()) != nullptr; }));
    ASSERT_NE(dialog, nullptr) << "it asks for another name";
    dialog->reject();
    bool saved = false;
    const QString copy = folder.filePath(QStringLiteral("copy.atrium"));
    second.files().save_to(copy, [&](bool ok) { saved = ok; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return saved; }, 20000));
    EXPECT_FALSE(second.files().read_only());
    // The first one's lock goes with its window, and not with the other's.
    EXPECT_TRUE(QFile::exists(ProjectLock::file_of(path)));
    window.reset();
    EXPECT_FALSE(QFile::exists(ProjectLock::file_of(path)));
    EXPECT_TRUE(QFile::exists(ProjectLock::file_of(copy)));
}

TEST_F(Safety, TheLockOfADeadProcessIsTakenOver) {
    const pid_t child = fork();
    if (child == 0) {
        const ProjectLock lock(path);
        _exit(lock.taken() ? 1 : 0); // without giving it back
    }
    int status = -1;
    waitpid(child, &status, 0);
    ASSERT_EQ(status, 0);
    ASSERT_TRUE(QFile::exists(ProjectLock::file_of(path))) << "as a kill leaves it";
    open(*window);
    EXPECT_EQ(window->document().path(), path);
    EXPECT_FALSE(window->files().read_only());
}

TEST_F(Safety, WhatSomebodyElseWroteIsNotOverwrittenUnasked) {
    open(*window);
    move_shelf(1.5);
    Scene theirs = sample_room();
    theirs.nodes.find(named("Shelf"))->transform.translation.x = -9; // the sample's ids are the same
    ASSERT_TRUE(write_scene(path.toStdString(), theirs));
    const double there = shelf_in(path);
    window->files().save();
    auto* box = dialog<QMessageBox>("file_changed");
    ASSERT_NE(box, nullptr);
    EXPECT_DOUBLE_EQ(shelf_in(path), there);
    press(box, QStringLiteral("Cancel"));
    EXPECT_TRUE(window->isWindowModified());
    EXPECT_DOUBLE_EQ(shelf_in(path), there);
    QTest::qWait(50);
    bool saved = false;
    window->files().save([&](bool ok) { saved = ok; });
    box = dialog<QMessageBox>("file_changed");
    ASSERT_NE(box, nullptr);
    press(box, QStringLiteral("Overwrite"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return saved; }, 20000));
    EXPECT_DOUBLE_EQ(shelf_in(path), 1.5);
    // Our own writing is no change by somebody else.
    saved = false;
    move_shelf(1.6);
    window->files().save([&](bool ok) { saved = ok; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return saved; }, 20000));
    EXPECT_DOUBLE_EQ(shelf_in(path), 1.6);
}

TEST_F(Safety, AVanishedFileIsWrittenAgainAndAVanishedFolderIsTold) {
    open(*window);
    move_shelf(1.5);
    ASSERT_TRUE(QFile::remove(path));
    bool saved = false;
    window->files().save([&](bool ok) { saved = ok; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return saved; }, 20000));
    EXPECT_DOUBLE_EQ(shelf_in(path), 1.5);
    move_shelf(1.7);
    ASSERT_TRUE(QDir(folder.filePath(QStringLiteral("project"))).removeRecursively());
    saved = false;
    window->files().save([&](bool ok) { saved = ok; });
    auto* box = dialog<QMessageBox>("save_failed");
    ASSERT_NE(box, nullptr);
    EXPECT_TRUE(window->isWindowModified());
    ASSERT_TRUE(wait_idle());
    EXPECT_DOUBLE_EQ(shelf_in(window->recovery().path()), 1.7) << "kept at once where saving failed";
    QDir().mkpath(folder.filePath(QStringLiteral("project")));
    press(box, QStringLiteral("Try Again"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return saved; }, 20000));
    EXPECT_DOUBLE_EQ(shelf_in(path), 1.7);
    EXPECT_FALSE(QFile::exists(window->recovery().path()));
}

TEST_F(Safety, AFolderThatCannotBeWrittenIsToldAndNothingIsLost) {
    open(*window);
    move_shelf(1.5);
    const QString nowhere = QStringLiteral("/sys/kernel/room.atrium"); // not even root makes files there
    window->files().save_to(nowhere);
    auto* box = dialog<QMessageBox>("save_failed");
    ASSERT_NE(box, nullptr);
    EXPECT_TRUE(box->informativeText().contains(nowhere)) << box->informativeText().toStdString();
    press(box, QStringLiteral("Cancel"));
    EXPECT_EQ(window->document().path(), path) << "it is still the document of before";
    EXPECT_TRUE(window->isWindowModified());
    bool saved = false;
    window->files().save([&](bool ok) { saved = ok; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return saved; }, 20000));
    EXPECT_DOUBLE_EQ(shelf_in(path), 1.5);
}

TEST_F(Safety, AFullDiskLosesNothingAndIsTold) {
    open(*window);
    const double before = shelf_in(path);
    window->recovery().set_limits(1000000, 1000000);
    move_shelf(1.5);
    {
        const SmallDisk full(2048);
        window->files().save();
        auto* box = dialog<QMessageBox>("save_failed");
        ASSERT_NE(box, nullptr);
        EXPECT_TRUE(box->informativeText().contains(QStringLiteral("Free some space")))
            << box->informativeText().toStdString();
        ASSERT_TRUE(wait_idle());
        EXPECT_TRUE(notice("autosave_notice")->isVisible())
            << "the copy could not be written either, and that stays on the screen";
        press(box, QStringLiteral("Cancel"));
    }
    EXPECT_DOUBLE_EQ(shelf_in(path), before) << "the old file is whole";
    EXPECT_EQ(QDir(folder.filePath(QStringLiteral("project"))).entryList(QDir::Files),
              QStringList{QStringLiteral("room.atrium")})
        << "and no half of a new one";
    EXPECT_TRUE(window->isWindowModified());
    EXPECT_DOUBLE_EQ(node(named("Shelf")).transform.translation.x, 1.5);
    QSignalSpy written(&window->recovery(), &Recovery::written);
    window->recovery().write();
    ASSERT_TRUE(written.count() > 0 || written.wait(20000));
    EXPECT_FALSE(notice("autosave_notice")->isVisible());
    EXPECT_DOUBLE_EQ(shelf_in(window->recovery().path()), 1.5);
}

TEST_F(Safety, RevertingPutsTheChangesAside) {
    open(*window);
    const double before = node(named("Shelf")).transform.translation.x;
    move_shelf(1.5);
    trigger(ActionId::Revert);
    auto* box = dialog<QMessageBox>("revert");
    ASSERT_NE(box, nullptr);
    QSignalSpy opened(&window->files(), &FileController::opened);
    press(box, QStringLiteral("Revert"));
    ASSERT_TRUE(opened.count() > 0 || opened.wait(20000));
    EXPECT_DOUBLE_EQ(node(named("Shelf")).transform.translation.x, before);
    EXPECT_FALSE(window->isWindowModified());
    EXPECT_TRUE(window->recovery().orphans().empty()) << "nothing to be offered at the next start";
    ASSERT_EQ(window->recovery().kept().size(), 1U);
    EXPECT_EQ(window->recovery().kept().front().original, path);
    trigger(ActionId::RecoveredWork);
    auto* dialog_shown = dialog<RecoveryDialog>();
    ASSERT_NE(dialog_shown, nullptr);
    QSignalSpy back(&window->files(), &FileController::opened);
    QTest::mouseClick(dialog_shown->findChild<QPushButton*>(QStringLiteral("recover")), Qt::LeftButton);
    ASSERT_TRUE(back.count() > 0 || back.wait(20000));
    EXPECT_DOUBLE_EQ(node(named("Shelf")).transform.translation.x, 1.5);
    EXPECT_EQ(window->document().path(), path);
    EXPECT_TRUE(window->isWindowModified());
}

TEST_F(Safety, WhatWasDiscardedCanBeHadBack) {
    open(*window);
    move_shelf(1.5);
    window->files().new_scene();
    auto* box = dialog<QMessageBox>("save_changes");
    ASSERT_NE(box, nullptr);
    QSignalSpy opened(&window->files(), &FileController::opened);
    box->button(QMessageBox::Discard)->click();
    ASSERT_TRUE(opened.count() > 0 || opened.wait(20000));
    EXPECT_TRUE(scene().nodes.empty());
    ASSERT_EQ(window->recovery().kept().size(), 1U);
    EXPECT_DOUBLE_EQ(shelf_in(window->recovery().kept().front().path), 1.5);
    EXPECT_EQ(window->recovery().kept().front().reason, RecoveredFile::Reason::Discarded);
}

TEST_F(Safety, ADamagedProjectOpensWithWhatItHolds) {
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::ReadWrite));
    const QByteArray whole = file.readAll();
    const auto json_end = 20 + qint64(qFromLittleEndian<quint32>(whole.constData() + 12));
    ASSERT_TRUE(file.resize(json_end)); // the binary part is gone
    file.close();
    window->files().open(path);
    auto* box = dialog<QMessageBox>("damaged_file");
    ASSERT_NE(box, nullptr);
    EXPECT_TRUE(scene().nodes.empty()) << "nothing happens unasked";
    QSignalSpy opened(&window->files(), &FileController::opened);
    press(box, QStringLiteral("Open What Is Left"));
    ASSERT_TRUE(opened.count() > 0 || opened.wait(20000));
    EXPECT_EQ(scene().nodes.size(), sample_room().nodes.size());
    EXPECT_TRUE(window->files().read_only()) << "the damaged file is not overwritten: a better tool may get more out of it";
    EXPECT_TRUE(window->isWindowModified());
    EXPECT_FALSE(window->document().problems().empty());
}

TEST_F(Safety, MissingImagesAreFoundAndThatCanBeUndone) {
    Scene with_image = sample_room();
    QImage picture(8, 8, QImage::Format_RGB32);
    picture.fill(Qt::red);
    const QString scenes = folder.filePath(QStringLiteral("scene"));
    QDir().mkpath(scenes + QStringLiteral("/maps"));
    QDir().mkpath(folder.filePath(QStringLiteral("elsewhere/deep")));
    ASSERT_TRUE(picture.save(scenes + QStringLiteral("/maps/wood.png")));
    QFile encoded(scenes + QStringLiteral("/maps/wood.png"));
    ASSERT_TRUE(encoded.open(QIODevice::ReadOnly));
    const QByteArray bytes = encoded.readAll();
    Texture texture;
    texture.uri = "maps/wood.png";
    texture.mime_type = "image/png";
    texture.encoded = std::make_shared<const std::vector<std::uint8_t>>(bytes.begin(), bytes.end());
    const TextureId id = with_image.textures.insert(texture);
    with_image.materials.find(with_image.materials.keys().front())->base_color_texture.texture = id;
    const QString gltf = scenes + QStringLiteral("/room.gltf");
    ASSERT_TRUE(write_scene(gltf.toStdString(), with_image));
    ASSERT_TRUE(QFile::rename(scenes + QStringLiteral("/maps/wood.png"),
                              folder.filePath(QStringLiteral("elsewhere/deep/wood.png"))));
    QSignalSpy opened(&window->files(), &FileController::opened);
    window->files().open(gltf);
    ASSERT_TRUE(opened.wait(20000));
    settle();
    EXPECT_TRUE(notice("images_notice")->isVisible());
    window->files().find_textures(folder.filePath(QStringLiteral("elsewhere")));
    ASSERT_TRUE(wait_idle());
    settle();
    EXPECT_FALSE(notice("images_notice")->isVisible());
    EXPECT_EQ(entries(), 1);
    const TextureId now = scene().textures.keys().front();
    ASSERT_TRUE(scene().textures.find(now)->image);
    EXPECT_EQ(scene().textures.find(now)->image->width, 8);
    trigger(ActionId::Undo);
    EXPECT_FALSE(scene().textures.find(now)->image);
}

TEST_F(Safety, TheOfferShowsBothStatesWithDatesAndPictures) {
    open(*window);
    settle();
    window->recovery().set_limits(1000000, 1);
    QSignalSpy written(&window->recovery(), &Recovery::written);
    move_shelf(0.2);
    ASSERT_TRUE(written.count() > 0 || written.wait(20000));
    window.reset(); // without closing: as a kill leaves it
    window = std::make_unique<MainWindow>(folder.filePath(QStringLiteral("recovery")));
    window->show();
    ASSERT_EQ(window->recovery().orphans().size(), 1U);
    EXPECT_TRUE(window->recovery().orphans().front().camera) << "seen from where the view stood";
    window->files().offer_recovery();
    auto* offer = dialog<RecoveryDialog>();
    ASSERT_NE(offer, nullptr);
    ASSERT_TRUE(QTest::qWaitFor([&] { return offer->drawn(); }, 20000));
    const auto label = [&](const char* name) { return offer->findChild<QLabel*>(QLatin1StringView(name)); };
    const QImage saved = label("saved_picture")->pixmap().toImage();
    const QImage recovered = label("recovered_picture")->pixmap().toImage();
    ASSERT_FALSE(saved.isNull());
    ASSERT_FALSE(recovered.isNull());
    EXPECT_NE(saved, recovered) << "the shelf stands elsewhere";
    const QString year = QString::number(QDate::currentDate().year());
    EXPECT_TRUE(label("saved_caption")->text().contains(year));
    EXPECT_TRUE(label("recovered_caption")->text().contains(year));
    EXPECT_TRUE(label("recovery_summary")->text().contains(QStringLiteral("Shelf")))
        << label("recovery_summary")->text().toStdString();
    EXPECT_FALSE(label("recovery_summary")->text().contains(QStringLiteral("Bowl")));
    if (const QByteArray to = qgetenv("ATRIUM_SCREENSHOTS"); !to.isEmpty()) {
        offer->grab().save(QString::fromLocal8Bit(to) + QStringLiteral("/recovery.png"));
    }
}

TEST(SceneDifference, NamesWhatChanged) {
    const Scene saved = sample_room();
    Scene recovered = saved;
    EXPECT_FALSE(scene_difference(saved, recovered).any());
    NodeId bowl;
    recovered.nodes.for_each([&](NodeId id, const Node& n) { bowl = n.name == "Bowl" ? id : bowl; });
    recovered.nodes.find(bowl)->transform.translation.x += 0.01;
    Node fresh;
    fresh.name = "Fresh";
    recovered.roots.push_back(recovered.nodes.insert(fresh));
    const SceneDifference forth = scene_difference(saved, recovered);
    EXPECT_EQ(forth.changed, QStringList{QStringLiteral("Bowl")});
    EXPECT_EQ(forth.added, QStringList{QStringLiteral("Fresh")});
    EXPECT_TRUE(forth.removed.isEmpty());
    EXPECT_EQ(scene_difference(recovered, saved).removed, QStringList{QStringLiteral("Fresh")});
}

} // namespace
} // namespace atrium::ui
