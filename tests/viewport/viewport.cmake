# Viewport tests: pure logic and, under Xvfb, real pictures and mouse events.
if(TARGET atrium_ui)
  file(GLOB viewport_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*_test.cpp ${CMAKE_CURRENT_LIST_DIR}/main.cpp
       ${CMAKE_CURRENT_LIST_DIR}/fixture.cpp)
  add_executable(viewport_tests ${viewport_sources})
  target_link_libraries(viewport_tests PRIVATE atrium_ui Qt6::Test GTest::gtest)
  target_compile_definitions(viewport_tests PRIVATE ATRIUM_SHARED_DIR="${CMAKE_SOURCE_DIR}/../shared")
  target_precompile_headers(viewport_tests REUSE_FROM atrium_ui)
  set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/specular_overlay_test.cpp PROPERTIES
    COMPILE_DEFINITIONS ATRIUM_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  find_program(XVFB_RUN xvfb-run)
  if(XVFB_RUN)
    foreach(scale 1 1.5)
      add_test(NAME viewport_scale_${scale}
               COMMAND ${XVFB_RUN} -a -s "-screen 0 1280x800x24" $<TARGET_FILE:viewport_tests>)
      set_tests_properties(viewport_scale_${scale} PROPERTIES TIMEOUT 300 RUN_SERIAL TRUE
        ENVIRONMENT "QT_QPA_PLATFORM=xcb;LC_ALL=C.UTF-8;QT_SCALE_FACTOR=${scale}")
    endforeach()
  endif()
endif()
