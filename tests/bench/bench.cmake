# Benchmarks are built with the tests, so that they keep compiling, and run by hand: see tests/bench/README.md.
find_package(benchmark REQUIRED)
add_executable(engine_bench ${CMAKE_CURRENT_LIST_DIR}/engine_bench.cpp)
target_link_libraries(engine_bench PRIVATE atrium_engine benchmark::benchmark)

add_executable(accuracy_bench
  ${CMAKE_CURRENT_LIST_DIR}/accuracy_bench.cpp ${CMAKE_CURRENT_LIST_DIR}/accuracy_reference.cpp
  ${CMAKE_CURRENT_LIST_DIR}/accuracy_curve.cpp)
target_link_libraries(accuracy_bench PRIVATE atrium_engine CLI11::CLI11)
target_compile_definitions(accuracy_bench PRIVATE
  ATRIUM_SOURCE_DIR="${CMAKE_SOURCE_DIR}" ATRIUM_SHARED_DIR="${CMAKE_SOURCE_DIR}/../shared")

add_executable(diffuse_bench
  ${CMAKE_CURRENT_LIST_DIR}/diffuse_bench.cpp ${CMAKE_CURRENT_LIST_DIR}/floor_bench.cpp
  ${CMAKE_CURRENT_LIST_DIR}/solve_bench.cpp ${CMAKE_CURRENT_LIST_DIR}/bare_embree.cpp
  ${CMAKE_CURRENT_LIST_DIR}/tessellated_room.cpp)
target_link_libraries(diffuse_bench PRIVATE atrium_engine CLI11::CLI11 embree)
target_compile_definitions(diffuse_bench PRIVATE
  ATRIUM_SOURCE_DIR="${CMAKE_SOURCE_DIR}" ATRIUM_SHARED_DIR="${CMAKE_SOURCE_DIR}/../shared")

add_executable(particle_bench ${CMAKE_CURRENT_LIST_DIR}/particle_bench.cpp ${CMAKE_CURRENT_LIST_DIR}/bare_embree.cpp)
target_link_libraries(particle_bench PRIVATE atrium_engine CLI11::CLI11 embree)

add_executable(caustic_bench ${CMAKE_CURRENT_LIST_DIR}/caustic_bench.cpp ${CMAKE_CURRENT_LIST_DIR}/caustic_scenes.cpp)
target_link_libraries(caustic_bench PRIVATE atrium_engine CLI11::CLI11)

add_executable(particle_update_bench
  ${CMAKE_CURRENT_LIST_DIR}/particle_update_bench.cpp ${CMAKE_CURRENT_LIST_DIR}/caustic_scenes.cpp)
target_link_libraries(particle_update_bench PRIVATE atrium_engine CLI11::CLI11)

add_executable(move_bench ${CMAKE_CURRENT_LIST_DIR}/move_bench.cpp)
target_link_libraries(move_bench PRIVATE atrium_engine)
target_compile_definitions(move_bench PRIVATE ATRIUM_SOURCE_DIR="${CMAKE_SOURCE_DIR}")

add_executable(drag_bench ${CMAKE_CURRENT_LIST_DIR}/drag_bench.cpp)
target_link_libraries(drag_bench PRIVATE atrium_engine CLI11::CLI11)

add_executable(direct_light_bench ${CMAKE_CURRENT_LIST_DIR}/direct_light_bench.cpp)
target_link_libraries(direct_light_bench PRIVATE atrium_engine CLI11::CLI11)

add_executable(relight_bench ${CMAKE_CURRENT_LIST_DIR}/relight_bench.cpp)
target_link_libraries(relight_bench PRIVATE atrium_engine CLI11::CLI11)

add_executable(edit_sequence_bench ${CMAKE_CURRENT_LIST_DIR}/edit_sequence_bench.cpp)
target_link_libraries(edit_sequence_bench PRIVATE atrium_engine CLI11::CLI11)
add_executable(project_bench ${CMAKE_CURRENT_LIST_DIR}/project_bench.cpp)
target_link_libraries(project_bench PRIVATE atrium_engine CLI11::CLI11)
add_executable(stills_bench ${CMAKE_CURRENT_LIST_DIR}/stills_bench.cpp)
target_link_libraries(stills_bench PRIVATE atrium_engine CLI11::CLI11)
target_compile_definitions(stills_bench PRIVATE ATRIUM_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
add_executable(peer_bench ${CMAKE_CURRENT_LIST_DIR}/peer_bench.cpp)
target_link_libraries(peer_bench PRIVATE atrium_engine CLI11::CLI11)
add_executable(specular_bench ${CMAKE_CURRENT_LIST_DIR}/specular_bench.cpp)
target_link_libraries(specular_bench PRIVATE atrium_engine CLI11::CLI11)
add_executable(wish_bench ${CMAKE_CURRENT_LIST_DIR}/wish_bench.cpp)
target_link_libraries(wish_bench PRIVATE atrium_engine CLI11::CLI11)
