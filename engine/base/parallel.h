// Parallel loops with a fixed partition: the same chunks for any number of threads, so results never depend on it.
#pragma once

#include <cstddef>
#include <functional>

namespace atrium {

/// Upper bound on worker threads for every following parallel loop of the process; 0 = all cores. Engine thread only.
void set_thread_limit(unsigned threads);
/// The bound in force (number of cores when none was set).
unsigned thread_limit();

/// Calls body(begin, end, chunk_index) for consecutive chunks of [0, count) of `grain` items (the last may be short),
/// in any order, on worker threads. Rounding is left alone, denormals are flushed, and traps are those of float_traps.h.
/// `body` must not throw.
void parallel_chunks(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t begin, std::size_t end, std::size_t chunk)>& body);

/// Number of chunks parallel_chunks() makes: for per-chunk partial sums that are then added in chunk order.
inline std::size_t chunk_count(std::size_t count, std::size_t grain) { return (count + grain - 1) / grain; }

/// Deterministic parallel sum: partial sums per chunk, added in chunk order.
template <class T, class F> T parallel_sum(std::size_t count, std::size_t grain, T zero, F&& term);

} // namespace atrium

#include <vector>

template <class T, class F> T atrium::parallel_sum(std::size_t count, std::size_t grain, T zero, F&& term) {
    std::vector<T> partial(chunk_count(count, grain), zero);
    parallel_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        T sum = zero;
        for (std::size_t i = begin; i < end; ++i) {
            sum += term(i);
        }
        partial[chunk] = sum;
    });
    T total = zero;
    for (const T& p : partial) {
        total += p;
    }
    return total;
}
