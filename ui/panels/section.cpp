#include "ui/panels/section.h"

#include "ui/document/engine_text.h"
#include "ui/panels/color_button.h"
#include "ui/panels/quiet_combo.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>

namespace atrium::ui {

namespace {

constexpr int kVectorLabel = 62; ///< of rows with three fields, which stand below each other

template <class T> bool all_equal(const std::vector<T>& values) {
    return std::all_of(values.begin(), values.end(), [&](const T& v) { return v == values.front(); });
}

void show_in(NumberField* field, const std::vector<double>& values) {
    if (all_equal(values)) {
        field->set_value(values.front());
    } else {
        field->set_mixed();
    }
}

} // namespace

Section::Section(const QString& title, Document& document, QWidget* parent) : QWidget(parent), document_(document) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 6);
    layout->setSpacing(4);
    auto* head = new QLabel(title);
    QFont bold = head->font();
    bold.setBold(true);
    head->setFont(bold);
    layout->addWidget(head);
    auto* line = new QFrame;
    line->setFrameShape(QFrame::HLine);
    line->setFrameShadow(QFrame::Sunken);
    layout->addWidget(line);
    // Not a QFormLayout: Qt 6.4's writes past its own array when rows with wrapped text are hidden and shown again.
    grid_ = new QGridLayout;
    grid_->setContentsMargins(0, 2, 0, 0);
    grid_->setHorizontalSpacing(10);
    grid_->setVerticalSpacing(5);
    grid_->setColumnStretch(1, 1);
    grid_->setColumnMinimumWidth(0, 102);
    layout->addLayout(grid_);
}

Section::~Section() = default;

void Section::refresh() {
    const bool shown = has_target();
    setVisible(shown);
    if (!shown) {
        return;
    }
    for (const auto& refresher : refreshers_) {
        refresher();
    }
    refresh_more();
}

bool Section::apply(const SceneEdit& edit, const QString& text) {
    const auto done = document_.apply(edit, text);
    if (!done) {
        Q_EMIT message(error_message(done.error()));
        refresh();
    }
    return bool(done);
}

void Section::begin(const QString& label) {
    if (!gesture_) {
        gesture_ = std::make_unique<Gesture>(document_, label);
    }
}

void Section::end(bool keep) {
    if (gesture_ && keep) {
        gesture_->commit();
    }
    gesture_.reset();
}

void Section::bind(NumberField* field, const QString& label, std::function<SceneEdit(double)> write) {
    connect(field, &NumberField::started, this, [this, label] { begin(tr("Change %1").arg(label)); });
    connect(field, &NumberField::edited, this,
            [this, label, write = std::move(write)](double value) { apply(write(value), tr("Change %1").arg(label)); });
    connect(field, &NumberField::finished, this, [this] { end(true); });
    connect(field, &NumberField::cancelled, this, [this] { end(false); });
    connect(field, &NumberField::refused, this, &Section::message);
}

QLabel* Section::place(const QString& label, QWidget* widget) {
    const int row = grid_->rowCount();
    auto* title = new QLabel(label);
    title->setBuddy(widget);
    if (widget->accessibleName().isEmpty()) {
        widget->setAccessibleName(label);
    }
    grid_->addWidget(title, row, 0);
    grid_->addWidget(widget, row, 1);
    return title;
}

void Section::add_row(const QString& label, QWidget* widget, std::function<bool()> shown) {
    QWidget* title = nullptr;
    if (label.isEmpty()) {
        grid_->addWidget(widget, grid_->rowCount(), 0, 1, 2);
    } else {
        title = place(label, widget);
    }
    if (shown) {
        refreshers_.push_back([widget, title, shown = std::move(shown)] {
            const bool on = shown();
            widget->setVisible(on);
            if (title != nullptr) {
                title->setVisible(on);
            }
        });
    }
}

NumberField* Section::add_number(const QString& label, const NumberFormat& format, Numbers read, WriteNumber write) {
    auto* field = new NumberField(format);
    field->setObjectName(label);
    QLabel* title = place(label, field);
    field->attach_label(title);
    bind(field, label, std::move(write));
    refreshers_.push_back([field, title, read = std::move(read)] {
        const std::vector<double> values = read();
        field->setVisible(!values.empty());
        title->setVisible(!values.empty());
        if (!values.empty()) {
            show_in(field, values);
        }
    });
    return field;
}

std::array<NumberField*, 3> Section::add_vector(const QString& label, const NumberFormat& format,
                                                std::function<std::vector<dvec3>()> read,
                                                std::function<SceneEdit(int, double)> write) {
    static const char* const kAxes[] = {"X", "Y", "Z"};
    auto* row = new QWidget;
    row->setAccessibleName(label);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    auto* head = new QLabel(label);
    head->setMinimumWidth(kVectorLabel);
    layout->addWidget(head);
    std::array<NumberField*, 3> fields{};
    for (int axis = 0; axis < 3; ++axis) {
        const QString letter = QLatin1StringView(kAxes[axis]);
        auto* title = new QLabel(letter);
        auto* field = new NumberField(format);
        field->setAccessibleName(QStringLiteral("%1 %2").arg(label, letter));
        field->setObjectName(field->accessibleName());
        field->attach_label(title);
        layout->addWidget(title);
        layout->addWidget(field, 1);
        bind(field, label, [write, axis](double value) { return write(axis, value); });
        fields[std::size_t(axis)] = field;
    }
    head->setBuddy(fields[0]);
    grid_->addWidget(row, grid_->rowCount(), 0, 1, 2);
    refreshers_.push_back([row, fields, read = std::move(read)] {
        const std::vector<dvec3> values = read();
        row->setVisible(!values.empty());
        int axis = 0;
        for (NumberField* field : fields) {
            std::vector<double> parts;
            for (const dvec3& value : values) {
                parts.push_back(value[axis]);
            }
            if (!parts.empty()) {
                show_in(field, parts);
            }
            ++axis;
        }
    });
    return fields;
}

ColorButton* Section::add_color(const QString& label, Colors read, WriteColor write) {
    auto* button = new ColorButton;
    button->setObjectName(label);
    QLabel* title = place(label, button);
    connect(button, &ColorButton::started, this, [this, label] { begin(tr("Change %1").arg(label)); });
    connect(button, &ColorButton::edited, this,
            [this, label, write = std::move(write)](const Rgb& color) { apply(write(color), tr("Change %1").arg(label)); });
    connect(button, &ColorButton::finished, this, [this] { end(true); });
    connect(button, &ColorButton::cancelled, this, [this] { end(false); });
    refreshers_.push_back([button, title, read = std::move(read)] {
        const std::vector<Rgb> values = read();
        button->setVisible(!values.empty());
        title->setVisible(!values.empty());
        if (!values.empty()) {
            button->set_color(values.front(), !all_equal(values));
        }
    });
    return button;
}

QCheckBox* Section::add_check(const QString& label, std::function<std::vector<bool>()> read,
                              std::function<SceneEdit(bool)> write) {
    auto* box = new QCheckBox(label);
    box->setObjectName(label);
    grid_->addWidget(box, grid_->rowCount(), 1);
    connect(box, &QCheckBox::clicked, this, [this, label, box, write = std::move(write)](bool on) {
        box->setTristate(false);
        apply(write(on), tr("Change %1").arg(label));
    });
    refreshers_.push_back([box, read = std::move(read)] {
        const std::vector<bool> values = read();
        box->setVisible(!values.empty());
        if (!values.empty()) {
            const bool same = std::all_of(values.begin(), values.end(), [&](bool v) { return v == values.front(); });
            box->setTristate(!same);
            box->setCheckState(!same ? Qt::PartiallyChecked : values.front() ? Qt::Checked : Qt::Unchecked);
        }
    });
    return box;
}

QComboBox* Section::add_choice(const QString& label, const QStringList& entries, std::function<std::vector<int>()> read,
                               std::function<SceneEdit(int)> write) {
    auto* combo = new QuietCombo;
    combo->addItems(entries);
    combo->setObjectName(label);
    QLabel* title = place(label, combo);
    connect(combo, &QComboBox::activated, this,
            [this, label, write = std::move(write)](int index) { apply(write(index), tr("Change %1").arg(label)); });
    refreshers_.push_back([combo, title, read = std::move(read)] {
        const std::vector<int> values = read();
        combo->setVisible(!values.empty());
        title->setVisible(!values.empty());
        const QSignalBlocker quiet(combo);
        combo->setCurrentIndex(!values.empty() && all_equal(values) ? values.front() : -1);
    });
    return combo;
}

} // namespace atrium::ui
