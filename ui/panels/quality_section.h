// How good or how fast the light is to be: one wish, and beneath it the thresholds that it stands for, each of which can be
// set by hand.
#pragma once

#include "engine/scene/solver_thresholds.h"
#include "ui/panels/section.h"

class QPushButton;
class QToolButton;

namespace atrium::ui {

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
    std::vector<std::pair<const ThresholdInfo*, NumberField*>> fields_;
    std::vector<NumberFormat> formats_; ///< of fields_
    float diagonal_ = 0.0F;             ///< of the scene, metres; as it was when nothing was being dragged
};

} // namespace atrium::ui
