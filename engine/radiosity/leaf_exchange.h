// Light between leaves as their own rays find it: a sparse symmetric matrix, and the conjugate gradient on top of it.
#pragma once

#include "engine/base/run_context.h"
#include "engine/radiosity/leaf_surroundings.h"
#include "engine/radiosity/solve_report.h"

#include <cstdint>
#include <span>
#include <vector>

namespace atrium {

/// Transport between leaves E = K B / A. A ray from leaf i that ends on leaf j is an unbiased sample of K_ij = A_i F_ij =
/// K_ji, of a variance in proportion to A_i: rays of both leaves are combined by that. Links describe a pair by one number
/// and err alike over many pairs; rays err by chance, which averages out in whatever looks at many leaves.
class LeafExchange {
public:
    /// `around` = what look_around() says of the hierarchy's leaves. Rows are closed by symmetric scaling (Sinkhorn): of
    /// what every leaf sends, as much lands on opaque leaves as its own rays did, so energy is kept and never grows.
    LeafExchange(const Hierarchy& hierarchy, const std::vector<std::uint32_t>& leaves, const LeafSurroundings& around);

    /// Appends leaves (elements behind all that are there, ascending) that exchange nothing with anybody here: whose light
    /// is what others know, see SightChange::Rows. `around` = what look_around() says of them.
    void append(std::span<const std::uint32_t> leaves, const Hierarchy& hierarchy, const LeafSurroundings& around);

    [[nodiscard]] const std::vector<std::uint32_t>& leaves() const { return leaves_; }
    /// Irradiance on every leaf for a radiosity on every leaf (same order as leaves()).
    void apply(const std::vector<Rgb>& radiosity, std::vector<Rgb>& irradiance) const;
    /// Share of what every leaf sends that ends on leaves: the sum of its form factors, each times the other's opacity.
    [[nodiscard]] const std::vector<float>& row_sums() const { return row_sums_; }
    /// See LeafSurroundings.
    [[nodiscard]] const std::vector<float>& opacity() const { return opacity_; }
    /// Of every leaf what is not covered, square metres.
    [[nodiscard]] const std::vector<float>& area() const { return area_; }
    /// Relative error of the irradiance that is gathered from the leaves' radiosities: root of its area-weighted mean
    /// square, luminance. From the spread of what each leaf's rays saw and of radiosity within leaves (judged by their
    /// neighbours), both taken as independent from leaf to leaf and carried over one gather, and from what the solver
    /// left over. An estimate, good to about a factor of two where light changes gently within leaves; 0 in the dark.
    [[nodiscard]] double error_estimate(const Hierarchy& solved, const SolveReport& report) const;
    [[nodiscard]] std::size_t memory_bytes() const;

    /// Light between two leaves: what `other` sends adds K B / A to the irradiance.
    struct Entry {
        std::uint32_t other; ///< index into leaves()
        float k;             ///< square metres
    };
    /// Everything that a leaf (index into leaves()) exchanges light with, by ascending `other`.
    [[nodiscard]] std::span<const Entry> row(std::size_t leaf) const {
        return std::span(entries_).subspan(first_[leaf], first_[leaf + 1] - first_[leaf]);
    }

private:
    std::vector<std::uint32_t> leaves_;
    std::vector<std::size_t> first_; ///< per leaf, into entries_, ordered by `other`; one more at the end
    std::vector<Entry> entries_;
    std::uint32_t rays_ = 1; ///< per leaf
    std::vector<float> area_;
    std::vector<float> opacity_;
    std::vector<float> row_sums_;
};

/// Solves B = M + rho (D + K B / A) on the leaves to `tolerance` (see SolveReport) and leaves B and E in the hierarchy,
/// pulled to all levels. Conjugate gradient on the symmetric form of the equation, from the present irradiances.
SolveReport solve_radiosity(Hierarchy& hierarchy, const LeafExchange& exchange, double tolerance, int max_iterations,
                            const RunContext& context);

} // namespace atrium
