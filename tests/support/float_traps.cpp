// The engine's tests run with floating-point traps (engine/base/float_traps.h), but for ATRIUM_FLOAT_TRAPS=0.
#include "engine/base/float_traps.h"

#include <cstdlib>
#include <string_view>

namespace {
// Before main(), so that no thread is there yet.
[[maybe_unused]] const bool traps_on = [] {
    const char* wanted = std::getenv("ATRIUM_FLOAT_TRAPS");
    const bool on = wanted == nullptr || std::string_view(wanted) != "0";
    if (on) {
        atrium::turn_on_float_traps();
    }
    return on;
}();
} // namespace
