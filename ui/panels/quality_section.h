// How good or how fast the light is to be: one wish, and beneath it the thresholds that it stands for, each of which can be
// set by hand.
#pragma once

#include "engine/scene/solver_thresholds.h"
#include "ui/panels/section.h"

class QLabel;
class QPushButton;
class QToolButton;

namespace atrium::ui {

class AutomaticText;

/// UI thread only. Edits with undo of the scene's settings, saved with it.
class QualitySection : public Section {
    Q_OBJECT
public:
    explicit QualitySection(Document& document);

protected:
    [[nodiscard]] bool has_target() const override { return true; }
    void refresh_more() override;

private:
    void add_thresholds();
    void add_threshold(const ThresholdInfo& info, const QString& label, const NumberFormat& format, const QString& hint);
    void show_automatic(); ///< what the wish stands for in this scene, in the fields that are not set by hand
    [[nodiscard]] bool open() const;

    QToolButton* opener_ = nullptr;
    QPushButton* reset_ = nullptr;
    /// What became of a number that was entered: one out of range is taken as the nearest inside, and that is said beneath
    /// the field for as long as it holds.
    struct Row {
        const ThresholdInfo* info;
        NumberFormat format;
        NumberField* field;
        AutomaticText* automatic;
        QLabel* note;
        float noted = 0.0F; ///< the threshold that note is about
    };
    float within_range(Row& row, double entered);
    void say(Row& row, const QString& note);

    std::vector<std::unique_ptr<Row>> rows_;
    float diagonal_ = 0.0F; ///< of the scene, metres; as it was when nothing was being dragged
};

} // namespace atrium::ui
