// The editor: atrium [FILE]. With --screenshot FILE.png it opens, waits for the light, takes its own picture and quits.
#include "app/program_help.h"
#include "engine/base/version.h"
#include "ui/viewport/viewport_widget.h"
#include "ui/window/false_color_bar.h"
#include "ui/window/file_controller.h"
#include "ui/window/main_window.h"
#include "ui/window/settings.h"
#include "ui/window/translation.h"

#include <QAction>
#include <QApplication>
#include <QCommandLineParser>
#include <QDockWidget>
#include <QFileInfo>
#include <QIcon>
#include <QSurfaceFormat>
#include <QTextStream>
#include <QTimer>

#include <clocale>
#include <csignal>
#include <cstdio>
#include <string_view>

namespace {

/// Saves a picture of the window once the light is up to date and its error known, or after `limit_ms`; then ends the
/// program.
class Screenshot : public QObject {
public:
    /// `points` to be measured and `inspected` ones, whose elements are shown with their links: in shares of the view's
    /// width and height.
    Screenshot(atrium::ui::MainWindow& window, QString file, int limit_ms, QList<QPointF> points, QList<QPointF> inspected)
        : QObject(&window), window_(window), file_(std::move(file)), points_(std::move(points)),
          inspected_(std::move(inspected)) {
        connect(&window_.engine(), &atrium::ui::EngineLink::status_changed, this, [this] {
            const auto solution = window_.engine().solution();
            if (!solution || !solution->final || window_.engine().stale()) {
                return;
            }
            if (solution->statistics.audit.points > 0) {
                take_soon();
            } else if (!complete_) { // the error follows, but in scenes where nothing can be compared
                complete_ = true;
                QTimer::singleShot(15'000, this, [this] { take_soon(); });
            }
        });
        QTimer::singleShot(limit_ms, this, [this] { take(); });
    }

private:
    void take_soon() {
        if (!soon_) {
            soon_ = true;
            QTimer::singleShot(1500, this, [this] { take(); }); // the view uploads and paints, panels settle
        }
    }
    void take() {
        if (taken_) {
            return;
        }
        const auto& shown = window_.viewport();
        const bool uploading = shown.caustic_view() == atrium::ui::CausticView::Texture &&
                               shown.shown_solution() != window_.engine().solution();
        if (uploading || window_.false_color_bar().fitting() || shown.inspector().busy()) {
            QTimer::singleShot(500, this, [this] { take(); });
            return;
        }
        taken_ = true;
        for (const QPointF& point : points_) {
            auto& view = window_.viewport();
            view.add_measuring_point({point.x() * view.width(), point.y() * view.height()});
        }
        for (const QPointF& point : inspected_) {
            auto& view = window_.viewport();
            view.inspect_element({point.x() * view.width(), point.y() * view.height()});
        }
        window_.viewport().refine_now();
        const bool saved = window_.grab().save(file_);
        if (!saved) {
            QTextStream(stderr) << QObject::tr("%1: the picture could not be written").arg(file_) << '\n';
        }
        QCoreApplication::exit(saved ? 0 : 1);
    }
    atrium::ui::MainWindow& window_;
    QString file_;
    QList<QPointF> points_;
    QList<QPointF> inspected_;
    bool complete_ = false;
    bool soon_ = false;
    bool taken_ = false;
};

/// Whether only text is asked for, so that no display is needed.
bool asks_for_text(int argc, char** argv) {
    const std::string_view first = argc > 1 ? argv[1] : "";
    return first == "--help" || first == "-h" || first == "--version" || first == "-v" || first == "--write-manual-page" ||
           first == "--write-completion";
}

/// All that --help tells.
atrium::app::ProgramHelp program_help(const QCommandLineParser& parser, const QList<QCommandLineOption>& options) {
    atrium::app::ProgramHelp out;
    out.name = "atrium";
    out.summary = "edit interiors with live global illumination";
    out.description =
        QStringLiteral("%1\nWithout a file it opens its start page. Scenes are glTF 2.0 (.gltf, .glb) and Atrium projects "
                       "(.atrium), which keep their light.")
            .arg(parser.applicationDescription())
            .toStdString();
    out.own.arguments.push_back({{"FILE"}, "", {}, "scene to open: .gltf, .glb or .atrium", ""});
    for (const QCommandLineOption& option : options) {
        atrium::app::OptionHelp help;
        for (const QString& name : option.names()) {
            help.names.push_back((name.size() == 1 ? "-" : "--") + name.toStdString());
        }
        help.value = option.valueName().toStdString();
        help.text = option.description().toStdString();
        out.own.options.push_back(help);
    }
    out.see_also = {"atrium-cli"};
    return out;
}

} // namespace

int main(int argc, char** argv) {
    if (asks_for_text(argc, argv)) {
        qputenv("QT_QPA_PLATFORM", "offscreen");
        qputenv("QT_LOGGING_RULES", "qt.*=false"); // nothing but that text: not what an absent desktop lacks
    }
    std::signal(SIGXFSZ, SIG_IGN); // a file that grows beyond what is allowed is an error to be told, not the end
    QSurfaceFormat format;
    format.setVersion(3, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    format.setDepthBufferSize(24);
    QSurfaceFormat::setDefaultFormat(format); // before the application object
    QApplication app(argc, argv);
    std::setlocale(LC_NUMERIC, "C"); // Qt has set the user's locale; libraries that print numbers must not follow it
    QCoreApplication::setOrganizationName(QStringLiteral("Atrium"));
    QCoreApplication::setApplicationName(QStringLiteral("atrium"));
    QCoreApplication::setApplicationVersion(QString::fromStdString(atrium::version_text()));
    QGuiApplication::setApplicationDisplayName(QString());
    QGuiApplication::setDesktopFileName(QStringLiteral("atrium"));

    QGuiApplication::setWindowIcon(QIcon(QStringLiteral(":/atrium.svg")));

    if (argc < 2 ||
        std::string_view(argv[1]).substr(0, 8) != "--write-") { // manual pages are the same wherever they are built
        atrium::ui::install_language(atrium::ui::chosen_language(atrium::ui::Settings().language()));
    }

    atrium::ui::apply_appearance(atrium::ui::Settings().appearance());

    QCommandLineParser parser;
    parser.setApplicationDescription(QObject::tr("Edit interiors with live global illumination."));
    const QCommandLineOption help = parser.addHelpOption();
    const QCommandLineOption version = parser.addVersionOption();
    parser.addPositionalArgument(QStringLiteral("FILE"), QObject::tr("scene to open: .gltf, .glb or .atrium"),
                                 QStringLiteral("[FILE]"));
    const QCommandLineOption screenshot(QStringLiteral("screenshot"),
                                        QObject::tr("open, wait for the light, save a picture of the window, quit"),
                                        QStringLiteral("FILE.png"));
    const QCommandLineOption wait(QStringLiteral("screenshot-time"), QObject::tr("wait at most this long for the light"),
                                  QStringLiteral("SECONDS"), QStringLiteral("60"));
    const QCommandLineOption size(QStringLiteral("window-size"), QObject::tr("size of the window in points"),
                                  QStringLiteral("WxH"));
    const QCommandLineOption sample(QStringLiteral("sample"), QObject::tr("open the sample room"));
    const QCommandLineOption select(QStringLiteral("select"), QObject::tr("select the node of this name"),
                                    QStringLiteral("NODE"));
    const QCommandLineOption panel(QStringLiteral("panel"),
                                   QObject::tr("bring a panel to the front: library, tree, properties, jobs, problems, "
                                               "caustics, convergence; none puts all away"),
                                   QStringLiteral("NAME"));
    const QCommandLineOption command(QStringLiteral("command"),
                                     QObject::tr("run a command of the menus by its name (caustic_boxes, wireframe, ...) "
                                                 "once the file is open; may be repeated"),
                                     QStringLiteral("NAME"));
    const QCommandLineOption measure(QStringLiteral("measure-at"),
                                     QObject::tr("with --screenshot: put a measuring point at this place of the view, in "
                                                 "shares of its width and height; may be repeated"),
                                     QStringLiteral("X,Y"));
    const QCommandLineOption inspect(
        QStringLiteral("inspect-at"),
        QObject::tr("with --screenshot and --command element_links: show the links of the element "
                    "at this place of the view, in shares of its width and height"),
        QStringLiteral("X,Y"));
    const QList<QCommandLineOption> options{screenshot, wait, size, sample, select, panel, command, measure, inspect};
    parser.addOptions(options);
    if (argc == 2 && std::string_view(argv[1]).substr(0, 8) == "--write-") { // for the build, from the same tables as --help
        const auto told = program_help(parser, QList<QCommandLineOption>{help, version} + options);
        const std::string text = std::string_view(argv[1]) == "--write-manual-page"
                                     ? atrium::app::manual_page(told, atrium::version_number())
                                     : atrium::app::bash_completion(told);
        return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() ? 0 : 1;
    }
    parser.process(app);

    atrium::ui::MainWindow window;
    const QStringList extent = parser.value(size).split(QLatin1Char('x'));
    if (extent.size() == 2 && extent[0].toInt() > 0 && extent[1].toInt() > 0) {
        window.resize(extent[0].toInt(), extent[1].toInt());
    }
    window.show();
    if (parser.value(panel) == QStringLiteral("none")) {
        for (QDockWidget* dock : window.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
            dock->hide();
        }
    }
    if (parser.isSet(command)) {
        QObject::connect(&window.files(), &atrium::ui::FileController::opened, &window, [&] {
            for (const QString& name : parser.values(command)) {
                auto* action = window.findChild<QAction*>(name);
                if (action != nullptr && !action->isEnabled()) { // what needs the light waits for it
                    QObject::connect(
                        action, &QAction::enabledChanged, action, [action] { action->trigger(); }, Qt::SingleShotConnection);
                } else if (action != nullptr) {
                    action->trigger();
                }
            }
        });
    }
    if (auto* dock = window.findChild<QDockWidget*>(QStringLiteral("dock_") + parser.value(panel))) {
        dock->show();
        dock->raise();
    }
    if (parser.isSet(select)) {
        QObject::connect(&window.files(), &atrium::ui::FileController::opened, &window, [&] {
            const std::string wanted = parser.value(select).toStdString();
            window.document().scene().nodes.for_each([&](atrium::NodeId id, const atrium::Node& node) {
                if (node.name == wanted) {
                    window.document().selection()->set({id});
                }
            });
        });
    }
    if (parser.isSet(screenshot)) {
        // Nobody sits there to read a message box.
        QObject::connect(&window.files(), &atrium::ui::FileController::open_failed, &window, [](const QString& why) {
            QTextStream(stderr) << why << '\n';
            QCoreApplication::exit(1);
        });
    }
    if (!parser.positionalArguments().isEmpty()) {
        window.files().open(parser.positionalArguments().constFirst());
    } else if (parser.isSet(sample)) {
        window.files().open_sample();
    }
    if (parser.isSet(screenshot)) {
        const auto places = [&](const QCommandLineOption& option) {
            QList<QPointF> out;
            for (const QString& place : parser.values(option)) {
                const QStringList numbers = place.split(QLatin1Char(','));
                out.append({numbers.value(0).toDouble(), numbers.value(1).toDouble()});
            }
            return out;
        };
        new Screenshot(window, parser.value(screenshot), int(parser.value(wait).toDouble() * 1000), places(measure),
                       places(inspect));
    } else {
        window.files().offer_recovery();
    }
    return QApplication::exec();
}
