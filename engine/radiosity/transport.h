// One gather over the links with push-pull, as a linear operator, and the solver on top of it.
#pragma once

#include "engine/base/run_context.h"
#include "engine/radiosity/hierarchy.h"
#include "engine/radiosity/links.h"
#include "engine/radiosity/solve_report.h"

#include <cstdint>
#include <vector>

namespace atrium {

/// Transport between leaves: E = s * push(gather(pull(s * B))). Built once per set of links; apply() is deterministic for
/// any number of threads (every element sums its own links in link order).
class Transport {
public:
    Transport(Hierarchy& hierarchy, const std::vector<Link>& links);

    [[nodiscard]] const std::vector<std::uint32_t>& leaves() const { return leaves_; }
    /// Irradiance on every leaf for a radiosity on every leaf (same order as leaves()).
    void apply(const std::vector<Rgb>& radiosity, std::vector<Rgb>& irradiance);
    /// Sum of form factors of every leaf: what apply() gives for B = 1.
    [[nodiscard]] const std::vector<float>& row_sums() const { return row_sums_; }
    /// Closure by symmetric scaling, B' = s T s (Sinkhorn): leaves that are `enclosed` (no light can leave without meeting a
    /// linked surface) get a row sum of 1, others at most 1. Both directions of a link are scaled alike, so what one
    /// side sends is what the other receives; energy never grows.
    void close_rows(const std::vector<std::uint8_t>& enclosed);
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    struct Entry {
        std::uint32_t other;
        float weight;
        bool patches; ///< both ends are patches: weight = A F
    };
    void update_row_sums();

    Hierarchy& hierarchy_;
    std::vector<std::uint32_t> leaves_;
    std::vector<std::uint32_t> first_entry_; ///< per element, into entries_
    std::vector<Entry> entries_;
    std::vector<float> scale_;    ///< per leaf, on what it sends and on what it receives
    std::vector<float> guard_;    ///< per leaf, on what it receives: the little that symmetric scaling left over
    std::vector<float> row_sums_; ///< per leaf, after scaling
    std::vector<Rgb> gathered_;   ///< per element: irradiance of patches
};

/// Solves B = M + rho (D + T B) on the leaves to `tolerance` and leaves B and E in the hierarchy (pulled to all levels).
/// BiCGSTAB from the present radiosities: its sweeps hardly grow with reflectance, where plain gathering needs
/// ln(tolerance)/ln(rho) of them; falls back to gathering should it break down.
SolveReport solve_radiosity(Hierarchy& hierarchy, Transport& transport, double tolerance, int max_iterations,
                            const RunContext& context);

} // namespace atrium
