#include "ui/panels/convergence_panel.h"

#include "engine/solver/statistics_figures.h"
#include "ui/document/engine_text.h"
#include "ui/panels/convergence_plot.h"
#include "ui/panels/number_parse.h"

#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QSaveFile>
#include <QScrollBar>
#include <QSplitter>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr int kTickMs = 500; // every look makes the window paint, its view included

QString seconds_text(double seconds) {
    return QObject::tr("%1 s").arg(QString::fromStdString(format_number(seconds, seconds < 10.0 ? 3 : 1)));
}

QString share_text(double share) {
    return QObject::tr("%1 %").arg(QString::fromStdString(format_number(100.0 * share, std::abs(share) < 0.1 ? 2 : 1)));
}

QString figure_text(const StatisticsFigure& figure) {
    using Unit = StatisticsFigure::Unit;
    const QLocale locale;
    switch (figure.unit) {
    case Unit::Seconds: return seconds_text(figure.number());
    case Unit::Bytes: return locale.formattedDataSize(qint64(figure.number()));
    case Unit::Lumen: return QObject::tr("%1 lm").arg(locale.toString(figure.number(), 'f', 1));
    case Unit::Share: return share_text(figure.number());
    case Unit::None: break;
    }
    if (const bool* yes = std::get_if<bool>(&figure.value)) {
        return *yes ? QObject::tr("yes") : QObject::tr("no");
    }
    if (std::holds_alternative<double>(figure.value)) {
        return locale.toString(figure.number(), 'g', 3);
    }
    return locale.toString(qlonglong(figure.number()));
}

} // namespace

ConvergencePanel::ConvergencePanel(Document& document, EngineLink& engine, QWidget* parent)
    : QWidget(parent), engine_(engine) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 8, 8, 8);
    auto* top = new QHBoxLayout;
    span_ = new QComboBox;
    span_->setObjectName(QStringLiteral("convergence_span"));
    span_->setAccessibleName(tr("What the plot shows"));
    span_->addItem(tr("Last solution"));
    span_->addItem(tr("Whole session"));
    span_->setToolTip(tr("The way to the present light, or all solutions and updates since the scene was opened"));
    live_ = new QLabel;
    live_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    save_ = new QPushButton(tr("&Save Plot..."));
    save_->setObjectName(QStringLiteral("convergence_save"));
    save_->setToolTip(tr("Save the plot as PNG or SVG, or its figures as CSV"));
    top->addWidget(span_);
    top->addWidget(live_, 1);
    top->addWidget(save_);
    layout->addLayout(top);
    auto* split = new QSplitter(Qt::Horizontal);
    split->setChildrenCollapsible(false);
    plot_ = new ConvergencePlot;
    figures_ = new QTreeWidget;
    figures_->setObjectName(QStringLiteral("convergence_figures"));
    figures_->setColumnCount(3);
    figures_->setHeaderHidden(true);
    figures_->setAccessibleName(tr("Figures of the light, by the names of --stats"));
    figures_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    figures_->header()->setStretchLastSection(true);
    split->addWidget(plot_);
    split->addWidget(figures_);
    split->setStretchFactor(0, 1);
    split->setStretchFactor(1, 0);
    split->setSizes({520, 400});
    layout->addWidget(split, 1);
    tick_.setInterval(kTickMs);
    connect(&tick_, &QTimer::timeout, this, &ConvergencePanel::refresh_live);
    connect(span_, &QComboBox::currentIndexChanged, this, &ConvergencePanel::refresh_plot);
    connect(save_, &QPushButton::clicked, this, &ConvergencePanel::choose_file);
    connect(&document, &Document::reset_done, this, [this] {
        log_.clear();
        last_.reset();
        refresh_plot();
        refresh_figures();
    });
    connect(&engine_, &EngineLink::solution_changed, this, &ConvergencePanel::take_solution);
    connect(&engine_, &EngineLink::status_changed, this, [this] {
        const SessionStatus status = engine_.status();
        const bool solving = status.state == SessionStatus::State::Solving;
        const bool other_phase =
            solving && !status.phase.empty() &&
            (live_phases_.empty() || live_phases_.back().first != status.phase || status.elapsed_seconds < live_elapsed_);
        if (solving != solving_ || other_phase) {
            refresh_live(); // the rest waits for the tick
        }
    });
    take_solution();
    refresh_live();
    refresh_figures();
}

void ConvergencePanel::take_solution() {
    const std::shared_ptr<const Solution> solution = engine_.solution();
    if (!solution || solution == last_) {
        return;
    }
    last_ = solution;
    log_.add(*solution);
    refresh_plot();
    refresh_figures();
}

void ConvergencePanel::refresh_live() {
    const SessionStatus status = engine_.status();
    const bool solving = status.state == SessionStatus::State::Solving;
    const bool switched = solving != solving_;
    solving_ = solving;
    if (solving != tick_.isActive()) {
        solving ? tick_.start() : tick_.stop();
    }
    if (!solving || status.elapsed_seconds < live_elapsed_) { // over, or another run
        live_phases_.clear();
    }
    live_elapsed_ = solving ? status.elapsed_seconds : 0.0;
    if (solving && !status.phase.empty() && (live_phases_.empty() || live_phases_.back().first != status.phase)) {
        live_phases_.emplace_back(status.phase, status.elapsed_seconds);
    }
    if (switched) {
        refresh_figures();
    }
    if (!isVisible()) {
        return; // it looks when it is shown
    }
    live_->setText(solving ? tr("%1 for %2, %3 %")
                                 .arg(QString::fromStdString(status.phase), seconds_text(status.elapsed_seconds))
                                 .arg(int(100.0 * status.fraction))
                           : QString());
    refresh_plot();
    refresh_live_phases();
}

void ConvergencePanel::refresh_live_phases() {
    if (!solving_ || phases_ == nullptr) {
        return;
    }
    // Of the run that goes on the clock tells; its statistics come with its pictures.
    qDeleteAll(phases_->takeChildren());
    for (std::size_t i = 0; i < live_phases_.size(); ++i) {
        const double end = i + 1 < live_phases_.size() ? live_phases_[i + 1].second : live_elapsed_;
        const double length = end - live_phases_[i].second;
        set_row(phases_, QString::fromStdString(live_phases_[i].first), seconds_text(length),
                share_text(length / std::max(live_elapsed_, 1e-6)));
    }
}

void ConvergencePanel::refresh_plot() {
    const auto& all = log_.samples();
    const SessionStatus status = engine_.status();
    // Measuring the error of what is complete is no step on the way.
    const bool solving = status.state == SessionStatus::State::Solving && status.phase != "audit";
    const bool session = span_->currentIndex() == 1;
    std::span<const ConvergenceSample> shown(all);
    double now = -1.0;
    if (!all.empty()) {
        const int run = all.back().run;
        const bool begun = all.back().kind == ConvergenceSample::Kind::First;
        if (solving) { // a run without a picture yet comes after all that is in the log
            now = status.elapsed_seconds;
            if (session) {
                now += begun ? all.back().total_seconds - all.back().seconds : all.back().total_seconds;
            }
        }
        if (!session) {
            const auto first = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.run == run; });
            shown = std::span(all).subspan(std::size_t(first - all.begin()));
        }
    } else if (solving) {
        now = status.elapsed_seconds;
    }
    plot_->show_samples(shown, session, now);
}

void ConvergencePanel::set_row(QTreeWidgetItem* parent, const QString& key, const QString& value, const QString& more) {
    auto* item = new QTreeWidgetItem({key, value, more});
    item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
    parent->addChild(item);
}

void ConvergencePanel::refresh_figures() {
    QStringList closed; // what the reader folded stays folded
    for (int i = 0; i < figures_->topLevelItemCount(); ++i) {
        if (figures_->topLevelItem(i)->childCount() > 0 && !figures_->topLevelItem(i)->isExpanded()) {
            closed.append(figures_->topLevelItem(i)->text(0));
        }
    }
    const int scrolled = figures_->verticalScrollBar()->value();
    figures_->clear();
    phases_ = nullptr;
    auto* root = figures_->invisibleRootItem();
    const auto group = [&](const QString& name) {
        auto* item = new QTreeWidgetItem({name});
        figures_->addTopLevelItem(item);
        item->setExpanded(!closed.contains(name));
        return item;
    };
    if (last_) {
        const Statistics& s = last_->statistics;
        const auto show_times = [&](const Statistics& shown) {
            auto* time = group(QStringLiteral("time"));
            set_row(time, QStringLiteral("build"), seconds_text(shown.time.build));
            set_row(time, QStringLiteral("first_picture"), seconds_text(shown.time.first_picture));
            set_row(time, QStringLiteral("solve"), seconds_text(shown.time.solve));
            phases_ = group(QStringLiteral("phases"));
            for (const Statistics::Phase& phase : shown.phases) {
                set_row(phases_, QString::fromStdString(phase.name), seconds_text(phase.seconds), share_text(phase.share));
            }
        };
        QTreeWidgetItem* parent = nullptr;
        for (const StatisticsFigure& figure : statistics_figures(s)) {
            const QString key = QString::fromStdString(figure.key);
            const qsizetype point = key.indexOf(QLatin1Char('.'));
            if (point < 0) {
                set_row(root, key, figure_text(figure));
                continue;
            }
            if (phases_ == nullptr && key.startsWith(QLatin1StringView("memory."))) { // after the counts
                show_times(s);
            }
            if (parent == nullptr || parent->text(0) != key.left(point)) {
                parent = group(key.left(point));
            }
            set_row(parent, key.mid(point + 1), figure_text(figure));
        }
    } else if (solving_) {
        phases_ = group(QStringLiteral("phases"));
    } else {
        root->addChild(new QTreeWidgetItem({tr("No light yet")}));
    }
    refresh_live_phases();
    figures_->verticalScrollBar()->setValue(scrolled);
}

void ConvergencePanel::choose_file() {
    auto* dialog =
        new QFileDialog(this, tr("Save Plot"), QString(), tr("PNG picture (*.png);;SVG drawing (*.svg);;CSV table (*.csv)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setFileMode(QFileDialog::AnyFile);
    dialog->setDefaultSuffix(QStringLiteral("png"));
    dialog->selectFile(tr("convergence.png"));
    connect(dialog, &QFileDialog::filterSelected, dialog, [dialog](const QString& filter) {
        for (const char* suffix : {"png", "svg", "csv"}) {
            if (filter.contains(QStringLiteral("*.") + QLatin1StringView(suffix))) {
                dialog->setDefaultSuffix(QLatin1StringView(suffix));
            }
        }
    });
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) {
        const auto saved = save(path);
        Q_EMIT message(saved ? tr("Written to %1.").arg(path) : error_message(saved.error()));
    });
    dialog->open();
}

Result<void> ConvergencePanel::save(const QString& path) {
    if (!path.endsWith(QLatin1StringView(".csv"), Qt::CaseInsensitive)) {
        return plot_->save(path);
    }
    QSaveFile file(path);
    const std::string text = log_.csv();
    if (!file.open(QIODevice::WriteOnly) || file.write(text.data(), qint64(text.size())) < 0 || !file.commit()) {
        return fail(path.toStdString(), "", "could not be written: " + file.errorString().toStdString(),
                    "Choose another folder or free some space.");
    }
    return {};
}

void ConvergencePanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    refresh_live();
}

} // namespace atrium::ui
