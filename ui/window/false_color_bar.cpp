#include "ui/window/false_color_bar.h"

#include "engine/measure/light_range.h"
#include "ui/document/background.h"
#include "ui/panels/number_field.h"
#include "ui/viewport/legend.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>

namespace atrium::ui {
namespace {

UnitSet light_units(LightQuantity quantity) {
    UnitSet units;
    if (quantity == LightQuantity::Illuminance) {
        units.units = {{"lx", 1.0}, {"lux", 1.0}, {"klx", 1000.0}, {"fc", 10.763910416709722}, {"lm/m2", 1.0}};
    } else {
        units.units = {{"cd/m2", 1.0},     {"cd/m\xC2\xB2", 1.0},     {"nit", 1.0},        {"nt", 1.0},
                       {"kcd/m2", 1000.0}, {"kcd/m\xC2\xB2", 1000.0}, {"fl", 3.4262590996}};
    }
    return units;
}

QString suffix(LightQuantity quantity) { return QLatin1Char(' ') + QString::fromUtf8(unit_name(quantity)); }

} // namespace

FalseColorBar::FalseColorBar(Document& document, EngineLink& engine, QWidget* parent)
    : QFrame(parent), document_(document), engine_(engine) {
    setObjectName(QStringLiteral("false_color_bar"));
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(10, 4, 10, 4);
    name_ = new QLabel;
    QFont bold = name_->font();
    bold.setBold(true);
    name_->setFont(bold);
    kind_ = new QComboBox;
    kind_->setObjectName(QStringLiteral("false_color_kind"));
    kind_->setAccessibleName(tr("Kind of scale"));
    kind_->addItem(tr("Linear"));
    kind_->addItem(tr("Logarithmic"));
    kind_->setToolTip(tr("Even steps of light, or even factors: for rooms with sun and shade"));
    automatic_ = new QCheckBox(tr("Automatic range"));
    automatic_->setObjectName(QStringLiteral("false_color_automatic"));
    automatic_->setToolTip(tr("Fit the range to the light of the scene; it stays while you move things"));
    const auto field = [this](const char* object, const QString& name) {
        auto* out = new NumberField(
            {light_units(LightQuantity::Illuminance), suffix(LightQuantity::Illuminance), 4, 0.0, 1e9, 0.1, true, 1.0});
        out->setObjectName(QLatin1StringView(object));
        out->setAccessibleName(name);
        out->setMinimumWidth(out->fontMetrics().horizontalAdvance(QStringLiteral("20000 cd/m\u00b2")) + 12);
        out->setMaximumWidth(140);
        connect(out, &NumberField::refused, this, &FalseColorBar::message);
        return out;
    };
    from_ = field("false_color_from", tr("Lower end of the range"));
    to_ = field("false_color_to", tr("Upper end of the range"));
    auto* from_label = new QLabel(tr("from"));
    auto* to_label = new QLabel(tr("to"));
    from_->attach_label(from_label);
    to_->attach_label(to_label);
    layout->addWidget(name_);
    layout->addSpacing(8);
    layout->addWidget(kind_);
    layout->addWidget(automatic_);
    layout->addWidget(from_label);
    layout->addWidget(from_);
    layout->addWidget(to_label);
    layout->addWidget(to_);
    layout->addStretch(1);
    const Settings settings;
    for (const LightQuantity q : {LightQuantity::Illuminance, LightQuantity::Luminance}) {
        choices_[std::size_t(q)] = settings.scale_choice(q);
        FalseColor& fitted = fitted_[std::size_t(q)];
        fitted.quantity = q;
        fitted.logarithmic = choices_[std::size_t(q)].logarithmic;
        fitted.minimum = 1.0; // until the scene's light is known
        fitted.maximum = 1000.0;
    }
    connect(kind_, &QComboBox::activated, this, [this](int index) {
        choice().logarithmic = index == 1;
        if (choice().logarithmic && !(choice().minimum > 0.0)) {
            choice().minimum = 1e-3 * choice().maximum;
        }
        publish();
    });
    connect(automatic_, &QCheckBox::toggled, this, [this](bool on) {
        if (!on) { // by hand from where it is
            choice().minimum = fitted_[std::size_t(*quantity_)].minimum;
            choice().maximum = fitted_[std::size_t(*quantity_)].maximum;
        }
        choice().automatic = on;
        publish();
    });
    connect(from_, &NumberField::edited, this, [this](double value) { set_end(false, value); });
    connect(to_, &NumberField::edited, this, [this](double value) { set_end(true, value); });
    connect(&document_, &Document::reset_done, this, [this] { ++document_number_; });
    connect(&engine_, &EngineLink::solution_changed, this, [this] {
        // A scale that changes while one edits could not be read: only light computed afresh sets it.
        const auto solution = engine_.solution();
        if (solution && !document_.in_gesture() && solution->statistics.update == UpdateStatistics{}) {
            find_range();
        }
    });
    hide();
}

ScaleChoice& FalseColorBar::choice() { return choices_[std::size_t(*quantity_)]; }
const ScaleChoice& FalseColorBar::choice() const { return choices_[std::size_t(*quantity_)]; }

void FalseColorBar::set_quantity(std::optional<LightQuantity> quantity) {
    if (quantity == quantity_) {
        return;
    }
    quantity_ = quantity;
    Settings().set_false_color(quantity_);
    setVisible(quantity_.has_value());
    refresh();
    Q_EMIT changed();
    find_range();
}

void FalseColorBar::set_contours(bool on) {
    contours_ = on;
    Q_EMIT changed();
}

void FalseColorBar::set_shares(const LightShares& shares) {
    shares_ = shares;
    find_range();
}

std::optional<FalseColor> FalseColorBar::scale() const {
    if (!quantity_) {
        return std::nullopt;
    }
    FalseColor out = fitted_[std::size_t(*quantity_)];
    if (!choice().automatic) {
        out = {*quantity_, choice().logarithmic, choice().minimum, choice().maximum, false};
    }
    out.contours = contours_;
    return valid_scale(out);
}

void FalseColorBar::set_end(bool upper, double value) {
    const auto shown = scale();
    if (!shown) {
        return;
    }
    ScaleChoice& mine = choice();
    if (mine.automatic) { // who types a number wants it to stay
        mine = {mine.logarithmic, false, shown->minimum, shown->maximum};
    }
    (upper ? mine.maximum : mine.minimum) = value;
    publish();
}

void FalseColorBar::publish() {
    Settings().set_scale_choice(*quantity_, choice());
    refresh();
    Q_EMIT changed();
    find_range();
}

void FalseColorBar::refresh() {
    if (!quantity_) {
        return;
    }
    name_->setText(quantity_text(*quantity_));
    kind_->setCurrentIndex(choice().logarithmic ? 1 : 0);
    const QSignalBlocker quiet(automatic_);
    automatic_->setChecked(choice().automatic);
    const FalseColor shown = *scale();
    for (auto [field, value] : {std::pair(from_, shown.minimum), std::pair(to_, shown.maximum)}) {
        field->set_suffix(suffix(*quantity_), light_units(*quantity_));
        field->set_value(value);
    }
}

void FalseColorBar::find_range() {
    const std::shared_ptr<const Solution> solution = engine_.solution();
    if (!quantity_ || !choice().automatic || !solution) {
        return;
    }
    if (searching_) {
        search_again_ = true;
        return;
    }
    searching_ = true;
    run_in_background(
        this,
        [scene = document_.scene(), solution, quantity = *quantity_, shares = shares_]() -> Result<LightRange> {
            return light_range(scene, *solution, quantity, shares);
        },
        [this, quantity = *quantity_, number = document_number_](const Result<LightRange>& range) {
            searching_ = false;
            if (range && number == document_number_) {
                FalseColor& fitted = fitted_[std::size_t(quantity)];
                const FalseColor before = fitted;
                fitted.logarithmic = choices_[std::size_t(quantity)].logarithmic;
                fitted = fitted_scale(fitted, *range);
                if (!(fitted == before)) {
                    refresh();
                    Q_EMIT changed();
                }
            }
            if (std::exchange(search_again_, false)) {
                find_range();
            }
        });
}

} // namespace atrium::ui
