# Benchmarks are built with the tests, so that they keep compiling, and run by hand: see tests/bench/README.md.
find_package(benchmark REQUIRED)
add_executable(engine_bench ${CMAKE_CURRENT_LIST_DIR}/engine_bench.cpp)
target_link_libraries(engine_bench PRIVATE atrium_engine benchmark::benchmark)

add_executable(accuracy_bench ${CMAKE_CURRENT_LIST_DIR}/accuracy_bench.cpp)
target_link_libraries(accuracy_bench PRIVATE atrium_engine CLI11::CLI11)
target_compile_definitions(accuracy_bench PRIVATE
  ATRIUM_SOURCE_DIR="${CMAKE_SOURCE_DIR}" ATRIUM_SHARED_DIR="${CMAKE_SOURCE_DIR}/../shared")
