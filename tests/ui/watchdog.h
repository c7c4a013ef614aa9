// Longest time that the event loop did not turn: what a person feels as a hang.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <algorithm>

namespace atrium::ui {

/// Ticks every 5 ms while it lives. Reported by tests, never asserted: wall time belongs to the machine.
class Watchdog {
public:
    Watchdog() {
        since_.start();
        timer_.setTimerType(Qt::PreciseTimer);
        QObject::connect(&timer_, &QTimer::timeout, &timer_, [this] { tick(); });
        timer_.start(5);
    }
    /// Milliseconds between two turns at worst, the turn under way included.
    double longest_stall_ms() {
        tick();
        return longest_;
    }

private:
    void tick() {
        longest_ = std::max(longest_, double(since_.nsecsElapsed()) / 1e6);
        since_.restart();
    }
    QTimer timer_;
    QElapsedTimer since_;
    double longest_ = 0;
};

} // namespace atrium::ui
