// A function on the unit square that is smooth but for edges, integrated by looking closer where neighbours differ.
#pragma once

#include "engine/base/units.h"

#include <cstdint>
#include <span>
#include <vector>

namespace atrium {

/// Cells of the unit square, each with one sample at a place of its own: a point of a (0,2)-sequence, of which every cell of
/// every size holds exactly one of the first as many as there are cells. So a cell that is divided hands its sample on to
/// one of its four parts, only three are new, and edges along a row or column of cells are met at as many places as there
/// are cells. The places are the same in every grid: no noise between neighbours.
class EdgeGrid {
public:
    /// 2^log2_rows x 2^log2_columns cells; log2_columns is log2_rows or one more. A grid that is `round` has its first
    /// column beside its last. All its samples are wanted() next.
    void start(unsigned log2_rows, unsigned log2_columns, bool round);
    static constexpr unsigned kMostLog2Rows = 6; ///< no grid is divided further

    /// Places (column, row direction) whose samples are wanted, in the order in which set() takes them. After set() these
    /// are places in cells that had their parent's answer and beside which an edge was found: following an edge where it
    /// leads keeps thin things from counting only where they happened to be met. Whoever has no rays left may leave them.
    [[nodiscard]] std::span<const vec2> wanted() const { return wanted_; }
    /// The samples: what is seen, and a smooth weight that it is to be multiplied with.
    void set(std::span<const Rgb> seen, std::span<const float> weights);

    [[nodiscard]] Rgb mean_seen() const;                    ///< weighted, per unit of weight; 0 where no cell has any
    [[nodiscard]] float most_seen() const { return most_; } ///< the largest component of any sample
    /// Variance of the luminance of mean_seen(), from the cells beside which an edge lies.
    [[nodiscard]] float uncertainty() const;
    [[nodiscard]] std::size_t edge_cells() const { return edges_; }
    [[nodiscard]] bool divisible() const { return log2_rows_ < kMostLog2Rows; }
    /// Divides all cells, or looks closer only at those at edges; at most three samples for each are then wanted.
    void divide(bool all);
    [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }

private:
    [[nodiscard]] std::size_t rows() const { return std::size_t(1) << log2_rows_; }
    [[nodiscard]] std::size_t columns() const { return std::size_t(1) << log2_columns_; }
    void find_edges();

    struct Cell {
        Rgb seen{0.0F};
        float weight = 0.0F;
        std::uint8_t own = 0;  ///< the cell's own place was sampled; else it has its parent's answer
        std::uint8_t edge = 0; ///< a neighbour sees differently
    };
    unsigned log2_rows_ = 0, log2_columns_ = 0;
    bool round_ = false;
    std::vector<Cell> cells_, finer_;
    std::vector<std::uint32_t> asked_; ///< cells of wanted_
    std::vector<vec2> wanted_;
    std::size_t edges_ = 0;
    float most_ = 0.0F;
    double seen_sum_[3] = {0, 0, 0};
    double weight_sum_ = 0;
    double edge_sum_ = 0; ///< of squared light of the cells at edges
};

} // namespace atrium
