#include "engine/reference/start_guide.h"

#include <algorithm>
#include <cstdint>

namespace atrium {
namespace {

constexpr double kEven = 0.2;           // share of the starts that follow no trial
constexpr std::size_t kFewTrials = 128; // in a box that is not cut further: what they tell is chance
constexpr double kLeastShare = 0.05;    // of the starts of a box, for either half
constexpr int kDeepest = 28;

} // namespace

StartGuide::StartGuide(std::span<const Trial> trials) {
    std::vector<Trial> own(trials.begin(), trials.end());
    if (std::none_of(own.begin(), own.end(), [](const Trial& t) { return t.use > 0.0F; })) {
        return;
    }
    nodes_.emplace_back();
    divide(0, own, dvec4(0.0), dvec4(1.0), 0);
}

// Halves of boxes, by the axis whose halves differ most in what came of them.
void StartGuide::divide(std::uint32_t node, std::span<Trial> trials, dvec4 low, dvec4 high, int depth) {
    if (trials.size() < kFewTrials || depth >= kDeepest) {
        return;
    }
    std::uint8_t best = 0;
    double best_low = 0.0;
    double best_all = 0.0;
    double most = -1.0;
    for (std::uint8_t axis = 0; axis < 4; ++axis) {
        const double middle = 0.5 * (low[axis] + high[axis]);
        double below = 0.0;
        double all = 0.0;
        for (const Trial& t : trials) {
            const double use = double(t.use) / double(t.density);
            all += use;
            below += t.at[axis] < middle ? use : 0.0;
        }
        const double uneven = std::abs(2.0 * below - all);
        if (uneven > most) {
            most = uneven;
            best = axis;
            best_low = below;
            best_all = all;
        }
    }
    if (!(best_all > 0.0)) {
        return;
    }
    const double middle = 0.5 * (low[best] + high[best]);
    const auto cut =
        std::stable_partition(trials.begin(), trials.end(), [&](const Trial& t) { return t.at[best] < middle; });
    const auto first = std::uint32_t(nodes_.size());
    nodes_[node].axis = best;
    nodes_[node].at = middle;
    // Neither half is given up: few trials may all have missed.
    nodes_[node].low_share = std::clamp(best_low / best_all, kLeastShare, 1.0 - kLeastShare);
    nodes_[node].first = first;
    nodes_.resize(nodes_.size() + 2);
    dvec4 middle_high = high;
    middle_high[best] = middle;
    dvec4 middle_low = low;
    middle_low[best] = middle;
    const auto below = std::size_t(cut - trials.begin());
    divide(first, trials.first(below), low, middle_high, depth + 1);
    divide(first + 1, trials.subspan(below), middle_low, high, depth + 1);
}

StartGuide::Start StartGuide::operator()(dvec4 u) const {
    if (nodes_.empty()) {
        return {u, 1.0F};
    }
    // The first number also chooses whether the tree is followed; either way the density is that of both together.
    const bool even = u.x < kEven;
    u.x = even ? u.x / kEven : (u.x - kEven) / (1.0 - kEven);
    Start out;
    out.at = u;
    double density = 1.0;
    dvec4 low(0.0);
    dvec4 high(1.0);
    for (std::uint32_t n = 0; nodes_[n].first != 0;) {
        const Node& node = nodes_[n];
        const int axis = node.axis;
        bool lower = false;
        if (even) {
            lower = u[axis] < node.at;
        } else { // of what is left of this axis' number a share goes to each half, stretched to [0, 1) again
            lower = u[axis] < node.low_share;
            u[axis] = lower ? u[axis] / node.low_share : (u[axis] - node.low_share) / (1.0 - node.low_share);
        }
        density *= 2.0 * (lower ? node.low_share : 1.0 - node.low_share);
        (lower ? high : low)[axis] = node.at;
        n = node.first + (lower ? 0 : 1);
    }
    if (!even) {
        out.at = low + u * (high - low);
    }
    out.density = float(kEven + (1.0 - kEven) * density);
    return out;
}

} // namespace atrium
