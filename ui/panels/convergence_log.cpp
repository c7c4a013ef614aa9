#include "ui/panels/convergence_log.h"

#include "engine/solver/statistics_figures.h"

#include <fmt/format.h>

namespace atrium::ui {
namespace {

constexpr std::size_t kMost = 4096;

ConvergenceSample::Kind kind_of(const Solution& solution) {
    using Kind = ConvergenceSample::Kind;
    if (solution.final) {
        return solution.updatable ? Kind::Final : Kind::Stored; // what the editor solves it keeps for updates
    }
    if (solution.statistics.update.degraded) {
        return Kind::Hurried;
    }
    return solution.statistics.update == UpdateStatistics{} ? Kind::First : Kind::Settled;
}

} // namespace

const char* kind_name(ConvergenceSample::Kind kind) {
    switch (kind) {
    case ConvergenceSample::Kind::First: return "first";
    case ConvergenceSample::Kind::Hurried: return "hurried";
    case ConvergenceSample::Kind::Settled: return "settled";
    case ConvergenceSample::Kind::Final: return "final";
    case ConvergenceSample::Kind::Stored: break;
    }
    return "stored";
}

void ConvergenceLog::clear() {
    samples_.clear();
    before_ = 0;
}

void ConvergenceLog::add(const Solution& solution) {
    using Kind = ConvergenceSample::Kind;
    ConvergenceSample sample;
    sample.kind = kind_of(solution);
    sample.statistics = solution.statistics;
    sample.seconds = sample.kind == Kind::Stored ? 0.0 : solution.statistics.time.solve;
    const ErrorAudit& audit = solution.statistics.audit;
    sample.measured = audit.points > 0 ? audit.rms : 0.0;
    sample.estimate = audit.points > 0 ? 0.0 : solution.statistics.error_estimate;
    if (!samples_.empty() && sample.measured > 0.0 && samples_.back().kind == sample.kind &&
        samples_.back().measured == 0.0 && samples_.back().seconds == sample.seconds) {
        sample.run = samples_.back().run;
        sample.total_seconds = samples_.back().total_seconds;
        sample.estimate = samples_.back().estimate;
        samples_.back() = std::move(sample);
        return;
    }
    const bool goes_on = !samples_.empty() && samples_.back().kind == Kind::First &&
                         (sample.kind == Kind::First || sample.kind == Kind::Final) &&
                         sample.seconds >= samples_.back().seconds;
    if (!samples_.empty() && !goes_on) {
        before_ += samples_.back().seconds;
    }
    sample.run = samples_.empty() ? 1 : samples_.back().run + (goes_on ? 0 : 1);
    sample.total_seconds = before_ + sample.seconds;
    if (samples_.size() >= kMost) {
        samples_.erase(samples_.begin());
    }
    samples_.push_back(std::move(sample));
}

std::string ConvergenceLog::csv() const {
    std::string out = "run,kind,total_seconds,seconds,final,estimate";
    for (const StatisticsFigure& figure : statistics_figures({})) {
        out += "," + figure.key;
    }
    out += "\n";
    for (const ConvergenceSample& sample : samples_) {
        const bool final = sample.kind == ConvergenceSample::Kind::Final || sample.kind == ConvergenceSample::Kind::Stored;
        out += fmt::format("{},{},{},{},{},{}", sample.run, kind_name(sample.kind), sample.total_seconds, sample.seconds,
                           final ? 1 : 0, sample.estimate);
        for (const StatisticsFigure& figure : statistics_figures(sample.statistics)) {
            out += std::visit([](auto v) { return fmt::format(",{}", +v); }, figure.value);
        }
        out += "\n";
    }
    return out;
}

} // namespace atrium::ui
