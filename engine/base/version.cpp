#include "engine/base/version.h"

#include <atrium_commit.h> // written by packaging/write_commit.cmake

namespace atrium {

std::string version_number() { return ATRIUM_VERSION; }

std::string version_text() {
    const std::string commit = ATRIUM_COMMIT;
    return commit.empty() ? version_number() : version_number() + " (" + commit + ")";
}

} // namespace atrium
