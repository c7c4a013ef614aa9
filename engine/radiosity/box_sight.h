// Whether places can see something at all: most of a house cannot see what moves in one of its rooms.
#pragma once

#include "engine/radiosity/hierarchy.h"

#include <atomic>
#include <memory>
#include <span>
#include <vector>

namespace atrium {

/// Sight between numbered pieces of surfaces and a few boxes past everything that has not moved (RayScene::still_blocks()).
/// Found by a few rays when first asked for, so what shows through a gap may be missed. Asked from many threads.
class BoxSight {
public:
    /// `rays` must outlive it.
    BoxSight(const RayScene& rays, std::size_t pieces);
    /// From here on these boxes are meant. With `around` more than they hold is: what is known then stays as long as later
    /// boxes lie within, as they do from step to step of a drag. No sees() may run.
    void about(std::span<const Box3> boxes, bool around);
    /// `look()` answers for the piece, by any() of places on it; it is called once.
    template <class Look> bool sees(std::size_t piece, const Look& look) {
        const Known known = known_[piece].load(std::memory_order_relaxed);
        if (known != Known::Nothing) {
            return known == Known::Sees;
        }
        const bool sees = look(); // whoever asks meanwhile finds the same
        known_[piece].store(sees ? Known::Sees : Known::Blind, std::memory_order_relaxed);
        return sees;
    }
    /// A place on a piece of that size, metres, sees a place in a box, or is beside it.
    [[nodiscard]] bool any(const SurfacePoint& from, float size) const;

private:
    enum class Known : std::uint8_t { Nothing, Sees, Blind };

    const RayScene& rays_;
    std::vector<Box3> boxes_;
    std::unique_ptr<std::atomic<Known>[]> known_; ///< per piece
    std::size_t pieces_;
};

} // namespace atrium
