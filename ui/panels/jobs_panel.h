// What the engine is doing: state, progress, time; stop and go on; figures of the last solution.
#pragma once

#include "ui/document/engine_link.h"

#include <QTimer>
#include <QWidget>

class QLabel;
class QProgressBar;
class QPushButton;
class QTreeWidget;

namespace atrium::ui {

class ElidedLabel;

/// State of the light in one word, for the status bar and the panel.
/// Moving: light follows the hand in a hurry. Settling: the hand let go, and full quality is on its way.
enum class LightState : std::uint8_t { Empty, Solving, Moving, Settling, Refining, UpToDate, Stale, Stopped, Failed };
LightState light_state(const EngineLink& engine);
QString light_state_text(const EngineLink& engine); ///< "Solving 45 %", "Up to date", ...
/// What the memory that light may take made coarser; empty = nothing.
QString lowered_by_memory_text(const Statistics& statistics);

/// UI thread only.
class JobsPanel : public QWidget {
    Q_OBJECT
public:
    JobsPanel(Document& document, EngineLink& engine, QWidget* parent = nullptr);

Q_SIGNALS:
    void message(const QString& text);

private:
    void refresh_status();
    void refresh_figures();

    EngineLink& engine_;
    ElidedLabel* state_ = nullptr;
    ElidedLabel* phase_ = nullptr;
    ElidedLabel* times_ = nullptr;
    QProgressBar* bar_ = nullptr;
    QPushButton* toggle_ = nullptr;
    QTreeWidget* figures_ = nullptr;
    QTimer tick_;
};

/// Small coloured badge with the state of the light for the status bar. UI thread only.
class LightBadge : public QWidget {
    Q_OBJECT
public:
    explicit LightBadge(EngineLink& engine, QWidget* parent = nullptr);

private:
    void refresh();
    EngineLink& engine_;
    QLabel* dot_ = nullptr;
    QLabel* text_ = nullptr;
};

} // namespace atrium::ui
