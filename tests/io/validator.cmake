# The Khronos glTF validator over everything that we write. It is a Node package, installed once into the build folder:
#   cp tests/io/validator/package.json BUILD/gltf-validator/ && npm install --prefix BUILD/gltf-validator
# Without node or the package the test is skipped, and says so.
if(TARGET io_tests)
  add_test(NAME io_validator_scenes COMMAND io_tests --gtest_filter=ValidatorScenes.*)
  set_tests_properties(io_validator_scenes PROPERTIES FIXTURES_SETUP validator_scenes TIMEOUT 300)
  add_test(NAME io_khronos_validator
           COMMAND sh -c "command -v node >/dev/null || { echo 'node is not installed'; exit 77; }; exec node \"$@\"" sh
                   ${CMAKE_CURRENT_LIST_DIR}/validator/validate.js ${CMAKE_BINARY_DIR}/gltf-validator
                   ${CMAKE_BINARY_DIR}/validator_scenes)
  set_tests_properties(io_khronos_validator PROPERTIES FIXTURES_REQUIRED validator_scenes SKIP_RETURN_CODE 77 TIMEOUT 300)
endif()
