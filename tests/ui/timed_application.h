// Times every event that the UI thread handles, so that a stall has a name: the receiver's class and the event's type.
#pragma once

#include <QApplication>
#include <QEvent>
#include <QMetaEnum>
#include <QOpenGLWidget>
#include <QThread>

#include <algorithm>
#include <ctime>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace atrium::ui {

/// Counts the processor time of this thread, not the clock on the wall: the solver's threads and other programs may hold the
/// cores. Painting is kept apart, also where it happens within another event (a drag that Qt drives itself): on a machine
/// that draws in software it is the rasteriser's time. UI thread only.
class TimedApplication : public QApplication {
public:
    using QApplication::QApplication;
    bool notify(QObject* receiver, QEvent* event) override {
        // Objects of other threads have their events through here, too, on those threads: all below is the UI thread's.
        if (QThread::currentThread() != thread()) {
            return QApplication::notify(receiver, event);
        }
        // Within a drag or a dialog another loop turns inside an event: what it handles is counted by itself.
        const int level = thread()->loopLevel();
        const bool top = depth_ == 0 || level > level_;
        const int outer_level = level_;
        const double outer_inner = inner_;
        const double outer_painted = painted_;
        const bool outer_news = top_is_news_;
        if (top) {
            level_ = level;
            inner_ = 0.0;
            painted_ = 0.0;
        }
        const QEvent::Type type = event->type();
        const bool link = std::string_view(receiver->metaObject()->className()) == "atrium::ui::EngineLink";
        std::string name = receiver->metaObject()->className();
        if (const QString own = receiver->objectName(); !own.isEmpty()) {
            name += ' ' + own.toStdString();
        }
        const bool painting = type == QEvent::Paint || type == QEvent::UpdateRequest || type == QEvent::Expose;
        const bool in_painting = std::exchange(in_painting_, in_painting_ || painting);
        if (top) {
            top_is_news_ = type == QEvent::MetaCall && link;
        } else if (type == QEvent::Paint && top_is_news_) {
            ++paints_on_news_;
        }
        const double before = processor_ms();
        const double began = clock_ms(CLOCK_MONOTONIC);
        ++depth_;
        const bool done = QApplication::notify(receiver, event);
        --depth_;
        const double all = processor_ms() - before;
        const double ms = all - inner_ - (painting ? 0.0 : painted_);
        if (!top && painting && !in_painting) {
            painted_ += all;
        }
        in_painting_ = in_painting;
        if (top) {
            level_ = outer_level;
            inner_ = outer_inner + all;
            painted_ = outer_painted;
            top_is_news_ = depth_ > 0 ? outer_news : top_is_news_;
        }
        if (top && on_) {
            auto& worst =
                worst_[(painting ? "painting " : "") + name + " " + QMetaEnum::fromType<QEvent::Type>().valueToKey(type)];
            worst = std::max(worst, ms);
            if (ms > kStallMs) {
                stalls_.push_back({activity_, name, QMetaEnum::fromType<QEvent::Type>().valueToKey(type), ms,
                                   clock_ms(CLOCK_MONOTONIC) - began, began, painting});
            }
        }
        return done;
    }
    /// One event that held the thread for longer than a frame.
    struct Stall {
        std::string activity; ///< what the test was doing
        std::string receiver;
        std::string event;
        double ms = 0;      ///< of this thread's processor, without what inner loops handled
        double wall_ms = 0; ///< from its begin to its end, whoever had the processor
        double began = 0;   ///< milliseconds of the monotonic clock, as in a profile
        bool painting = false;
    };
    static constexpr double kStallMs = 16.0;
    void set_activity(std::string what) { activity_ = std::move(what); }
    [[nodiscard]] const std::vector<Stall>& stalls() const { return stalls_; } ///< since start()
    void start() {
        worst_.clear();
        stalls_.clear();
        paints_on_news_ = 0;
        on_ = true;
    }
    /// Milliseconds of the longest event of each kind since start().
    [[nodiscard]] const std::map<std::string, double>& worst() const { return worst_; }
    /// Widgets painted while news from the engine was handled, instead of with the next frame.
    [[nodiscard]] int paints_on_news() const { return paints_on_news_; }
    [[nodiscard]] double worst_but_painting() const {
        double out = 0;
        for (const auto& [what, ms] : worst_) {
            out = what.starts_with("painting") ? out : std::max(out, ms);
        }
        return out;
    }

private:
    static double clock_ms(clockid_t clock) {
        timespec now{};
        clock_gettime(clock, &now);
        return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
    }
    static double processor_ms() { return clock_ms(CLOCK_THREAD_CPUTIME_ID); }
    int depth_ = 0;
    int level_ = 0;        ///< of the loop that the outermost timed event came from
    double inner_ = 0.0;   ///< milliseconds of events of inner loops within the present one
    double painted_ = 0.0; ///< and of painting within it
    bool in_painting_ = false;
    bool on_ = false;
    bool top_is_news_ = false;
    int paints_on_news_ = 0;
    std::map<std::string, double> worst_;
    std::vector<Stall> stalls_;
    std::string activity_;
};

} // namespace atrium::ui
