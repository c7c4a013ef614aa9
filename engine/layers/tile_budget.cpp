#include "engine/layers/tile_budget.h"

#include <algorithm>
#include <iterator>

namespace atrium {
namespace {

std::size_t texels(std::uint32_t level) {
    const std::size_t edge = (std::size_t(1) << level) + 1;
    return edge * edge;
}

} // namespace

void TileBudget::add_tile(std::uint32_t level, bool used) {
    levels_.push_back(level);
    samples_ += used ? texels(level) : 0;
}

std::vector<std::uint32_t> TileBudget::grow(const std::vector<TileGrowth>& wishes) {
    std::vector<TileGrowth> one_each;
    for (const TileGrowth& w : wishes) {
        if (w.level <= levels_[w.tile]) {
            continue;
        }
        if (one_each.empty() || one_each.back().tile != w.tile) {
            one_each.push_back(w);
        }
        one_each.back().level = std::max(one_each.back().level, w.level);
        one_each.back().error = std::max(one_each.back().error, w.error);
    }
    std::stable_sort(one_each.begin(), one_each.end(),
                     [](const TileGrowth& a, const TileGrowth& b) { return a.error > b.error; });
    std::vector<std::uint32_t> refused;
    for (const TileGrowth& w : one_each) {
        const std::size_t more = texels(w.level) - texels(levels_[w.tile]);
        if (samples_ + more <= max_samples_) {
            samples_ += more;
            levels_[w.tile] = w.level;
        } else {
            refused.push_back(w.tile);
        }
    }
    std::sort(refused.begin(), refused.end());
    std::vector<std::uint32_t> all;
    std::set_union(limited_.begin(), limited_.end(), refused.begin(), refused.end(), std::back_inserter(all));
    limited_.swap(all);
    return refused;
}

} // namespace atrium
