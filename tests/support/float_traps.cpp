// The engine's tests run with floating-point traps (engine/base/float_traps.h): with ATRIUM_FLOAT_TRAPS=1, in builds with a
// sanitizer unless that is 0. Not in release builds by themselves: g++ 12 computes with two floats in registers of four and
// leaves in the other half what was there (its bug 110762); where that happens to be a signalling NaN, a sound division
// traps.
#include "engine/base/float_traps.h"

#include <cstdlib>
#include <string_view>

namespace {
// Before main(), so that no thread is there yet.
[[maybe_unused]] const bool traps_on = [] {
    const char* wanted = std::getenv("ATRIUM_FLOAT_TRAPS");
    const bool on = wanted == nullptr ? ATRIUM_FLOAT_TRAPS_BY_DEFAULT != 0 : std::string_view(wanted) != "0";
    if (on) {
        atrium::turn_on_float_traps();
    }
    return on;
}();
} // namespace
