#include "ui/panels/convergence_plot.h"

#include <QChart>
#include <QChartView>
#include <QEvent>
#include <QGraphicsLayout>
#include <QLegendMarker>
#include <QLineSeries>
#include <QPainter>
#include <QSaveFile>
#include <QScatterSeries>
#include <QSvgGenerator>
#include <QVBoxLayout>
#include <QValueAxis>

#include <algorithm>
#include <cmath>

namespace atrium::ui {
namespace {

// Told apart by shape and words too, not by colour alone (Okabe and Ito's colours, 2008).
const QColor kLine(0, 114, 178);
const QColor kLineInTheDark(86, 180, 233);
const QColor kUpdates(120, 120, 200);
const QColor kNow(130, 130, 130);

const QColor kMeasured(213, 94, 0);

} // namespace

struct ConvergencePlot::Impl {
    QChart* chart = new QChart;
    QChartView* view = new QChartView(chart);
    QValueAxis* time = new QValueAxis;
    QValueAxis* error = new QValueAxis;
    QLineSeries* now = new QLineSeries;
    QScatterSeries* updates = new QScatterSeries;
    QScatterSeries* measured = new QScatterSeries;
    std::vector<QLineSeries*> bounds; ///< of what was measured, one each
    QColor line_color = kLine;
    std::vector<QLineSeries*> runs; ///< one each, in order; more than are needed stay empty

    /// Line number `index` of a kind, made where there is none yet.
    QLineSeries* line(std::vector<QLineSeries*>& lines, std::size_t index) {
        while (lines.size() <= index) {
            auto* made = new QLineSeries;
            chart->addSeries(made);
            made->attachAxis(time);
            made->attachAxis(error);
            lines.push_back(made);
            name(*made, lines);
        }
        return lines[index];
    }
    void name(QLineSeries& made, const std::vector<QLineSeries*>& lines) {
        const bool is_run = &lines == &runs;
        made.setPen(is_run ? QPen(line_color, 2.0) : QPen(kMeasured, 1.5));
        made.setPointsVisible(is_run);
        made.setName(is_run ? tr("estimate") : QString());
        const bool told = is_run && lines.size() == 1; // once in the legend
        for (QLegendMarker* marker : chart->legend()->markers(&made)) {
            marker->setVisible(told);
        }
    }
    void set_colors(bool dark) {
        line_color = dark ? kLineInTheDark : kLine;
        chart->setTheme(dark ? QChart::ChartThemeDark : QChart::ChartThemeLight);
        for (QLineSeries* run : runs) {
            run->setPen(QPen(line_color, 2.0));
        }
        for (QLineSeries* bound : bounds) {
            bound->setPen(QPen(kMeasured, 1.5));
        }
        measured->setColor(kMeasured);
        measured->setBorderColor(Qt::transparent);
        now->setPen(QPen(kNow, 1.0, Qt::DashLine));
        updates->setColor(kUpdates);
        updates->setBorderColor(Qt::transparent);
        chart->setBackgroundRoundness(0);
    }
};

ConvergencePlot::ConvergencePlot(QWidget* parent) : QWidget(parent), impl_(std::make_unique<Impl>()) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(impl_->view);
    impl_->view->setRenderHint(QPainter::Antialiasing);
    impl_->view->setAccessibleName(tr("Error against run time"));
    setMinimumHeight(160);
    QChart* chart = impl_->chart;
    chart->legend()->setAlignment(Qt::AlignTop);
    chart->legend()->setMarkerShape(QLegend::MarkerShapeFromSeries);
    chart->layout()->setContentsMargins(0, 0, 0, 0);
    chart->setMargins(QMargins(4, 4, 8, 4));
    impl_->time->setTitleText(tr("run time, s"));
    impl_->error->setTitleText(tr("error, %"));
    chart->addAxis(impl_->time, Qt::AlignBottom);
    chart->addAxis(impl_->error, Qt::AlignLeft);
    impl_->updates->setMarkerShape(QScatterSeries::MarkerShapeRectangle);
    impl_->updates->setMarkerSize(6.0);
    impl_->updates->setName(tr("updates"));
    impl_->measured->setName(tr("measured"));
    impl_->measured->setMarkerSize(9.0);
    for (QXYSeries* series : {static_cast<QXYSeries*>(impl_->now), static_cast<QXYSeries*>(impl_->updates),
                              static_cast<QXYSeries*>(impl_->measured)}) {
        chart->addSeries(series);
        series->attachAxis(impl_->time);
        series->attachAxis(impl_->error);
    }
    for (QLegendMarker* marker : chart->legend()->markers(impl_->now)) {
        marker->setVisible(false); // the clock needs no name
    }
    impl_->set_colors(palette().color(QPalette::Window).lightness() < 128);
    show_samples({}, false, -1.0);
}

ConvergencePlot::~ConvergencePlot() = default;

void ConvergencePlot::show_samples(std::span<const ConvergenceSample> samples, bool whole_session, double now) {
    using Kind = ConvergenceSample::Kind;
    double last_time = std::max(now, 0.0);
    double largest = 0.0;
    QList<QPointF> updates;
    QList<QPointF> measured;
    std::vector<QList<QPointF>> bounds;
    std::vector<QList<QPointF>> lines;
    int run = 0;
    for (const ConvergenceSample& sample : samples) {
        const double at = whole_session ? sample.total_seconds : sample.seconds;
        last_time = std::max(last_time, at);
        if (sample.measured > 0.0) {
            const ErrorAudit& audit = sample.statistics.audit;
            measured.append({at, 100.0 * sample.measured});
            bounds.push_back({{at, 100.0 * audit.low}, {at, 100.0 * audit.high}});
            largest = std::max({largest, 100.0 * sample.measured, 100.0 * audit.high});
        }
        if (!(sample.estimate > 0.0)) {
            continue; // not known yet
        }
        const QPointF point(at, 100.0 * sample.estimate);
        largest = std::max(largest, point.y());
        if (sample.kind == Kind::Hurried || sample.kind == Kind::Settled) {
            updates.append(point);
            continue;
        }
        if (lines.empty() || sample.run != run) {
            lines.emplace_back();
            run = sample.run;
        }
        lines.back().append(point);
    }
    const auto fill = [this](std::vector<QLineSeries*>& series, const std::vector<QList<QPointF>>& with) {
        for (std::size_t i = 0; i < std::max(with.size(), series.size()); ++i) {
            impl_->line(series, i)->replace(i < with.size() ? with[i] : QList<QPointF>());
        }
    };
    fill(impl_->runs, lines);
    fill(impl_->bounds, bounds);
    impl_->updates->replace(updates);
    impl_->measured->replace(measured);
    const auto axis = [](QValueAxis* shown, double end, double least) {
        shown->setRange(0.0, std::max(end, least));
        shown->applyNiceNumbers();
        const double step = shown->max() / std::max(shown->tickCount() - 1, 1);
        shown->setLabelFormat(step >= 1.0   ? QStringLiteral("%.0f")
                              : step >= 0.1 ? QStringLiteral("%.1f")
                                            : QStringLiteral("%.2f"));
    };
    axis(impl_->time, last_time * 1.02, 1e-2);
    axis(impl_->error, largest * 1.1, 0.1);
    impl_->now->replace(now >= 0.0 ? QList<QPointF>{{now, 0.0}, {now, impl_->error->max()}} : QList<QPointF>());
}

int ConvergencePlot::points() const {
    qsizetype count = impl_->updates->count() + impl_->measured->count();
    for (const QLineSeries* line : impl_->runs) {
        count += line->count();
    }
    return int(count);
}

Result<void> ConvergencePlot::save(const QString& path) {
    const std::string name = path.toStdString();
    const QSize size = impl_->view->size().expandedTo({480, 270});
    const bool svg = path.endsWith(QLatin1StringView(".svg"), Qt::CaseInsensitive);
    const bool dark = palette().color(QPalette::Window).lightness() < 128;
    impl_->set_colors(false);
    const auto paint = [&](QPainter& painter, const QRectF& area) {
        painter.setRenderHint(QPainter::Antialiasing);
        impl_->view->scene()->render(&painter, area, {}, Qt::IgnoreAspectRatio);
    };
    QSaveFile file(path);
    bool written = file.open(QIODevice::WriteOnly);
    if (written && svg) {
        QSvgGenerator generator;
        generator.setOutputDevice(&file);
        generator.setSize(size);
        generator.setViewBox(QRect(QPoint(0, 0), size));
        generator.setTitle(tr("Error against run time"));
        QPainter painter(&generator);
        paint(painter, QRectF(QPointF(0, 0), QSizeF(size)));
        painter.end();
    } else if (written) {
        QImage image(size * 2, QImage::Format_RGB32);
        image.fill(Qt::white);
        QPainter painter(&image);
        paint(painter, QRectF(image.rect()));
        painter.end();
        written = image.save(&file, "PNG");
    }
    impl_->set_colors(dark);
    if (!written || !file.commit()) {
        return fail(name, "", "could not be written: " + file.errorString().toStdString(),
                    "Choose another folder or free some space.");
    }
    return {};
}

void ConvergencePlot::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && impl_) {
        impl_->set_colors(palette().color(QPalette::Window).lightness() < 128);
    }
}

} // namespace atrium::ui
