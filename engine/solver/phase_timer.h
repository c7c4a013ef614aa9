// Wall clock and processor time of the phases of a solve or an update.
#pragma once

#include "engine/solver/statistics.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <string>

namespace atrium {

/// Writes Statistics::phases, without their shares. One thread.
class PhaseTimer {
public:
    /// `statistics` must outlive it.
    explicit PhaseTimer(Statistics& statistics) : statistics_(statistics) {}
    /// Ends the phase at hand and begins another; time of phases of one name adds up.
    void next(const std::string& name) {
        stop();
        name_ = name;
        start_ = Clock::now();
        start_cpu_ = std::clock();
    }
    void stop() {
        if (name_.empty()) {
            return;
        }
        const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        const double cpu = double(std::clock() - start_cpu_) / CLOCKS_PER_SEC;
        auto& phases = statistics_.phases;
        const auto it = std::find_if(phases.begin(), phases.end(), [&](const auto& p) { return p.name == name_; });
        if (it == phases.end()) {
            phases.push_back({name_, seconds, 0.0, cpu});
        } else {
            it->seconds += seconds;
            it->cpu_seconds += cpu;
        }
        name_.clear();
    }

private:
    using Clock = std::chrono::steady_clock;
    Statistics& statistics_;
    std::string name_;
    Clock::time_point start_;
    std::clock_t start_cpu_ = 0;
};

} // namespace atrium
