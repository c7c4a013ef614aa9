// The convergence panel: what it logs, shows and saves.
#include "window_fixture.h"

#include "engine/solver/statistics_figures.h"
#include "ui/panels/convergence_log.h"
#include "ui/panels/convergence_panel.h"
#include "ui/panels/convergence_plot.h"

#include <QApplication>
#include <QDockWidget>
#include <QFile>
#include <QImageReader>
#include <QTreeWidget>

namespace atrium::ui {
namespace {

Solution picture(double seconds, double error, bool final, bool updatable) {
    Solution out;
    out.final = final;
    out.updatable = updatable;
    out.statistics.time.solve = seconds;
    out.statistics.error_estimate = error;
    out.statistics.links = std::uint64_t(1000.0 * seconds);
    out.statistics.energy.emitted = 123.5;
    return out;
}

QList<QStringList> table(const QString& csv) {
    QList<QStringList> rows;
    for (const QString& line : csv.trimmed().split(QLatin1Char('\n'))) {
        rows.append(line.split(QLatin1Char(',')));
    }
    return rows;
}

TEST(ConvergenceLogTest, RunsAreToldApartAndTimeAddsUp) {
    ConvergenceLog log;
    log.add(picture(1.0, 0.08, false, false));
    log.add(picture(5.0, 0.02, true, true)); // the same run
    Solution hurried = picture(0.2, 0.02, false, true);
    hurried.statistics.update.degraded = true;
    log.add(hurried);
    Solution settled = picture(1.5, 0.02, false, true);
    settled.statistics.update.links_visited = 7;
    log.add(settled);
    log.add(picture(4.0, 0.02, true, true)); // a complete solution without a first picture
    using Kind = ConvergenceSample::Kind;
    const Kind kinds[] = {Kind::First, Kind::Final, Kind::Hurried, Kind::Settled, Kind::Final};
    const int runs[] = {1, 1, 2, 3, 4};
    const double totals[] = {1.0, 5.0, 5.2, 6.7, 10.7};
    ASSERT_EQ(log.samples().size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(log.samples()[i].kind, kinds[i]) << i;
        EXPECT_EQ(log.samples()[i].run, runs[i]) << i;
        EXPECT_NEAR(log.samples()[i].total_seconds, totals[i], 1e-12) << i;
    }
    // The same picture again, its error measured: known better, not another point in time.
    Solution measured = picture(4.0, 0.05, true, true);
    measured.statistics.audit.points = 500;
    measured.statistics.audit.rms = 0.05;
    log.add(measured);
    ASSERT_EQ(log.samples().size(), 5U);
    EXPECT_EQ(log.samples()[4].run, 4);
    EXPECT_EQ(log.samples()[4].estimate, 0.02);
    EXPECT_EQ(log.samples()[4].measured, 0.05);
    EXPECT_NEAR(log.samples()[4].total_seconds, 10.7, 1e-12);
    log.clear();
    log.add(picture(30.0, 0.02, true, false)); // from a project
    EXPECT_EQ(log.samples()[0].kind, Kind::Stored);
    EXPECT_EQ(log.samples()[0].total_seconds, 0.0);
}

TEST(ConvergenceLogTest, TheTableHasTheKeysOfTheStatistics) {
    ConvergenceLog log;
    log.add(picture(1.25, 0.08, false, false));
    const auto rows = table(QString::fromStdString(log.csv()));
    ASSERT_EQ(rows.size(), 2);
    ASSERT_EQ(rows[0].size(), rows[1].size());
    const auto cell = [&](const char* key) { return rows[1].value(rows[0].indexOf(QLatin1StringView(key))); };
    EXPECT_EQ(cell("kind"), QStringLiteral("first"));
    EXPECT_EQ(cell("seconds").toDouble(), 1.25);
    EXPECT_EQ(cell("error_estimate").toDouble(), 0.08);
    EXPECT_EQ(cell("links"), QStringLiteral("1250"));
    EXPECT_EQ(cell("energy.emitted").toDouble(), 123.5);
    for (const StatisticsFigure& figure : statistics_figures({})) {
        EXPECT_TRUE(rows[0].contains(QString::fromStdString(figure.key))) << figure.key;
    }
}

class Convergence : public WindowTest {};

TEST_F(Convergence, ShowsTheFiguresOfTheSolutionAndSavesThePlot) {
    trigger(ActionId::Convergence);
    trigger(ActionId::ShowLuminance);
    auto* dock = window->findChild<QDockWidget*>(QStringLiteral("dock_convergence"));
    ASSERT_NE(dock, nullptr);
    EXPECT_TRUE(dock->isVisible());
    open_sample();
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { // complete, and its error measured
            return window->engine().status().state == SessionStatus::State::Idle && window->engine().solution() &&
                   window->engine().solution()->final && window->engine().solution()->statistics.audit.points > 0;
        },
        60000));
    settle();
    const Statistics& s = window->engine().solution()->statistics;
    auto* tree = window->findChild<QTreeWidget*>(QStringLiteral("convergence_figures"));
    const auto value = [&](const QString& key) {
        const auto found = tree->findItems(key, Qt::MatchExactly);
        return found.isEmpty() ? QString() : found[0]->text(1);
    };
    EXPECT_EQ(value(QStringLiteral("rays")), QLocale().toString(qulonglong(s.rays)));
    EXPECT_EQ(value(QStringLiteral("elements")), QLocale().toString(qulonglong(s.elements)));
    EXPECT_FALSE(value(QStringLiteral("error_estimate")).isEmpty());
    const auto phases = tree->findItems(QStringLiteral("phases"), Qt::MatchExactly);
    ASSERT_EQ(phases.size(), 1);
    EXPECT_EQ(std::size_t(phases[0]->childCount()), s.phases.size());

    const auto& samples = window->convergence().log().samples();
    ASSERT_FALSE(samples.empty());
    EXPECT_EQ(samples.back().kind, ConvergenceSample::Kind::Final);
    EXPECT_EQ(samples.back().seconds, s.time.solve);
    EXPECT_GT(samples.back().estimate, 0.0);
    EXPECT_GT(samples.back().measured, 0.0) << "complete light is measured";
    EXPECT_EQ(samples.back().measured, s.error_estimate);
    EXPECT_GE(window->findChild<ConvergencePlot*>()->points(), 2);

    const QString csv = folder.filePath(QStringLiteral("c.csv"));
    ASSERT_TRUE(window->convergence().save(csv));
    QFile file(csv);
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    const auto rows = table(QString::fromUtf8(file.readAll()));
    ASSERT_EQ(std::size_t(rows.size()), samples.size() + 1);
    EXPECT_EQ(rows.back()[rows[0].indexOf(QStringLiteral("rays"))].toULongLong(), s.rays);
    EXPECT_DOUBLE_EQ(rows.back()[rows[0].indexOf(QStringLiteral("error_estimate"))].toDouble(), s.error_estimate);

    const QString png = folder.filePath(QStringLiteral("c.png"));
    ASSERT_TRUE(window->convergence().save(png));
    const QImage image(png);
    EXPECT_GE(image.width(), 900);
    int blue = 0; // the curve is drawn
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const QColor c = image.pixelColor(x, y);
            blue += c.blue() > 120 && c.red() < 60 ? 1 : 0;
        }
    }
    EXPECT_GT(blue, 20);
    const QString svg = folder.filePath(QStringLiteral("c.svg"));
    ASSERT_TRUE(window->convergence().save(svg));
    QFile drawing(svg);
    ASSERT_TRUE(drawing.open(QIODevice::ReadOnly));
    const QByteArray text = drawing.readAll();
    EXPECT_TRUE(text.contains("<svg") && text.contains("run time"));
    const QPalette light = QApplication::palette();
    QPalette dark(QColor(45, 45, 45));
    QApplication::setPalette(dark);
    settle();
    QImage shown = window->grab().toImage();
    const QWidget* plot = window->findChild<ConvergencePlot*>();
    const QPoint inside = plot->mapTo(window.get(), QPoint(6, plot->height() / 4));
    EXPECT_LT(QColor(shown.pixel(inside * shown.devicePixelRatio())).lightness(), 110) << "dark in the dark";
    ASSERT_TRUE(window->convergence().save(png));
    EXPECT_GT(QImage(png).pixelColor(3, 3).lightness(), 240) << "but paper is white";
    if (const QByteArray pictures = qgetenv("ATRIUM_PICTURES"); !pictures.isEmpty()) {
        shown.save(QString::fromLocal8Bit(pictures) + QStringLiteral("/convergence_dark.png"));
    }
    QApplication::setPalette(light);
    trigger(ActionId::ShowPicture);
    EXPECT_FALSE(window->convergence().save(folder.filePath(QStringLiteral("no/such/folder.csv"))));
    EXPECT_FALSE(window->convergence().save(folder.filePath(QStringLiteral("no/such/folder.png"))));
    EXPECT_FALSE(window->convergence().save(folder.filePath(QStringLiteral("no/such/folder.svg"))));
}

} // namespace
} // namespace atrium::ui
