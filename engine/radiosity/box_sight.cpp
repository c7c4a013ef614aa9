#include "engine/radiosity/box_sight.h"

#include <algorithm>
#include <array>

namespace atrium {
namespace {

// From a box's middle, in half its size.
constexpr float kIn = 0.85F;
constexpr std::array<vec3, 9> kInBox{{{0.0F, 0.0F, 0.0F},
                                      {kIn, kIn, kIn},
                                      {-kIn, kIn, -kIn},
                                      {kIn, -kIn, -kIn},
                                      {-kIn, -kIn, kIn},
                                      {-kIn, kIn, kIn},
                                      {kIn, kIn, -kIn},
                                      {kIn, -kIn, kIn},
                                      {-kIn, -kIn, -kIn}}};
constexpr float kShort = 2e-3F;       // metres: places on flat things lie in them
constexpr float kAround = 0.5F;       // of a box's diagonal
constexpr float kLeastAround = 0.15F; // metres

} // namespace

BoxSight::BoxSight(const RayScene& rays, std::size_t pieces)
    : rays_(rays), known_(std::make_unique<std::atomic<Known>[]>(pieces)), pieces_(pieces) {}

void BoxSight::about(std::span<const Box3> boxes, bool around) {
    const auto holds = [](const Box3& out, const Box3& in) {
        return glm::all(glm::lessThanEqual(out.min, in.min)) && glm::all(glm::greaterThanEqual(out.max, in.max));
    };
    const bool known = around && std::all_of(boxes.begin(), boxes.end(), [&](const Box3& box) {
                           return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box3& b) { return holds(b, box); });
                       });
    if (known) {
        return;
    }
    boxes_.assign(boxes.begin(), boxes.end());
    for (Box3& box : boxes_) {
        const float more = around ? std::max(kAround * box.diagonal(), kLeastAround) : 0.0F;
        box.min -= more;
        box.max += more;
    }
    for (std::size_t i = 0; i < pieces_; ++i) {
        known_[i].store(Known::Nothing, std::memory_order_relaxed);
    }
}

bool BoxSight::any(const SurfacePoint& from, float size) const {
    for (const Box3& box : boxes_) {
        const vec3 half = 0.5F * (box.max - box.min);
        const vec3 outside = glm::max(glm::abs(from.position - box.centre()) - half, vec3(0.0F));
        if (glm::length(outside) < size) {
            return true;
        }
        for (const vec3& in : kInBox) {
            const vec3 to = box.centre() + half * in - from.position;
            const float length = glm::length(to);
            if (glm::dot(to, from.normal) > 0.0F && !rays_.still_blocks({from.position, to / length, length - kShort})) {
                return true;
            }
        }
    }
    return false;
}

} // namespace atrium
