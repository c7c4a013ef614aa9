#include "engine/reference/disc_tree.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace atrium {
namespace {

constexpr std::uint32_t kLeaf = 4;

// Large, not infinite, where the direction has nothing of an axis: zero times infinity is no number.
float inverse_of(float x) { return std::abs(x) > 1e-30F ? 1.0F / x : std::copysign(1e30F, x); }

bool meets(const Box3& box, const vec3& from, const vec3& inverse, float length) {
    float near = 0.0F;
    float far = length;
    for (int axis = 0; axis < 3; ++axis) {
        const float a = (box.min[axis] - from[axis]) * inverse[axis];
        const float b = (box.max[axis] - from[axis]) * inverse[axis];
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
    }
    return near <= far;
}

} // namespace

DiscTree::DiscTree(std::span<const CausticDisc> discs, float radius)
    : discs_(discs.begin(), discs.end()), radius_(radius), order_(discs.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!discs_.empty()) {
        divide(0, std::uint32_t(discs_.size()));
    }
}

void DiscTree::divide(std::uint32_t begin, std::uint32_t end) {
    const auto index = nodes_.size();
    Node node;
    node.begin = begin;
    node.end = end;
    for (std::uint32_t k = begin; k < end; ++k) {
        const CausticDisc& d = discs_[order_[k]];
        // A little more than the disc, so that rounding takes nothing off its rim.
        const vec3 half =
            1.001F * radius_ * glm::sqrt(glm::max(vec3(1.0F) - d.normal * d.normal, vec3(0.0F))) + vec3(1e-3F * radius_);
        node.box.add(d.centre - half);
        node.box.add(d.centre + half);
    }
    nodes_.push_back(node);
    if (end - begin <= kLeaf) {
        return;
    }
    const vec3 size = node.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return discs_[a].centre[axis] < discs_[b].centre[axis]; });
    divide(begin, middle);
    nodes_[index].second = std::uint32_t(nodes_.size());
    divide(middle, end);
}

void DiscTree::crossed(const vec3& from, const vec3& direction, float length, std::vector<std::uint32_t>& out) const {
    out.clear();
    if (nodes_.empty()) {
        return;
    }
    const vec3 inverse(inverse_of(direction.x), inverse_of(direction.y), inverse_of(direction.z));
    std::array<std::uint32_t, 64> waiting{};
    std::size_t count = 1;
    while (count > 0) {
        const std::uint32_t n = waiting[--count];
        const Node& node = nodes_[n];
        if (!meets(node.box, from, inverse, length)) {
            continue;
        }
        if (node.second != 0) {
            waiting[count++] = node.second;
            waiting[count++] = n + 1;
            continue;
        }
        for (std::uint32_t k = node.begin; k < node.end; ++k) {
            const CausticDisc& disc = discs_[order_[k]];
            const float down = glm::dot(direction, disc.normal);
            const vec3 to = disc.centre - from;
            const float height = glm::dot(to, disc.normal);
            if (!(down < 0.0F) || !(height <= 0.0F) || !(height >= down * length)) {
                continue;
            }
            const float t = height / down;
            const vec3 off = direction * t - to;
            if (glm::dot(off, off) <= radius_ * radius_) {
                out.push_back(order_[k]);
            }
        }
    }
}

} // namespace atrium
