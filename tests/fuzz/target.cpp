// One fuzz target; ATRIUM_FUZZ_ENTRY is the function that it feeds.
#include "tests/fuzz/entries.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return atrium::fuzz::ATRIUM_FUZZ_ENTRY(data, size);
}
