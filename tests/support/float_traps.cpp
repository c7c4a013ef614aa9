// ATRIUM_FLOAT_TRAPS=1 runs the engine's tests with floating-point traps: see engine/base/float_traps.h.
#include "engine/base/float_traps.h"

#include <cstdlib>
#include <string_view>

namespace {
// Before main(), so that no thread is there yet.
[[maybe_unused]] const bool traps_on = [] {
    const char* wanted = std::getenv("ATRIUM_FLOAT_TRAPS");
    const bool on = wanted != nullptr && std::string_view(wanted) == "1";
    if (on) {
        atrium::turn_on_float_traps();
    }
    return on;
}();
} // namespace
