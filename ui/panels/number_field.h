// The one field for numbers: units, decimal point or comma, one undo entry per typing, wheel burst or label drag.
#pragma once

#include "ui/panels/number_parse.h"

#include <QLabel>
#include <QLineEdit>
#include <QTimer>

#include <optional>

namespace atrium::ui {

/// How a field shows and limits its value (in base units).
struct NumberFormat {
    UnitSet units;
    QString suffix; ///< shown after the number, with its space: " m"
    int decimals = 3;
    double minimum = -1e9;
    double maximum = 1e9;
    double step = 0.1;           ///< one wheel notch
    bool proportional = false;   ///< a notch is a tenth of the value: for quantities over many magnitudes
    double display_factor = 1.0; ///< shown = value * this (percent: 100); what is typed is divided by it

    static NumberFormat length(double minimum = -1e6);
    static NumberFormat angle();
    static NumberFormat share(); ///< 0 to 1
    static NumberFormat plain(double minimum, double maximum, int decimals, const QString& suffix = {});
};

/// UI thread only. The owner answers started() with a gesture, edited() with an edit, finished() by committing and
/// cancelled() by rolling back.
class NumberField : public QLineEdit {
    Q_OBJECT
public:
    explicit NumberField(NumberFormat format, QWidget* parent = nullptr);

    void set_value(double value); ///< what the document holds; does not disturb a text that is being typed
    void set_mixed();             ///< several objects with different values
    void set_suffix(const QString& suffix, const UnitSet& units);
    /// `value` stands for "none": it is shown as a pale `text`, and an empty entry means it.
    void set_absent(double value, const QString& text);
    /// What the number is about; the tool tip whenever there is no problem to be told. Before it stands the whole number
    /// where the field is too narrow for all of its decimals.
    void set_hint(const QString& hint);
    [[nodiscard]] double value() const { return value_; }
    [[nodiscard]] bool mixed() const { return mixed_; }
    /// Dragging `label` sideways changes the value; Shift is ten times finer.
    void attach_label(QLabel* label);

Q_SIGNALS:
    void started();
    void edited(double value);
    void finished();
    void cancelled();
    void refused(const QString& why); ///< a bad entry; the value is unchanged

protected:
    bool event(QEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void resizeEvent(QResizeEvent* event) override; ///< as many decimals as there is room for
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    bool commit_text(); ///< false when the text is refused
    void show_value();
    [[nodiscard]] QString text_of(double value, int decimals) const;
    /// Decimals that fit into the field: those of the format, or fewer.
    [[nodiscard]] int fitting_decimals(double value) const;
    void show_tip();
    void show_problem(const QString& why);
    void step_by(double steps);
    void begin_burst();
    void end_burst(bool keep);

    NumberFormat format_;
    double value_ = 0;
    bool mixed_ = false;
    std::optional<double> absent_;
    QString absent_text_;
    QString hint_;
    int shown_decimals_ = 0; ///< of the text
    bool typing_ = false;
    bool burst_ = false; ///< a wheel burst or label drag is open
    QTimer burst_end_;
    QLabel* label_ = nullptr;
    bool dragging_ = false;
    double drag_x_ = 0;
    double drag_value_ = 0;
};

} // namespace atrium::ui
