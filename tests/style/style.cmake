# Rules about the sources themselves.
find_package(Python3 3.9 COMPONENTS Interpreter REQUIRED)
add_test(NAME style.layers COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/check_layers.py ${CMAKE_SOURCE_DIR})
add_test(NAME style.layers_self_test COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/check_layers.py --self-test)
add_test(NAME style.format COMMAND ${CMAKE_CURRENT_LIST_DIR}/check_format.sh ${CMAKE_SOURCE_DIR})
# The scenes that ship are what their scripts write.
add_test(NAME style.scenes_are_generated
         COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/check_generated_scene.py ${CMAKE_SOURCE_DIR})
set_tests_properties(style.layers style.layers_self_test style.format style.scenes_are_generated
                     PROPERTIES TIMEOUT 60 SKIP_RETURN_CODE 77)
# Every text of the window is translated, and values stand where they do in the source.
add_test(NAME style.translations COMMAND Python3::Interpreter ${CMAKE_SOURCE_DIR}/packaging/update_translations --check)
set_tests_properties(style.translations PROPERTIES TIMEOUT 120 SKIP_RETURN_CODE 77)
