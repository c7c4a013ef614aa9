# The gallery of hard cases (scenes/hard): all of them by tests/extreme/run, those that take seconds in CTest.
find_package(Python3 3.9 COMPONENTS Interpreter REQUIRED)
add_executable(extreme_probe ${CMAKE_CURRENT_LIST_DIR}/probe.cpp)
target_link_libraries(extreme_probe PRIVATE atrium_engine nlohmann_json::nlohmann_json)
add_test(NAME extreme.gallery COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/run --quick --probe $<TARGET_FILE:extreme_probe>)
set_tests_properties(extreme.gallery PROPERTIES TIMEOUT 600)
