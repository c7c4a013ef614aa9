# What is left of a project when the program is killed at any moment. All 200: tests/kill/kills.py build/release/tests/kill_subject
if(TARGET atrium_ui)
  find_package(Python3 3.9 COMPONENTS Interpreter REQUIRED)
  add_executable(kill_subject ${CMAKE_CURRENT_LIST_DIR}/kill_subject.cpp)
  target_link_libraries(kill_subject PRIVATE atrium_ui)
  add_test(NAME kill.Short COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/kills.py $<TARGET_FILE:kill_subject> --kills 20)
  set_tests_properties(kill.Short PROPERTIES TIMEOUT 240)
endif()
