// The plot of the convergence panel: Qt Charts lives in convergence_plot.cpp and nowhere else.
#pragma once

#include "engine/base/result.h"
#include "ui/panels/convergence_log.h"

#include <QWidget>

#include <memory>
#include <span>

namespace atrium::ui {

/// A line per solution through what its samples tell of its error, squares for updates, and what was measured with the
/// bounds that hold 95 times in 100. UI thread only.
class ConvergencePlot : public QWidget {
    Q_OBJECT
public:
    explicit ConvergencePlot(QWidget* parent = nullptr);
    ~ConvergencePlot() override;

    /// `whole_session`: over the run time of the session, else over that of the run that the samples are of.
    /// `now` is the run time at present on the same axis, while a run goes on; negative = none does.
    void show_samples(std::span<const ConvergenceSample> samples, bool whole_session, double now);
    /// By extension: .png at twice the size on the screen, or .svg. Always dark on white.
    Result<void> save(const QString& path);
    [[nodiscard]] int points() const; ///< that are drawn

protected:
    void changeEvent(QEvent* event) override;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace atrium::ui
