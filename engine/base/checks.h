// CHECK: our own mistakes stop the program with the place; never used for bad input.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace atrium::detail {
[[noreturn]] inline void check_failed(const char* expression, const char* file, int line) {
    std::fprintf(stderr, "internal error: %s (%s:%d)\n", expression, file, line);
    std::abort();
}
} // namespace atrium::detail

#define ATRIUM_CHECK(expression)                                                                                            \
    ((expression) ? static_cast<void>(0) : ::atrium::detail::check_failed(#expression, __FILE_NAME__, __LINE__))
