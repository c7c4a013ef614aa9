#include "engine/radiosity/edge_grid.h"

#include "engine/base/checks.h"
#include "engine/base/rng.h"

#include <algorithm>
#include <array>

namespace atrium {
namespace {

constexpr float kDiffers = 0.1F; // of what is seen, 0 to 1: more between neighbours is an edge

/// Which point of the sequence lies in which cell, for all grids there may be.
class Pattern {
public:
    Pattern() : points_(std::size_t(1) << (2 * EdgeGrid::kMostLog2Rows + 1)) {
        for (std::uint32_t k = 0; k < points_.size(); ++k) {
            points_[k] = sobol_owen2(k, 0, 0x5B7U);
        }
        for (unsigned longer = 0; longer < 2; ++longer) {
            for (unsigned r = 0; r <= EdgeGrid::kMostLog2Rows; ++r) {
                std::vector<std::uint16_t>& index = index_[longer][r];
                index.assign(std::size_t(1) << (2 * r + longer), 0xFFFF);
                for (std::uint32_t k = 0; k < index.size(); ++k) {
                    const auto row = std::size_t(std::ldexp(points_[k].y, int(r)));
                    const auto column = std::size_t(std::ldexp(points_[k].x, int(r + longer)));
                    std::uint16_t& cell = index[(row << (r + longer)) + column];
                    ATRIUM_CHECK(cell == 0xFFFF); // or it were no (0,2)-sequence
                    cell = std::uint16_t(k);
                }
            }
        }
    }
    static const Pattern& get() {
        static const Pattern pattern;
        return pattern;
    }
    [[nodiscard]] const std::vector<std::uint16_t>& index(unsigned log2_rows, unsigned log2_columns) const {
        return index_[log2_columns - log2_rows][log2_rows];
    }
    [[nodiscard]] const vec2& point(std::uint16_t k) const { return points_[k]; }

private:
    std::vector<vec2> points_;
    std::array<std::array<std::vector<std::uint16_t>, EdgeGrid::kMostLog2Rows + 1>, 2> index_;
};

} // namespace

void EdgeGrid::start(unsigned log2_rows, unsigned log2_columns, bool round) {
    ATRIUM_CHECK(log2_rows <= kMostLog2Rows && (log2_columns == log2_rows || log2_columns == log2_rows + 1));
    log2_rows_ = log2_rows;
    log2_columns_ = log2_columns;
    round_ = round;
    cells_.assign(rows() * columns(), Cell{});
    asked_.clear();
    wanted_.clear();
    const auto& index = Pattern::get().index(log2_rows, log2_columns);
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
        asked_.push_back(i);
        wanted_.push_back(Pattern::get().point(index[i]));
    }
}

void EdgeGrid::set(std::span<const Rgb> seen, std::span<const float> weights) {
    ATRIUM_CHECK(seen.size() == asked_.size() && weights.size() == asked_.size());
    for (std::size_t i = 0; i < asked_.size(); ++i) {
        Cell& c = cells_[asked_[i]];
        c.seen = seen[i];
        c.weight = weights[i];
        c.own = 1;
    }
    find_edges();
    asked_.clear();
    wanted_.clear();
    const auto& index = Pattern::get().index(log2_rows_, log2_columns_);
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
        if (cells_[i].edge != 0 && cells_[i].own == 0) {
            asked_.push_back(i);
            wanted_.push_back(Pattern::get().point(index[i]));
        }
    }
}

void EdgeGrid::find_edges() {
    edges_ = 0;
    weight_sum_ = edge_sum_ = 0.0;
    most_ = 0.0F;
    std::fill(std::begin(seen_sum_), std::end(seen_sum_), 0.0);
    const std::size_t nr = rows(), nc = columns();
    for (Cell& c : cells_) {
        c.edge = 0;
    }
    const auto compare = [](Cell& a, Cell& b) {
        const vec3 d = a.seen - b.seen;
        const bool differs = std::abs(d.x) > kDiffers || std::abs(d.y) > kDiffers || std::abs(d.z) > kDiffers;
        // What lies below the horizon has no say.
        if (differs && a.weight > 0.0F && b.weight > 0.0F) {
            a.edge = b.edge = 1;
        }
    };
    for (std::size_t r = 0; r < nr; ++r) {
        Cell* row = &cells_[r * nc];
        for (std::size_t c = 0; c + 1 < nc; ++c) {
            compare(row[c], row[c + 1]);
        }
        if (round_) {
            compare(row[nc - 1], row[0]);
        }
        for (std::size_t c = 0; r + 1 < nr && c < nc; ++c) {
            compare(row[c], row[nc + c]);
        }
    }
    for (const Cell& c : cells_) {
        weight_sum_ += c.weight;
        most_ = c.weight > 0.0F ? std::max({most_, c.seen.x, c.seen.y, c.seen.z}) : most_;
        for (int k = 0; k < 3; ++k) {
            seen_sum_[k] += double(c.seen[k]) * c.weight;
        }
        if (c.edge != 0) {
            ++edges_;
            edge_sum_ += double(c.weight) * c.weight;
        }
    }
}

Rgb EdgeGrid::mean_seen() const {
    return weight_sum_ > 0.0
               ? Rgb(float(seen_sum_[0] / weight_sum_), float(seen_sum_[1] / weight_sum_), float(seen_sum_[2] / weight_sum_))
               : Rgb(0.0F);
}

// A cell that an edge cuts is seen to some share between none and all, any with the same chance: a variance of 1/12 of its
// light squared; of the two cells whose difference tells of the edge it cuts one. What no sample has met is not in it: that
// is missed by neighbouring receivers alike, and a bias that is smooth must not pass for noise.
float EdgeGrid::uncertainty() const {
    return weight_sum_ > 0.0 ? float(0.5 * edge_sum_ / (12.0 * weight_sum_ * weight_sum_)) : 0.0F;
}

void EdgeGrid::divide(bool all) {
    ATRIUM_CHECK(divisible());
    const std::size_t nr = rows(), nc = columns();
    const auto& before = Pattern::get().index(log2_rows_, log2_columns_);
    const auto& index = Pattern::get().index(log2_rows_ + 1, log2_columns_ + 1);
    finer_.resize(4 * cells_.size());
    asked_.clear();
    wanted_.clear();
    for (std::size_t r = 0; r < 2 * nr; ++r) {
        for (std::size_t c = 0; c < 2 * nc; ++c) {
            const std::size_t parent = r / 2 * nc + c / 2, child = r * 2 * nc + c;
            Cell& cell = finer_[child] = cells_[parent];
            cell.own = cells_[parent].own != 0 && index[child] == before[parent] ? 1 : 0;
            if ((all || cells_[parent].edge != 0) && cell.own == 0) {
                asked_.push_back(std::uint32_t(child));
                wanted_.push_back(Pattern::get().point(index[child]));
            }
        }
    }
    std::swap(cells_, finer_);
    ++log2_rows_;
    ++log2_columns_;
}

} // namespace atrium
