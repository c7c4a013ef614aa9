#include "engine/base/parallel.h"

#include "engine/base/float_traps.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <pmmintrin.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <thread>
#include <vector>
#include <xmmintrin.h>

namespace atrium {
namespace {
std::mutex limit_mutex; // guards the two below
std::unique_ptr<tbb::global_control> limit_control;
unsigned limit_value = 0;

// Calls `body` for every index below `count`, on several threads.
template <class F> void on_threads(std::size_t count, const F& body) {
#if defined(__SANITIZE_THREAD__)
    // Debian's TBB is built without the thread sanitizer, which would take each of its hand-overs for a race.
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < count; i = next++) {
            body(i);
        }
    };
    std::vector<std::jthread> helpers;
    while (helpers.size() + 1 < std::min<std::size_t>(count, thread_limit())) {
        helpers.emplace_back(work);
    }
    work();
#else
    tbb::parallel_for(std::size_t(0), count, body);
#endif
}
} // namespace

void set_thread_limit(unsigned threads) {
    const std::lock_guard lock(limit_mutex);
    limit_control.reset();
    limit_value = threads;
    if (threads != 0) {
        limit_control =
            std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
    }
}

unsigned thread_limit() {
    const std::lock_guard lock(limit_mutex);
    return limit_value != 0 ? limit_value : std::max(1U, std::thread::hardware_concurrency());
}

void parallel_chunks(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t, std::size_t, std::size_t)>& body) {
    if (count == 0) {
        return;
    }
    const std::size_t chunks = chunk_count(count, grain);
    on_threads(chunks, [&](std::size_t chunk) {
        // Worker threads belong to TBB, so the mode is set per chunk (two instructions) and put back after it.
        const unsigned saved = _mm_getcsr();
        _mm_setcsr(with_float_traps(saved | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON));
        const std::size_t begin = chunk * grain;
        body(begin, std::min(begin + grain, count), chunk);
        _mm_setcsr(saved);
    });
}

} // namespace atrium
