# atrium-cli as a whole program, against CONTRACTS: exit status, streams, files, names of figures.
find_package(Python3 3.9 COMPONENTS Interpreter REQUIRED)
if(TARGET atrium-cli)
  foreach(group Requests InfoAndCheck Solve Stopping Measure Render Edit Bench Reference Inspect Compare Convert SunlitRoom SharedScenes)
    add_test(NAME cli.${group}
             COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/contracts.py ${group} -v)
    set_tests_properties(cli.${group} PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77 ENVIRONMENT
      "ATRIUM_CLI=$<TARGET_FILE:atrium-cli>;ATRIUM_SOURCE_DIR=${CMAKE_SOURCE_DIR};ATRIUM_SHARED_DIR=${CMAKE_SOURCE_DIR}/../shared")
  endforeach()
  add_test(NAME cli.Documents COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/documents.py -v)
  set_tests_properties(cli.Documents PROPERTIES TIMEOUT 120 ENVIRONMENT
    "ATRIUM_CLI=$<TARGET_FILE:atrium-cli>;ATRIUM_EDITOR=$<$<TARGET_EXISTS:atrium>:$<TARGET_FILE:atrium>>;ATRIUM_SOURCE_DIR=${CMAKE_SOURCE_DIR}")
  add_test(NAME cli.WorkedExample COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/worked_example.py)
  set_tests_properties(cli.WorkedExample PROPERTIES TIMEOUT 600 ENVIRONMENT
    "ATRIUM_CLI=$<TARGET_FILE:atrium-cli>;ATRIUM_SOURCE_DIR=${CMAKE_SOURCE_DIR}")
endif()
