#include "ui/panels/jobs_panel.h"

#include "engine/solver/memory_budget.h"
#include "ui/document/engine_text.h"
#include "ui/panels/elided_label.h"
#include "ui/panels/number_parse.h"
#include "ui/panels/quality_section.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <cmath>

namespace atrium::ui {

namespace {

QString seconds_text(double seconds) {
    if (seconds < 10) {
        return QObject::tr("%1 s").arg(QString::fromStdString(format_number(seconds, 1)));
    }
    const int whole = int(std::lround(seconds));
    return whole < 60 ? QObject::tr("%1 s").arg(whole)
                      : QObject::tr("%1 min %2 s").arg(whole / 60).arg(whole % 60, 2, 10, QLatin1Char('0'));
}

QString percent_text(double share) {
    return QObject::tr("%1 %").arg(QString::fromStdString(format_number(share * 100, share < 0.1 ? 1 : 0)));
}

QString phase_text(const std::string& phase) {
    static const std::pair<const char*, const char*> kNames[] = {
        {"ray_scene", QT_TRANSLATE_NOOP("atrium::ui::JobsPanel", "Preparing rays")},
        {"charts", QT_TRANSLATE_NOOP("atrium::ui::JobsPanel", "Unrolling surfaces")},
        {"direct", QT_TRANSLATE_NOOP("atrium::ui::JobsPanel", "Finding shadows")},
        {"leaf_gather", QT_TRANSLATE_NOOP("atrium::ui::JobsPanel", "Looking closer")},
        {"hierarchy", QT_TRANSLATE_NOOP("atrium::ui::JobsPanel", "Dividing surfaces")},
        {"links", QT_TRANSLATE_NOOP("atrium::ui::JobsPanel", "Finding what sees what")},
        {"visibility", QT_TRANSLATE_NOOP("atrium::ui::JobsPanel", "Tracing visibility")},
        {"gather", QT_TRANSLATE_NOOP("atrium::ui::JobsPanel", "Gathering light")},
        {"layers", QT_TRANSLATE_NOOP("atrium::ui::JobsPanel", "Painting light onto surfaces")},
        {"audit", QT_TRANSLATE_NOOP("atrium::ui::JobsPanel", "Measuring the error")},
    };
    for (const auto& [name, text] : kNames) {
        if (phase == name) {
            return JobsPanel::tr(text);
        }
    }
    return QString::fromStdString(phase);
}

QString feature_text(const std::string& name) { return engine_text(name).replace(QLatin1Char('_'), QLatin1Char(' ')); }

QColor state_color(LightState state) {
    // Told apart by lightness too, and never without the word beside it.
    switch (state) {
    case LightState::Solving: return QColor(0x3b, 0x8e, 0xd0);
    case LightState::Moving: return QColor(0x8a, 0x6f, 0xd6);
    case LightState::Settling: return QColor(0x5a, 0xb4, 0xe0);
    case LightState::Refining: return QColor(0x3f, 0xa3, 0x8b);
    case LightState::UpToDate: return QColor(0x3f, 0xa3, 0x5b);
    case LightState::Stale: return QColor(0xe0, 0xa0, 0x20);
    case LightState::Stopped: return QColor(0x90, 0x90, 0x90);
    case LightState::Failed: return QColor(0xc8, 0x3c, 0x32);
    case LightState::Empty: break;
    }
    return QColor(0xb0, 0xb0, 0xb0);
}

} // namespace

QString lowered_by_memory_text(const Statistics& statistics) {
    QStringList names;
    for (const std::string& name : lowered_by_memory(statistics.features)) {
        names.append(feature_text(name));
    }
    return names.isEmpty()
               ? QString()
               : JobsPanel::tr("The light is coarser than its quality asks for, to stay within the memory that it "
                               "may take. Left out: %1.\nEdit > Preferences gives it more.")
                     .arg(names.join(JobsPanel::tr(", ", "between items of a list")));
}

LightState light_state(const EngineLink& engine) {
    const SessionStatus status = engine.status();
    switch (status.state) {
    case SessionStatus::State::Solving:
        if (status.preparing) {
            return LightState::UpToDate; // what is shown is complete
        }
        return status.moving     ? LightState::Moving
               : status.settling ? LightState::Settling
               : status.refining ? LightState::Refining
                                 : LightState::Solving;
    case SessionStatus::State::Failed: return LightState::Failed;
    case SessionStatus::State::Stopped: return engine.stale() ? LightState::Stopped : LightState::UpToDate;
    case SessionStatus::State::Idle: break;
    }
    if (!engine.solution()) {
        return LightState::Empty;
    }
    return engine.stale() ? LightState::Stale : LightState::UpToDate;
}

QString light_state_text(const EngineLink& engine) {
    const SessionStatus status = engine.status();
    switch (light_state(engine)) {
    case LightState::Solving: return JobsPanel::tr("Solving %1 %").arg(int(std::floor(status.fraction * 100)));
    case LightState::Moving: return JobsPanel::tr("Light follows");
    case LightState::Settling: return JobsPanel::tr("Settling %1 %").arg(int(std::floor(status.fraction * 100)));
    case LightState::Refining: return JobsPanel::tr("Settled, refining %1 %").arg(int(std::floor(status.fraction * 100)));
    case LightState::UpToDate: return JobsPanel::tr("Light up to date");
    case LightState::Stale: return JobsPanel::tr("Light out of date");
    case LightState::Stopped: return JobsPanel::tr("Light stopped");
    case LightState::Failed: return JobsPanel::tr("Light failed");
    case LightState::Empty: break;
    }
    return JobsPanel::tr("No light yet");
}

JobsPanel::JobsPanel(Document& document, EngineLink& engine, QWidget* parent) : QWidget(parent), engine_(engine) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 8, 8, 8);
    auto* top = new QHBoxLayout;
    state_ = new ElidedLabel;
    state_->setObjectName(QStringLiteral("job_state"));
    QFont bold = state_->font();
    bold.setBold(true);
    state_->setFont(bold);
    toggle_ = new QPushButton;
    toggle_->setObjectName(QStringLiteral("job_toggle"));
    top->addWidget(state_, 1);
    top->addWidget(toggle_);
    layout->addLayout(top);
    bar_ = new QProgressBar;
    bar_->setRange(0, 1000);
    bar_->setTextVisible(false);
    bar_->setMaximumHeight(10);
    bar_->setAccessibleName(tr("Progress of the light"));
    layout->addWidget(bar_);
    // A line each, always there: side by side a narrow dock has no room for both, and lines that come and go move what is
    // below them.
    phase_ = new ElidedLabel;
    phase_->setObjectName(QStringLiteral("job_phase"));
    times_ = new ElidedLabel;
    times_->setObjectName(QStringLiteral("job_times"));
    auto* lines = new QVBoxLayout;
    lines->setSpacing(1);
    lines->addWidget(phase_);
    lines->addWidget(times_);
    layout->addLayout(lines);
    auto* quality = new QualitySection(document);
    connect(quality, &Section::message, this, &JobsPanel::message);
    layout->addWidget(quality);
    figures_ = new QTreeWidget;
    figures_->setColumnCount(2);
    figures_->setHeaderHidden(true);
    figures_->setRootIsDecorated(true);
    figures_->setWordWrap(true);
    figures_->setAccessibleName(tr("Figures of the solution"));
    figures_->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
    layout->addWidget(figures_, 1);
    tick_.setInterval(250);
    connect(&tick_, &QTimer::timeout, this, &JobsPanel::refresh_status);
    connect(toggle_, &QPushButton::clicked, this, [this] {
        if (engine_.status().state == SessionStatus::State::Solving) {
            engine_.cancel();
        } else {
            engine_.resume();
        }
    });
    connect(&engine_, &EngineLink::status_changed, this, &JobsPanel::refresh_status);
    connect(&engine_, &EngineLink::solution_changed, this, &JobsPanel::refresh_figures);
    refresh_status();
    refresh_figures();
}

void JobsPanel::refresh_status() {
    const SessionStatus status = engine_.status();
    const bool solving = status.state == SessionStatus::State::Solving;
    if (solving != tick_.isActive()) {
        solving ? tick_.start() : tick_.stop();
    }
    state_->set_text(light_state_text(engine_));
    toggle_->setText(solving ? tr("Stop") : tr("Resume"));
    toggle_->setEnabled(solving || engine_.stale());
    // QProgressBar paints at once when its value changes, and the whole window with its 3D view comes along: 30 to 400 ms in
    // software, twenty times a second. With updates off it waits for the next frame like everything else.
    bar_->setUpdatesEnabled(false);
    bar_->setValue(solving ? int(status.fraction * 1000) : (engine_.stale() ? 0 : 1000));
    bar_->setUpdatesEnabled(true);
    QString phase;
    if (solving) {
        phase = phase_text(status.phase);
        if (status.preparing) {
            phase = tr("Getting ready to follow edits: %1").arg(phase);
        }
    } else if (status.state == SessionStatus::State::Failed) {
        phase = engine_text(status.message);
    }
    phase_->set_text(phase);
    QString times;
    if (solving || status.elapsed_seconds > 0) {
        times = seconds_text(status.elapsed_seconds);
        if (solving && status.remaining_seconds >= 0) {
            times += tr(", about %1 left").arg(seconds_text(status.remaining_seconds));
        }
        if (solving && !status.preparing && engine_.solution()) {
            times += tr(" (the picture is older)");
        }
    }
    times_->set_text(times);
}

void JobsPanel::refresh_figures() {
    figures_->clear();
    const std::shared_ptr<const Solution> solution = engine_.solution();
    if (!solution) {
        figures_->addTopLevelItem(new QTreeWidgetItem({tr("No solution yet")}));
        return;
    }
    const Statistics& s = solution->statistics;
    const QLocale locale;
    const auto row = [this](const QString& name, const QString& value) {
        auto* item = new QTreeWidgetItem({name, value});
        figures_->addTopLevelItem(item);
        return item;
    };
    if (s.audit.points > 0) {
        auto* error = row(
            tr("Error"),
            tr("%1 (%2 to %3)").arg(percent_text(s.error_estimate), percent_text(s.audit.low), percent_text(s.audit.high)));
        error->setToolTip(1, tr("Root mean square over all surfaces, measured at %L1 places against brute force; it lies "
                                "between the bounds 95 times in 100.")
                                 .arg(s.audit.points));
        row(tr("Error of the mean"),
            tr("%1%2").arg(s.audit.bias < 0 ? tr("\u2212") : tr("+"), percent_text(std::abs(s.audit.bias))));
    } else {
        row(tr("Error"), tr("not measured yet"));
    }
    row(tr("Solved in"), seconds_text(s.time.total > 0 ? s.time.total : s.time.solve));
    row(tr("Iterations"), tr("%1, %2").arg(s.iterations).arg(s.converged ? tr("converged") : tr("not converged")));
    row(tr("Elements"), locale.toString(qulonglong(s.elements)));
    row(tr("Links"), locale.toString(qulonglong(s.links)));
    row(tr("Rays"), locale.toString(qulonglong(s.rays)));
    row(tr("Light emitted"), tr("%1 lm").arg(locale.toString(s.energy.emitted, 'f', 0)));
    const std::uint64_t memory = s.memory.elements + s.memory.links + s.memory.layers + s.memory.ray_scene +
                                 s.memory.particles + s.memory.octree + s.memory.caustic_textures;
    row(tr("Memory"), locale.formattedDataSize(qint64(memory)));
    auto* phases = row(tr("Phases"), QString());
    for (const Statistics::Phase& phase : s.phases) {
        phases->addChild(new QTreeWidgetItem({phase_text(phase.name), seconds_text(phase.seconds)}));
    }
    auto* left_out = row(tr("Left out"), QString());
    auto* used = row(tr("In use"), QString());
    for (const Feature& feature : s.features) {
        auto* item = new QTreeWidgetItem({feature_text(feature.name), engine_text(feature.why)});
        item->setToolTip(1, item->text(1));
        (feature.used ? used : left_out)->addChild(item);
    }
    left_out->setText(1, locale.toString(left_out->childCount()));
    used->setText(1, locale.toString(used->childCount()));
    left_out->setExpanded(true);
}

LightBadge::LightBadge(EngineLink& engine, QWidget* parent) : QWidget(parent), engine_(engine) {
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(4, 0, 4, 0);
    layout->setSpacing(6);
    dot_ = new QLabel;
    text_ = new QLabel;
    text_->setObjectName(QStringLiteral("light_state"));
    // Room for what changes many times a second: a label that grows is cut until the status bar comes to lay itself out.
    text_->setMinimumWidth(text_->fontMetrics().horizontalAdvance(JobsPanel::tr("Settled, refining %1 %").arg(100)));
    layout->addWidget(dot_);
    layout->addWidget(text_);
    connect(&engine_, &EngineLink::status_changed, this, &LightBadge::refresh);
    connect(&engine_, &EngineLink::solution_changed, this, &LightBadge::refresh);
    refresh();
}

void LightBadge::refresh() {
    QString text = light_state_text(engine_);
    const std::shared_ptr<const Solution> solution = engine_.solution();
    // While the next light is on its way the figure would be that of the last one.
    if (light_state(engine_) == LightState::UpToDate && solution && solution->statistics.audit.points > 0) {
        text += tr(", typical error %1").arg(percent_text(solution->statistics.audit.typical));
    }
    text_->setText(text);
    const qreal ratio = devicePixelRatioF();
    QPixmap picture(QSize(10, 10) * ratio);
    picture.setDevicePixelRatio(ratio);
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(state_color(light_state(engine_)));
    painter.drawEllipse(QRectF(0.5, 0.5, 9, 9));
    painter.end();
    dot_->setPixmap(picture);
}

} // namespace atrium::ui
