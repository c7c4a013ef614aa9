// How far measured values are from a reference: the figures of `atrium-cli compare`.
#pragma once

#include "engine/io/image_file.h"

#include <cstddef>
#include <span>

namespace atrium {

/// Figures of a set of values against a reference. eps = 1 % of the reference's mean keeps dark places from dominating.
struct Difference {
    std::size_t count = 0;
    double rel_mse = 0;            ///< mean of (a - b)^2 / (b^2 + eps^2)
    double rel_rmse = 0;           ///< root of the mean of (a - b)^2, over the reference's mean
    double mean_relative_bias = 0; ///< (mean a - mean b) / mean b
    double p95 = 0;                ///< 95th percentile of |a - b| / (|b| + eps)
    double p99 = 0;
    double max = 0; ///< largest of the same
};
/// Both of the same length. A reference that is zero throughout gives zero where `values` is too and infinity elsewhere.
Difference difference(std::span<const double> values, std::span<const double> reference);

/// Mean FLIP error of two pictures of linear colour in [0,1] and equal size, in [0,1]: Andersson et al. 2020, "FLIP: A
/// Difference Evaluator for Alternating Images". `pixels_per_degree` 67 is a 0.7 m wide 4k screen seen from 0.7 m.
double flip(const Picture& test, const Picture& reference, double pixels_per_degree = 67.0);

} // namespace atrium
