// Times every event that the UI thread handles, so that a stall has a name: the receiver's class and the event's type.
#pragma once

#include <QApplication>
#include <QElapsedTimer>
#include <QEvent>
#include <QMetaEnum>
#include <QOpenGLWidget>

#include <algorithm>
#include <map>
#include <string>

namespace atrium::ui {

/// Painting is kept apart: on a machine that draws in software it is the rasteriser's time. UI thread only.
class TimedApplication : public QApplication {
public:
    using QApplication::QApplication;
    bool notify(QObject* receiver, QEvent* event) override {
        const bool top = depth_ == 0;
        const QEvent::Type type = event->type();
        const std::string name = receiver->metaObject()->className();
        const bool painting = type == QEvent::Paint || type == QEvent::UpdateRequest || type == QEvent::Expose;
        QElapsedTimer clock;
        clock.start();
        ++depth_;
        const bool done = QApplication::notify(receiver, event);
        --depth_;
        if (top && on_) {
            const double ms = double(clock.nsecsElapsed()) * 1e-6;
            auto& worst =
                worst_[(painting ? "painting " : "") + name + " " + QMetaEnum::fromType<QEvent::Type>().valueToKey(type)];
            worst = std::max(worst, ms);
        }
        return done;
    }
    void start() {
        worst_.clear();
        on_ = true;
    }
    /// Milliseconds of the longest event of each kind since start().
    [[nodiscard]] const std::map<std::string, double>& worst() const { return worst_; }
    [[nodiscard]] double worst_but_painting() const {
        double out = 0;
        for (const auto& [what, ms] : worst_) {
            out = what.starts_with("painting") ? out : std::max(out, ms);
        }
        return out;
    }

private:
    int depth_ = 0;
    bool on_ = false;
    std::map<std::string, double> worst_;
};

} // namespace atrium::ui
