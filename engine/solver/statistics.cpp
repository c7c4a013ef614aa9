#include "engine/solver/statistics.h"

#include <sys/resource.h>

namespace atrium {

std::uint64_t peak_resident_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::uint64_t(usage.ru_maxrss) * 1024U; // Linux reports kibibytes
}

} // namespace atrium
