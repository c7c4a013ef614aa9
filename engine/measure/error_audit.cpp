#include "engine/measure/error_audit.h"

#include "engine/base/rng.h"
#include "engine/measure/light_difference.h"
#include "engine/reference/reference.h"
#include "engine/solver/gi_engine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace atrium {
namespace {

constexpr double kDark = 0.05;      // of the mean: darker places count as that bright
constexpr double kNoiseShare = 0.1; // of the error's square that noise may stand for
constexpr int kResamples = 400;
constexpr double kFarOff = 25.0;        // times the median of the squares
constexpr std::size_t kAskedAgain = 16; // one place in so many at most
constexpr std::uint64_t kMorePaths = 8; // times those of the first answer, at most
constexpr double kFirstAnswer = 0.7;    // of all rays that the audit may take
constexpr double kLeastBudget = 2e6;    // rays

struct Comparison {
    std::vector<double> squares; ///< of the relative differences, less the reference's own variance
    std::vector<double> sizes;   ///< of the relative differences, noise included
    double noise = 0;            ///< standard error of the mean square that noise alone causes
    double bias = 0;
    double bias_error = 0;
    std::vector<std::size_t> used; ///< places where the truth is that of the same surface: not where two lie back to back
};

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values) {
        sum += v;
    }
    return values.empty() ? 0.0 : sum / double(values.size());
}

Comparison compare(const std::vector<SensorReading>& ours, const std::vector<ReferenceReading>& truth) {
    Comparison out;
    double sum = 0.0;
    double true_sum = 0.0;
    double variance = 0.0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        if (!truth[i].on_surface) {
            continue;
        }
        out.used.push_back(i);
        sum += luminance(ours[i].irradiance);
        true_sum += luminance(truth[i].irradiance);
        variance += truth[i].standard_error * truth[i].standard_error;
    }
    const double floor = kDark * true_sum / double(std::max<std::size_t>(out.used.size(), 1));
    double noise = 0.0;
    for (const std::size_t i : out.used) {
        const double e = luminance(ours[i].irradiance);
        const double r = luminance(truth[i].irradiance);
        const double s = truth[i].standard_error;
        // A noisy truth in the denominator would make the error look larger than it is: as far as noise leaves it open,
        // the truth is what the solution says.
        const double scale = std::max(std::clamp(e, r - 2.0 * s, r + 2.0 * s), floor);
        const double d = e - r;
        out.squares.push_back(scale > 0.0 ? (d * d - s * s) / (scale * scale) : 0.0);
        out.sizes.push_back(scale > 0.0 ? std::abs(d) / scale : 0.0);
        const double rest = scale > 0.0 ? s * s / (scale * scale) : 0.0;
        // Variance of (d + noise)^2 - s^2 about d^2.
        noise += 2.0 * rest * rest + 4.0 * rest * std::max(out.squares.back(), 0.0);
    }
    out.noise = std::sqrt(noise) / double(std::max<std::size_t>(out.used.size(), 1));
    if (true_sum > 0.0) {
        out.bias = sum / true_sum - 1.0;
        out.bias_error = std::sqrt(variance) / true_sum;
    }
    return out;
}

/// Indices, of all places, of those far off what is usual: there chance must not have the last word. A truth that missed a
/// small bright patch, or met one path too bright, looks like an error. Only far off: to ask again wherever noise made the
/// error look a little larger would make the whole look smaller than it is.
std::vector<std::size_t> far_off(const Comparison& found) {
    std::vector<double> sizes;
    for (const double square : found.squares) {
        sizes.push_back(std::abs(square));
    }
    const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < found.squares.size(); ++k) {
        if (std::abs(found.squares[k]) > kFarOff * *middle) {
            order.push_back(k);
        }
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return std::abs(found.squares[a]) > std::abs(found.squares[b]); });
    order.resize(std::min(order.size(), std::max<std::size_t>(found.squares.size() / kAskedAgain, 4)));
    for (std::size_t& k : order) {
        k = found.used[k];
    }
    return order;
}

/// Mean of two answers, by their paths. `before` = paths of what is there, 0 = nothing.
void add_answer(std::vector<ReferenceReading>& sum, std::uint64_t before, const std::vector<ReferenceReading>& more,
                std::uint64_t paths) {
    if (before == 0) {
        sum = more;
        return;
    }
    const double share = double(paths) / double(before + paths);
    for (std::size_t i = 0; i < sum.size(); ++i) {
        sum[i].irradiance = sum[i].irradiance * float(1.0 - share) + more[i].irradiance * float(share);
        sum[i].standard_error = std::hypot(sum[i].standard_error * (1.0 - share), more[i].standard_error * share);
    }
}

/// Bounds of the mean that hold 95 times in 100, by drawing the values again and again.
void bootstrap(const std::vector<double>& values, std::uint32_t seed, double& low, double& high) {
    std::vector<double> means;
    for (int k = 0; k < kResamples; ++k) {
        double sum = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::uint64_t h = hash_combine(hash_combine(0xB007ULL + seed, std::uint64_t(k)), i);
            sum += values[h % values.size()];
        }
        means.push_back(sum / double(values.size()));
    }
    std::sort(means.begin(), means.end());
    low = means[std::size_t(0.025 * kResamples)];
    high = means[std::size_t(0.975 * kResamples) - 1];
}

} // namespace

AuditSettings audit_settings(SolverSettings::Quality quality) {
    switch (quality) {
    case SolverSettings::Quality::Draft: return {256, 128, 256};
    case SolverSettings::Quality::Normal: return {512, 256, 1024};
    case SolverSettings::Quality::Fine: return {1024, 512, 4096};
    }
    return {};
}

namespace {

/// audit_error(), and its places where somebody wants them.
Result<ErrorAudit> audit(const Scene& scene, const Solution& solution, const AuditSettings& settings,
                         const RunContext& context, std::vector<AuditPlace>* told) {
    const auto start = RunContext::Clock::now();
    const std::vector<SensorPlace> places = seen_places(scene, settings.points, 0xAD17U + settings.seed, context);
    if (context.should_stop()) {
        return fail("", "", "the audit was stopped", "Give it more time.");
    }
    std::vector<ReferencePoint> points;
    for (const SensorPlace& place : places) {
        points.push_back({place.point, place.normal});
    }
    const auto nothing = [] {
        return fail("", "", "there is nothing to compare: light reaches no surface that scatters it",
                    "Add a lamp, daylight or a matt surface.");
    };
    if (places.empty()) {
        return nothing();
    }
    const std::vector<SensorReading> ours = read_surfaces(scene, solution, places);
    ErrorAudit out;
    Comparison found;
    std::vector<ReferenceReading> answer;
    const double budget = std::max(settings.ray_share * double(solution.statistics.rays), kLeastBudget);
    ReferenceSettings wanted;
    wanted.seed = std::uint32_t(hash_combine(0xE44ULL, settings.seed));
    wanted.paths = std::min(settings.least_paths, settings.most_paths);
    for (;;) { // a quick look first, then as much more as its noise and its error ask for
        const auto truth = reference_irradiance(scene, points, wanted, context);
        if (!truth) {
            return tl::unexpected(truth.error());
        }
        if (!truth->run.reached) {
            return fail("", "", "the audit was stopped", "Give it more time.");
        }
        add_answer(answer, out.paths, truth->points, truth->run.paths);
        out.paths += truth->run.paths;
        out.rays += truth->run.rays;
        found = compare(ours, answer);
        const double per_path = double(out.rays) / double(out.paths);
        const std::uint64_t most = std::min(settings.most_paths, std::uint64_t(kFirstAnswer * budget / per_path));
        const double allowed = kNoiseShare * std::max(mean_of(found.squares), 0.0);
        if (found.noise <= allowed || out.paths + out.paths / 4 >= most) {
            break;
        }
        // Noise of a square falls with the number of paths.
        const double more = allowed > 0.0 ? std::clamp(found.noise / allowed, 2.0, 1e6) : 1e6;
        wanted.paths = std::min(most, std::uint64_t(double(out.paths) * more)) - out.paths;
        ++wanted.seed;
    }
    if (found.squares.empty()) {
        return nothing();
    }
    if (const std::vector<std::size_t> again = far_off(found); !again.empty()) {
        std::vector<ReferencePoint> few;
        for (const std::size_t i : again) {
            few.push_back(points[i]);
        }
        const double per_path = double(out.rays) / double(out.paths) * double(few.size()) / double(points.size());
        const double affordable = std::max(budget - double(out.rays), 0.0) / per_path;
        wanted.paths = std::clamp(std::uint64_t(affordable), out.paths, kMorePaths * out.paths);
        ++wanted.seed; // an answer of its own: a truth that is picked for what it said is not to be believed
        const auto truth = reference_irradiance(scene, few, wanted, context);
        if (!truth || !truth->run.reached) {
            return fail("", "", "the audit was stopped", "Give it more time.");
        }
        out.rays += truth->run.rays;
        for (std::size_t k = 0; k < again.size(); ++k) {
            answer[again[k]] = truth->points[k];
        }
        found = compare(ours, answer);
    }
    if (told != nullptr) {
        for (std::size_t k = 0; k < found.used.size(); ++k) {
            const std::size_t i = found.used[k];
            told->push_back({places[i].point, places[i].normal, double(luminance(ours[i].irradiance)),
                             double(luminance(answer[i].irradiance)), answer[i].standard_error, found.squares[k]});
        }
    }
    out.points = std::uint32_t(found.squares.size());
    double low = 0.0;
    double high = 0.0;
    bootstrap(found.squares, settings.seed, low, high);
    out.rms = std::sqrt(std::max(mean_of(found.squares), 0.0));
    out.low = std::sqrt(std::max(low, 0.0));
    out.high = std::sqrt(std::max(high, 0.0));
    const auto middle = found.sizes.begin() + std::ptrdiff_t(found.sizes.size() / 2);
    std::nth_element(found.sizes.begin(), middle, found.sizes.end());
    out.typical = *middle;
    out.bias = found.bias;
    out.bias_error = found.bias_error;
    out.seconds = std::chrono::duration<double>(RunContext::Clock::now() - start).count();
    return out;
}

} // namespace

Result<ErrorAudit> audit_error(const Scene& scene, const Solution& solution, const AuditSettings& settings,
                               const RunContext& context) {
    return audit(scene, solution, settings, context, nullptr);
}

Result<std::vector<AuditPlace>> audit_places(const Scene& scene, const Solution& solution, const AuditSettings& settings,
                                             const RunContext& context) {
    std::vector<AuditPlace> places;
    if (const auto found = audit(scene, solution, settings, context, &places); !found) {
        return tl::unexpected(found.error());
    }
    return places;
}

std::shared_ptr<const Solution> audited(const Scene& scene, std::shared_ptr<const Solution> solution,
                                        const AuditSettings& settings, const RunContext& context) {
    return audited_with_places(scene, std::move(solution), settings, context).solution;
}

Audited audited_with_places(const Scene& scene, std::shared_ptr<const Solution> solution, const AuditSettings& settings,
                            const RunContext& context) {
    std::vector<AuditPlace> places;
    const auto found = audit(scene, *solution, settings, context, &places);
    if (!found) {
        return solution;
    }
    auto out = std::make_shared<Solution>(*solution);
    out->statistics.audit = *found;
    // Where noise hides an error that is smaller than itself, the bound is what is known.
    out->statistics.error_estimate = found->rms > 0.0 ? found->rms : found->high;
    return {std::move(out), std::move(places)};
}

} // namespace atrium
