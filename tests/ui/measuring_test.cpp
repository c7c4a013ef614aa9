// What lighting designers read off the view: false colour and measuring points, by the controls that they use.
#include "window_fixture.h"

#include "engine/solver/gi_engine.h"
#include "engine/view/false_color.h"
#include "ui/viewport/light_meter.h"
#include "ui/window/export_picture_dialog.h"
#include "ui/window/false_color_bar.h"

#include <QAction>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QGuiApplication>
#include <QProcess>
#include <QSignalSpy>
#include <QUndoStack>

#include <cmath>

namespace atrium::ui {
namespace {

class Measuring : public WindowTest {
protected:
    void open_lit() {
        open_sample();
        const auto complete = [&] { // with its error
            const auto light = window->engine().solution();
            return light && light->final && light->statistics.audit.points > 0;
        };
        ASSERT_TRUE(QTest::qWaitFor(complete, 400000)); // a patience, not a measurement
        settle();
    }
    [[nodiscard]] std::optional<FalseColor> shown() { return window->viewport().false_color(); }
    void click(const QPoint& point) {
        QTest::mouseMove(&window->viewport(), point);
        settle();
        QTest::mouseClick(&window->viewport(), Qt::LeftButton, {}, point);
        settle();
    }
    [[nodiscard]] const std::vector<MeasuringPoints::Point>& points() {
        return window->viewport().measuring_points().points();
    }
    /// Middle of the view, or near it, where there is light to be read.
    QPoint lit_point() {
        const QPoint middle = window->viewport().rect().center();
        for (int step = 0; step < 40; ++step) {
            const QPoint point = middle + QPoint(0, 6 * step);
            if (window->viewport().light_at(point)) {
                return point;
            }
        }
        ADD_FAILURE() << "nothing lit in view";
        return middle;
    }
};

TEST_F(Measuring, TheScaleFitsTheSceneAndIsSetByHandWithUnits) {
    open_lit();
    auto* bar = &window->false_color_bar();
    EXPECT_FALSE(bar->isVisible());
    trigger(ActionId::ShowIlluminance);
    EXPECT_TRUE(bar->isVisible());
    ASSERT_TRUE(QTest::qWaitFor([&] { return shown() && shown()->maximum != 500.0 && shown()->minimum > 1e-5; }, 20000));
    // Its ends are around what is there: the fullest tenth of the surfaces is neither off the scale nor at its foot.
    const auto reading = window->viewport().light_at(lit_point());
    ASSERT_TRUE(reading);
    EXPECT_GT(shown()->maximum, 0.3 * reading->light.illuminance);
    EXPECT_LT(shown()->minimum, 3.0 * reading->light.illuminance);
    EXPECT_EQ(shown()->maximum, round_up(shown()->maximum));

    type(field("false_color_to"), "1,5 klx");
    EXPECT_FALSE(window->findChild<QCheckBox*>(QStringLiteral("false_color_automatic"))->isChecked());
    type(field("false_color_from"), "0.02 klx");
    EXPECT_NEAR(shown()->maximum, 1500.0, 1e-9);
    EXPECT_NEAR(shown()->minimum, 20.0, 1e-9);
    auto* kind = window->findChild<QComboBox*>(QStringLiteral("false_color_kind"));
    kind->setCurrentIndex(0);
    Q_EMIT kind->activated(0);
    EXPECT_FALSE(shown()->logarithmic);
    trigger(ActionId::Contours);
    EXPECT_TRUE(shown()->contours);

    trigger(ActionId::ShowLuminance); // with a scale of its own
    EXPECT_EQ(shown()->quantity, LightQuantity::Luminance);
    EXPECT_TRUE(window->findChild<QCheckBox*>(QStringLiteral("false_color_automatic"))->isChecked());
    trigger(ActionId::ShowPicture);
    EXPECT_FALSE(shown());
    EXPECT_FALSE(bar->isVisible());
    EXPECT_FALSE(window->action(ActionId::Contours)->isEnabled());

    trigger(ActionId::ShowIlluminance);
    TearDown();
    SetUp(); // another run of the program
    ASSERT_TRUE(shown());
    EXPECT_EQ(shown()->quantity, LightQuantity::Illuminance);
    EXPECT_NEAR(shown()->maximum, 1500.0, 1e-9);
    EXPECT_FALSE(shown()->logarithmic);
    EXPECT_TRUE(shown()->contours);
    EXPECT_TRUE(window->action(ActionId::ShowIlluminance)->isChecked());
    trigger(ActionId::Contours);
    trigger(ActionId::ShowPicture);
}

TEST_F(Measuring, APointSaysWhatTheSolutionHoldsThereAndWhatCameWhichWay) {
    open_lit();
    trigger(ActionId::ToolMeasure);
    const QPoint at_screen = lit_point();
    click(at_screen);
    ASSERT_EQ(points().size(), 1U);
    ASSERT_TRUE(points()[0].reading);
    const MeterReading reading = *points()[0].reading;
    EXPECT_LT((at(reading.point) - at_screen).manhattanLength(), 3);
    const SensorReading stated = read_surface(scene(), *window->engine().solution(), reading.point, reading.normal);
    ASSERT_TRUE(stated.on_surface);
    const double truth = double(luminance(stated.irradiance));
    EXPECT_GT(truth, 1.0);
    EXPECT_NEAR(reading.light.illuminance, truth, 1e-4 * truth);
    // The error is that of the places like this one: in the open less than that of the scene.
    const auto error = window->engine().local_error();
    ASSERT_TRUE(error);
    EXPECT_GT(error->size(), 100U);
    const double here = truth * error->at(reading.point, reading.normal, truth);
    EXPECT_NEAR(reading.light.standard_error, here, 1e-3 * here);
    EXPECT_GT(reading.light.standard_error, 0.0);
    EXPECT_NE(reading.light.standard_error, stated.standard_error);
    EXPECT_NEAR(reading.light.direct + reading.light.diffuse + reading.light.caustic, truth, 1e-4 * truth);
    const QStringList lines = reading_lines(reading.light);
    ASSERT_EQ(lines.size(), 3);
    EXPECT_TRUE(lines[0].contains(QStringLiteral("lx")) && lines[0].contains(QChar(0xB1)));
    EXPECT_EQ(window->document().selection()->nodes().size(), 0U) << "measuring selects nothing";
    EXPECT_EQ(entries(), 0) << "and changes nothing";
}

TEST_F(Measuring, PointsFollowTheLightAndTheirObjectAreCopiedAndRemoved) {
    open_lit();
    trigger(ActionId::ToolMeasure);
    const QPoint first = lit_point();
    click(first);
    click(first + QPoint(40, 0));
    ASSERT_EQ(points().size(), 2U);
    const double before = points()[0].reading->light.illuminance;
    const dvec3 place = points()[0].reading->point;

    trigger(ActionId::CopyPoints);
    const QStringList lines = QGuiApplication::clipboard()->text().trimmed().split(QLatin1Char('\n'));
    ASSERT_EQ(lines.size(), 3);
    EXPECT_TRUE(lines[0].startsWith(QStringLiteral("point,x,y,z,nx,ny,nz,E_r,E_g,E_b,E,stderr,on_surface,")));
    const QStringList cells = lines[1].split(QLatin1Char(','));
    EXPECT_EQ(cells.size(), lines[0].split(QLatin1Char(',')).size());
    EXPECT_NEAR(cells[10].toDouble(), before, 1e-6 * before);
    EXPECT_NEAR(cells[1].toDouble(), place.x, 1e-6);

    // All lamps at a third of their light.
    const Scene bright = scene();
    bright.lights.for_each([&](LightId id, const Light& light) {
        Light weaker = light;
        weaker.intensity /= 3.0F;
        EXPECT_TRUE(window->document().apply({SetResource<Light>{id, weaker}}, QStringLiteral("Dim")));
    });
    bright.materials.for_each([&](MaterialId id, const Material& material) {
        Material weaker = material;
        weaker.emissive_strength /= 3.0F;
        EXPECT_TRUE(window->document().apply({SetResource<Material>{id, weaker}}, QStringLiteral("Dim")));
    });
    Environment night = bright.environment;
    night.sky_radiance /= 3.0F;
    EXPECT_TRUE(window->document().apply({SetEnvironment{night}}, QStringLiteral("Dim")));
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            return !window->engine().stale() && points()[0].reading && points()[0].reading->light.illuminance < 0.6 * before;
        },
        60000))
        << "the figure follows the light";

    click(first); // on its mark
    ASSERT_EQ(points().size(), 1U);
    EXPECT_EQ(points()[0].number, 2) << "numbers stay";
    trigger(ActionId::RemovePoints);
    EXPECT_TRUE(points().empty());
}

TEST_F(Measuring, AgreesWithTheCommandLineAtTheSamePoint) {
    open_lit();
    const QString project = folder.filePath(QStringLiteral("room.atrium"));
    bool saved = false;
    window->files().save_to(project, [&](bool ok) { saved = ok; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return saved; }, 20000));
    QSignalSpy opened(&window->files(), &FileController::opened);
    window->files().open(project); // both read what the file holds
    ASSERT_TRUE(opened.wait(20000));
    ASSERT_TRUE(QTest::qWaitFor([&] { return window->viewport().shown_solution() != nullptr; }, 20000));
    settle();
    trigger(ActionId::ToolMeasure);
    const QPoint first = lit_point();
    for (const QPoint& point : {first, first + QPoint(60, 0), first + QPoint(-60, 30)}) {
        click(point);
    }
    const MeasuringPoints& measured = window->viewport().measuring_points();
    ASSERT_GE(measured.points().size(), 2U);
    QFile file(folder.filePath(QStringLiteral("points.csv")));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(measured.csv())); // its columns are found by name
    file.close();
    QProcess cli;
    cli.start(QStringLiteral(ATRIUM_CLI), {QStringLiteral("measure"), project, QStringLiteral("--points"), file.fileName(),
                                           QStringLiteral("--on-surface")});
    ASSERT_TRUE(cli.waitForFinished(60000));
    ASSERT_EQ(cli.exitCode(), 0) << cli.readAllStandardError().toStdString();
    const QList<QByteArray> rows = cli.readAllStandardOutput().trimmed().split('\n');
    ASSERT_EQ(std::size_t(rows.size()), measured.points().size() + 1);
    for (std::size_t i = 0; i < measured.points().size(); ++i) {
        const LightReading& light = measured.points()[i].reading->light;
        const QList<QByteArray> cells = rows[qsizetype(i) + 1].split(',');
        EXPECT_NEAR(cells[9].toDouble(), light.illuminance, 1e-4 * light.illuminance) << i;
        EXPECT_GT(cells[10].toDouble(), 0.0) << i; // of the whole scene; the window's is of that place once it is known
    }
}

TEST_F(Measuring, ExportedPicturesHaveTheColoursAndTheLegendOfTheView) {
    open_lit();
    trigger(ActionId::ShowIlluminance);
    type(field("false_color_from"), "1");
    type(field("false_color_to"), "1000");
    settle();
    trigger(ActionId::ExportPicture);
    auto* settings = dialog<ExportPictureDialog>();
    ASSERT_NE(settings, nullptr);
    const auto fields = settings->findChildren<NumberField*>();
    ASSERT_EQ(fields.size(), 4);
    EXPECT_FALSE(settings->findChild<QCheckBox*>()->isEnabled()) << "false colour shows the layers, not a final pass";
    type(fields[0], "320");
    type(fields[1], "200");
    type(fields[2], "1");
    const QString path = folder.filePath(QStringLiteral("lux.png"));
    settings->render(path);
    ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(path); }, 30000));
    const QImage picture(path);
    ASSERT_EQ(picture.size(), QSize(320, 200));
    const auto of_map = [](const QColor& c) { // how far from the nearest colour of the scale
        int nearest = 1000;
        for (const std::uint32_t entry : color_map()) {
            nearest = std::min(nearest, std::abs(c.red() - int(entry >> 16U & 0xFFU)) +
                                            std::abs(c.green() - int(entry >> 8U & 0xFFU)) +
                                            std::abs(c.blue() - int(entry & 0xFFU)));
        }
        return nearest;
    };
    int colored = 0;
    for (int x = 0; x < 150; ++x) {
        colored += of_map(picture.pixelColor(x, 100)) <= 6 ? 1 : 0;
    }
    EXPECT_GT(colored, 140) << "nothing but amounts";
    int plate = 0;
    for (int y = 0; y < 200; ++y) {
        plate += picture.pixelColor(310, y).lightness() > 215 ? 1 : 0;
    }
    EXPECT_GT(plate, 60) << "the legend's plate";
    trigger(ActionId::ShowPicture);
}

} // namespace
} // namespace atrium::ui
