// The bar below the view while light is shown in false colour: which scale, over which range; remembered between runs.
#pragma once

#include "engine/view/false_color.h"
#include "ui/document/engine_link.h"
#include "ui/window/settings.h"

#include <QFrame>

#include <optional>

class QCheckBox;
class QComboBox;
class QLabel;

namespace atrium::ui {

class NumberField;

/// UI thread only; the automatic range is found on a pool thread.
class FalseColorBar : public QFrame {
    Q_OBJECT
public:
    FalseColorBar(Document& document, EngineLink& engine, QWidget* parent = nullptr);

    /// None: the picture. Shows or hides the bar.
    void set_quantity(std::optional<LightQuantity> quantity);
    [[nodiscard]] std::optional<LightQuantity> quantity() const { return quantity_; }
    void set_contours(bool on);
    void set_shares(const LightShares& shares); ///< of the light that is on show: the range is theirs
    /// The automatic range is being found.
    [[nodiscard]] bool fitting() const { return searching_; }
    /// What the view shows now.
    [[nodiscard]] std::optional<FalseColor> scale() const;

Q_SIGNALS:
    void changed(); ///< scale() is another
    void message(const QString& text);

private:
    [[nodiscard]] ScaleChoice& choice();
    [[nodiscard]] const ScaleChoice& choice() const;
    void refresh();    ///< the widgets
    void publish();    ///< after a choice of the user: remembered, shown
    void find_range(); ///< starts the search for the automatic range where it is wanted and none runs
    void set_end(bool upper, double value);

    Document& document_;
    EngineLink& engine_;
    std::optional<LightQuantity> quantity_;
    ScaleChoice choices_[2];
    FalseColor fitted_[2]; ///< automatic, by quantity
    bool contours_ = false;
    LightShares shares_;
    bool searching_ = false;
    bool search_again_ = false;
    int document_number_ = 0;
    QLabel* name_ = nullptr;
    QComboBox* kind_ = nullptr;
    QCheckBox* automatic_ = nullptr;
    NumberField* from_ = nullptr;
    NumberField* to_ = nullptr;
};

} // namespace atrium::ui
