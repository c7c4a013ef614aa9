// Floating-point traps: while they are on, an invalid operation, a division by zero or an overflow ends the program where it
// happens and not where its infinity is seen. For tests; off unless turned on.
#pragma once

#include <xmmintrin.h>

namespace atrium {

namespace detail {
inline bool float_traps_on = false;
inline constexpr unsigned kTrapped = _MM_MASK_INVALID | _MM_MASK_DIV_ZERO | _MM_MASK_OVERFLOW;
} // namespace detail

/// Turns traps on for this thread, for threads that it starts from now on and for the bodies of all loops of
/// parallel_chunks(). Call it before anything else runs.
inline void turn_on_float_traps() {
    detail::float_traps_on = true;
    _mm_setcsr(_mm_getcsr() & ~(detail::kTrapped | _MM_EXCEPT_MASK));
}

/// `csr` with the traps that are on.
inline unsigned with_float_traps(unsigned csr) {
    return detail::float_traps_on ? csr & ~(detail::kTrapped | _MM_EXCEPT_MASK) : csr;
}

/// While it lives there are no traps on this thread: for calls into libraries that count on infinities, as Embree does for
/// rays along an axis. Costs a test of a flag where traps are off.
class FloatTrapsOff {
public:
    FloatTrapsOff() {
        if (detail::float_traps_on) {
            saved_ = _mm_getcsr();
            _mm_setcsr(saved_ | detail::kTrapped);
        }
    }
    ~FloatTrapsOff() {
        if (detail::float_traps_on) {
            _mm_setcsr(saved_);
        }
    }
    FloatTrapsOff(const FloatTrapsOff&) = delete;
    FloatTrapsOff& operator=(const FloatTrapsOff&) = delete;

private:
    unsigned saved_ = 0;
};

} // namespace atrium
