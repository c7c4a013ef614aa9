// The process that tests/kill/kills.py kills: document, undo, autosave, lock, opening and saving of the editor with its own
// classes, without window and GL. It edits without pause and tells in a log what it did, in its own time.
//   kill_subject PROJECT RECOVERY_FOLDER LOG INTERVAL_MS SEED [--recover]
// Log, one line each, "<what> <number> <milliseconds>":
//   O n   the project, or with --recover the newest recovered file, is open and holds edit n
//   E n   edit n is in the document
//   B n / S n   saving with edit n began / is confirmed
//   W n / V n   an autosave with edits up to n was seen under way / is confirmed
#include "ui/document/document.h"
#include "ui/document/engine_link.h"
#include "ui/document/recovery.h"
#include "ui/window/file_controller.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QMessageBox>
#include <QPushButton>
#include <QStandardPaths>
#include <QTimer>
#include <QWidget>

#include <cstdio>
#include <fcntl.h>
#include <random>
#include <unistd.h>

namespace atrium::ui {
namespace {

class Subject : public QObject {
public:
    explicit Subject(const QStringList& arguments)
        : recovery_(document_, arguments[2]), files_(document_, engine_, recovery_, &window_),
          random_(arguments[5].toUInt()) {
        log_ = ::open(arguments[3].toLocal8Bit().constData(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
        clock_.start();
        recovery_.set_limits(arguments[4].toInt(), 1000000);
        connect(&files_, &FileController::opened, this, [this] { begin(); });
        connect(&files_, &FileController::open_failed, this, [this](const QString& why) {
            std::fprintf(stderr, "%s\n", why.toStdString().c_str());
            std::exit(3);
        });
        connect(&files_, &FileController::saved, this, [this] { tell('S', saving_); });
        connect(&recovery_, &Recovery::written, this, [this] {
            if (!was_busy_) {
                autosaving_ = number_; // began and ended since the last look, and edits come only after one
            }
            tell('V', autosaving_);
            was_busy_ = false;
        });
        if (arguments.contains(QStringLiteral("--recover"))) {
            const auto left = recovery_.orphans();
            if (left.empty()) {
                std::fprintf(stderr, "nothing to recover\n");
                std::exit(4);
            }
            files_.open_recovered(left.front());
        } else {
            files_.open(arguments[1]);
        }
    }

private:
    void tell(char what, int number) {
        char line[64];
        const int size =
            std::snprintf(line, sizeof(line), "%c %d %lld\n", what, number, static_cast<long long>(clock_.elapsed()));
        if (::write(log_, line, std::size_t(size)) != size) {
            std::exit(5);
        }
    }
    NodeId named(const char* name) {
        NodeId found;
        document_.scene().nodes.for_each([&](NodeId id, const Node& node) { found = node.name == name ? id : found; });
        return found;
    }
    void begin() {
        first_ = named("First");
        second_ = named("Second");
        if (!first_ || !second_) {
            std::fprintf(stderr, "the project is not the one of this test\n");
            std::exit(6);
        }
        number_ = int(document_.scene().nodes.find(first_)->transform.translation.x);
        tell('O', number_);
        timer_.callOnTimeout(this, [this] { step(); });
        timer_.start(4);
    }
    void look_at_autosave() {
        if (recovery_.busy() && !was_busy_) {
            was_busy_ = true;
            autosaving_ = number_; // it began after the last edit
            tell('W', number_);
        }
    }
    void step() {
        look_at_autosave();
        // Two objects that always change together: a state with one of them changed was never there.
        ++number_;
        EditGroup both;
        for (const NodeId id : {first_, second_}) {
            Transform place = document_.scene().nodes.find(id)->transform;
            place.translation.x = number_;
            both.edits.push_back({SetTransform{id, place}});
        }
        if (!document_.apply({std::move(both)}, QStringLiteral("Move"))) {
            std::exit(7);
        }
        tell('E', number_);
        if (random_() % 12 == 0) {
            document_.undo();
            document_.redo();
        }
        if (random_() % 150 == 0 && !files_.saving()) {
            saving_ = number_;
            tell('B', saving_);
            files_.save(); // edits go on while it writes
        }
        if (auto* box = window_.findChild<QMessageBox*>()) { // a question: the test asks for none
            std::fprintf(stderr, "%s: %s\n%s\n", box->objectName().toStdString().c_str(), box->text().toStdString().c_str(),
                         box->informativeText().toStdString().c_str());
            std::exit(8);
        }
    }

    QWidget window_;
    Document document_;
    EngineLink engine_{document_};
    Recovery recovery_;
    FileController files_;
    std::mt19937 random_;
    QElapsedTimer clock_;
    QTimer timer_;
    NodeId first_;
    NodeId second_;
    int number_ = 0;
    int saving_ = 0;
    int autosaving_ = 0;
    bool was_busy_ = false;
    int log_ = -1;
};

} // namespace
} // namespace atrium::ui

int main(int argc, char** argv) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application(argc, argv);
    QCoreApplication::setOrganizationName(QStringLiteral("Atrium"));
    QCoreApplication::setApplicationName(QStringLiteral("atrium-kill-test"));
    QStandardPaths::setTestModeEnabled(true);
    if (application.arguments().size() < 6) {
        std::fprintf(stderr, "usage: kill_subject PROJECT RECOVERY_FOLDER LOG INTERVAL_MS SEED [--recover]\n");
        return 2;
    }
    atrium::ui::Subject subject(application.arguments());
    return QApplication::exec();
}
