// Error against run time, as the engine states it, with all figures of `--stats`; the plot can be saved.
#pragma once

#include "ui/document/engine_link.h"
#include "ui/panels/convergence_log.h"

#include <QTimer>
#include <QWidget>

class QComboBox;
class QLabel;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace atrium::ui {

class ConvergencePlot;

/// UI thread only.
class ConvergencePanel : public QWidget {
    Q_OBJECT
public:
    ConvergencePanel(Document& document, EngineLink& engine, QWidget* parent = nullptr);

    [[nodiscard]] const ConvergenceLog& log() const { return log_; }
    /// Writes the plot as .png or .svg, or what it is drawn from as .csv. The error says what went wrong.
    Result<void> save(const QString& path);

Q_SIGNALS:
    void message(const QString& text);

protected:
    void showEvent(QShowEvent* event) override;

private:
    void take_solution();
    void refresh_live(); ///< time and phase of the run that goes on
    void refresh_plot();
    void refresh_figures();
    void refresh_live_phases();
    void choose_file();
    void set_row(QTreeWidgetItem* parent, const QString& key, const QString& value, const QString& more = {});

    EngineLink& engine_;
    ConvergenceLog log_;
    std::shared_ptr<const Solution> last_;                    ///< that the log knows
    std::vector<std::pair<std::string, double>> live_phases_; ///< of the run that goes on: name, when it began
    double live_elapsed_ = 0;
    bool solving_ = false; ///< when last looked at
    QComboBox* span_ = nullptr;
    QLabel* live_ = nullptr;
    QPushButton* save_ = nullptr;
    ConvergencePlot* plot_ = nullptr;
    QTreeWidget* figures_ = nullptr;
    QTreeWidgetItem* phases_ = nullptr; ///< the group of the tree
    QTimer tick_;
};

} // namespace atrium::ui
