# Benchmarks are built with the tests, so that they keep compiling, and run by hand: see tests/bench/README.md.
find_package(benchmark REQUIRED)
add_executable(engine_bench ${CMAKE_CURRENT_LIST_DIR}/engine_bench.cpp)
target_link_libraries(engine_bench PRIVATE atrium_engine benchmark::benchmark)
