#include "ui/panels/quality_section.h"

#include "engine/solver/quality.h"
#include "ui/panels/automatic_text.h"
#include "ui/panels/quiet_combo.h"

#include <QLabel>
#include <QPushButton>
#include <QToolButton>

#include <algorithm>

namespace atrium::ui {
namespace {

// Anything may be typed: what a threshold has no use for is taken as the nearest value that it has (within_range()).
constexpr double kAny = 1e12;

NumberFormat length_format() {
    NumberFormat out = NumberFormat::length(-kAny);
    out.maximum = kAny;
    out.proportional = true;
    out.step = 0.001;
    return out;
}

NumberFormat percent_format(int decimals) {
    NumberFormat out = NumberFormat::plain(-kAny, kAny, decimals, QStringLiteral(" %"));
    out.display_factor = 100.0;
    out.proportional = true;
    out.step = 1e-6;
    return out;
}

NumberFormat count_format(double step) {
    NumberFormat out = NumberFormat::plain(-kAny, kAny, 0);
    out.proportional = true;
    out.step = step;
    return out;
}

} // namespace

QualitySection::QualitySection(Document& document) : Section(tr("Quality"), document) {
    QComboBox* wish = add_choice(
        tr("Light quality"), {tr("Draft: fast"), tr("Normal"), tr("Fine: slow")},
        [this] { return std::vector<int>{int(scene().settings.quality)}; },
        [this](int index) {
            SolverSettings settings = scene().settings;
            settings.quality = SolverSettings::Quality(index);
            return SceneEdit{SetSolverSettings{settings}};
        });
    wish->setToolTip(tr("One wish for everything: elements, links, rays, mesh, shadows, particles"));
    opener_ = new QToolButton;
    opener_->setObjectName(QStringLiteral("thresholds"));
    opener_->setCheckable(true);
    opener_->setAutoRaise(true);
    opener_->setArrowType(Qt::RightArrow);
    opener_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    opener_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    opener_->setToolTip(tr("What the wish stands for in this scene. Every threshold can be set by hand"));
    connect(opener_, &QToolButton::toggled, this, [this](bool on) {
        opener_->setArrowType(on ? Qt::DownArrow : Qt::RightArrow);
        refresh();
    });
    add_row(QString(), opener_);
    add_thresholds();
    reset_ = new QPushButton(tr("Reset to Automatic"));
    reset_->setObjectName(QStringLiteral("thresholds_reset"));
    connect(reset_, &QPushButton::clicked, this, [this] {
        SolverSettings settings = scene().settings;
        settings.thresholds = {};
        apply(SceneEdit{SetSolverSettings{settings}}, tr("Reset thresholds to automatic"));
    });
    add_row(QString(), reset_, [this] { return open(); });
    connect(&document, &Document::edited, this, [this] { refresh(); });
    connect(&document, &Document::gesture_finished, this, [this] { refresh(); });
    connect(&document, &Document::reset_done, this, [this] { refresh(); });
    refresh();
}

void QualitySection::add_thresholds() {
    using T = SolverThresholds;
    const auto add = [this](float T::*value, const QString& label, const NumberFormat& format, const QString& hint) {
        const auto info = std::find_if(kThresholds.begin(), kThresholds.end(),
                                       [value](const ThresholdInfo& one) { return one.value == value; });
        add_threshold(*info, label, format, hint);
    };
    add(&T::element_edge, tr("Element size"), length_format(),
        tr("Elements of a surface are not divided whose longer edge is below twice this"));
    add(&T::link_share, tr("Link threshold"), percent_format(4),
        tr("Share of the light in a room: what goes between two elements is looked at more closely until it is known this "
           "well"));
    add(&T::leaf_contrast, tr("Element contrast"), percent_format(1),
        tr("Elements are divided on which reflected light differs by more than this"));
    add(&T::mesh_edge, tr("Mesh edge"), length_format(), tr("Edges of the shown mesh are not split below this"));
    add(&T::mesh_contrast, tr("Mesh contrast"), percent_format(1),
        tr("Edges of the shown mesh are split whose middle differs by more than this from what is between its ends"));
    add(&T::shadow_texel, tr("Shadow texel"), length_format(),
        tr("How sharp edges of shadows become; taken to the next step of two"));
    add(&T::reflected_rays, tr("Reflection rays"), count_format(1),
        tr("Rays of a first look round for reflected light; where they disagree up to four times as many"));
    add(&T::particles, tr("Particles"), count_format(100), tr("Sent over mirrors and glass at most"));
    add(&T::caustic_dispersion, tr("Caustic threshold"), NumberFormat::plain(-kAny, kAny, 2),
        tr("Standard deviations by which light must be more uneven than chance to get a texture; surfaces may have their "
           "own "
           "in the caustic inspector"));
}

void QualitySection::add_threshold(const ThresholdInfo& info, const QString& label, const NumberFormat& format,
                                   const QString& hint) {
    auto owned = std::make_unique<Row>(Row{&info, format, nullptr, nullptr, new QLabel});
    Row* row = owned.get();
    rows_.push_back(std::move(owned));
    row->field = add_number(
        label, format,
        [this, &info] {
            return open() ? std::vector<double>{double(scene().settings.thresholds.*info.value)} : std::vector<double>{};
        },
        [this, row](double value) {
            SolverSettings settings = scene().settings;
            settings.thresholds.*row->info->value = within_range(*row, value);
            return SceneEdit{SetSolverSettings{settings}};
        });
    row->automatic = new AutomaticText(row->field, 0.0, hint);
    row->note->setObjectName(QStringLiteral("%1 note").arg(label));
    row->note->setWordWrap(true);
    row->note->setAlignment(Qt::AlignRight);
    row->note->setVisible(false);
    add_row(QString(), row->note, [this, row] { return open() && !row->note->text().isEmpty(); });
    connect(row->field, &QLineEdit::textEdited, this, [this, row] { say(*row, {}); });
}

float QualitySection::within_range(Row& row, double entered) {
    if (entered == 0.0) {
        say(row, {});
        return 0.0F; // automatic
    }
    const ThresholdInfo& info = *row.info;
    const float used = std::clamp(float(entered), info.least, info.most);
    QString note;
    if (used != float(entered)) {
        const auto text = [&](float value) {
            return QString::fromStdString(format_number(double(value) * row.format.display_factor, row.format.decimals)) +
                   row.format.suffix;
        };
        note = tr("%1 to %2 are possible: %3 is used").arg(text(info.least), text(info.most), text(used));
        Q_EMIT message(QStringLiteral("%1: %2").arg(row.field->objectName(), note));
    }
    row.noted = used;
    say(row, note);
    return used;
}

void QualitySection::say(Row& row, const QString& note) {
    row.note->setText(note);
    row.note->setVisible(open() && !note.isEmpty());
    row.field->setAccessibleDescription(note); // those who listen are told that it changed
}

bool QualitySection::open() const { return opener_ != nullptr && opener_->isChecked(); }

void QualitySection::refresh_more() {
    const SolverThresholds& set = scene().settings.thresholds;
    const auto by_hand = int(std::count_if(kThresholds.begin(), kThresholds.end(),
                                           [&](const ThresholdInfo& info) { return set.*info.value > 0.0F; }));
    opener_->setText(by_hand == 0 ? tr("Thresholds: automatic") : tr("Thresholds: %n set by hand", nullptr, by_hand));
    reset_->setEnabled(by_hand > 0);
    for (const auto& row : rows_) {
        if (set.*row->info->value != row->noted && !row->note->text().isEmpty()) {
            say(*row, {}); // undone, or set elsewhere
        }
    }
    if (open()) {
        show_automatic();
    }
}

void QualitySection::show_automatic() {
    if (!document().in_gesture()) { // the size of a scene is not found while one moves its objects
        const DBox3 box = scene().bounds();
        diagonal_ = box.empty() ? 0.0F : float(box.diagonal());
    }
    if (!(diagonal_ > 0.0F)) {
        return;
    }
    const SolverThresholds automatic = thresholds_of(quality_settings(scene().settings.quality, diagonal_, 0.0));
    for (const auto& row : rows_) {
        const double shown = double(automatic.*row->info->value) * row->format.display_factor;
        const int decimals = shown >= 100 ? 0 : shown >= 1 ? 1 : row->format.decimals;
        row->automatic->set_amount(QString::fromStdString(format_number(shown, decimals)) + row->format.suffix);
    }
}

} // namespace atrium::ui
