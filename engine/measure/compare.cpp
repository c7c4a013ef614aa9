#include "engine/measure/compare.h"

#include "engine/base/checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace atrium {

namespace {

/// Value below which the share `part` of the sorted list lies (nearest rank).
double percentile(std::vector<double>& values, double part) {
    const auto rank = std::size_t(std::ceil(part * double(values.size())));
    const auto at = values.begin() + std::ptrdiff_t(std::max<std::size_t>(rank, 1) - 1);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

double ratio(double numerator, double denominator) {
    if (numerator == 0.0) {
        return 0.0;
    }
    return denominator != 0.0 ? numerator / denominator : std::copysign(std::numeric_limits<double>::infinity(), numerator);
}

} // namespace

Difference difference(std::span<const double> values, std::span<const double> reference) {
    ATRIUM_CHECK(values.size() == reference.size());
    Difference out;
    out.count = values.size();
    if (values.empty()) {
        return out;
    }
    const auto n = double(values.size());
    double mean = 0;
    double mean_value = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        mean += reference[i] / n;
        mean_value += values[i] / n;
    }
    const double eps = 0.01 * std::abs(mean);
    std::vector<double> relative(values.size());
    double squares = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double d = values[i] - reference[i];
        out.rel_mse += ratio(d * d, reference[i] * reference[i] + eps * eps) / n;
        squares += d * d / n;
        relative[i] = ratio(std::abs(d), std::abs(reference[i]) + eps);
    }
    out.rel_rmse = ratio(std::sqrt(squares), std::abs(mean));
    out.mean_relative_bias = ratio(mean_value - mean, std::abs(mean));
    out.p95 = percentile(relative, 0.95);
    out.p99 = percentile(relative, 0.99);
    out.max = percentile(relative, 1.0);
    return out;
}

} // namespace atrium
