// What a number field shows where a number is automatic: as much of it as there is room for.
#pragma once

#include "ui/panels/number_field.h"

namespace atrium::ui {

/// Belongs to its field. "automatic (0.42 mm)", "auto (0.42 mm)" or "0.42 mm": the fullest that fits; where that is a
/// shorter one, the field's tool tip has the whole. UI thread only.
class AutomaticText : public QObject {
    Q_OBJECT
public:
    /// `absent`: the value of the field that means automatic; `hint`: what else the tool tip is to say.
    AutomaticText(NumberField* field, double absent, QString hint = {});
    void set_amount(const QString& amount); ///< empty where it is not known (yet)

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void show();
    NumberField* field_;
    double absent_;
    QString hint_;
    QString amount_;
};

} // namespace atrium::ui
