# The editor's own tests: documents and fields without a screen would do, windows need one, so all run under Xvfb.
if(TARGET atrium_ui)
  file(GLOB ui_test_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*_test.cpp ${CMAKE_CURRENT_LIST_DIR}/main.cpp
       ${CMAKE_CURRENT_LIST_DIR}/window_fixture.cpp ${CMAKE_CURRENT_LIST_DIR}/session_work.cpp)
  add_executable(ui_tests ${ui_test_sources})
  target_link_libraries(ui_tests PRIVATE atrium_ui Qt6::Test GTest::gtest)
  target_compile_definitions(ui_tests PRIVATE ATRIUM_SHARED_DIR="${CMAKE_SOURCE_DIR}/../shared"
                             ATRIUM_SOURCE_DIR="${CMAKE_SOURCE_DIR}" ATRIUM_CLI="$<TARGET_FILE:atrium-cli>")
  add_dependencies(ui_tests atrium-cli)
  target_precompile_headers(ui_tests REUSE_FROM atrium_ui)
  find_program(XVFB_RUN xvfb-run)
  if(XVFB_RUN)
    add_test(NAME ui COMMAND ${XVFB_RUN} -a -s "-screen 0 1400x900x24" $<TARGET_FILE:ui_tests> --gtest_filter=-*Interiors*:*Session*)
    set_tests_properties(ui PROPERTIES TIMEOUT 300 ENVIRONMENT "QT_QPA_PLATFORM=xcb;LC_ALL=C.UTF-8")
    # Real interiors take their time: an entry of their own.
    add_test(NAME ui_interiors COMMAND ${XVFB_RUN} -a -s "-screen 0 1400x900x24" $<TARGET_FILE:ui_tests> --gtest_filter=*Interiors*)
    set_tests_properties(ui_interiors PROPERTIES TIMEOUT 600 ENVIRONMENT "QT_QPA_PLATFORM=xcb;LC_ALL=C.UTF-8")
    # An architect's quarter of an hour, by mouse and keys, with a kill at its end: in a room, in a shared office. The cabin takes
    # several minutes and is played by hand: ui_tests --gtest_filter=*Session.*/cabin
    foreach(stage sunlit_room office)
      add_test(NAME ui_session_${stage}
               COMMAND ${XVFB_RUN} -a -s "-screen 0 1400x900x24" $<TARGET_FILE:ui_tests> --gtest_filter=*Session.*/${stage})
      set_tests_properties(ui_session_${stage} PROPERTIES TIMEOUT 900 RUN_SERIAL TRUE ENVIRONMENT "QT_QPA_PLATFORM=xcb;LC_ALL=C.UTF-8")
    endforeach()
    # A file that is not there: a message and an exit status, not a picture of a message box.
    add_test(NAME screenshot_of_nothing COMMAND ${XVFB_RUN} -a $<TARGET_FILE:atrium> no/such/room.glb --screenshot nothing.png)
    set_tests_properties(screenshot_of_nothing PROPERTIES TIMEOUT 60 WILL_FAIL TRUE
      ENVIRONMENT "QT_QPA_PLATFORM=xcb;LC_ALL=C.UTF-8")
  endif()
endif()
