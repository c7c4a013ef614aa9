# Writes OUTPUT, a header that names the commit in SOURCE, and touches it only when that changes. Run at every build.
# Without git or outside a checkout the name is empty, unless ATRIUM_COMMIT in the environment has it.
set(commit "$ENV{ATRIUM_COMMIT}")
find_program(GIT git)
if(commit STREQUAL "" AND GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --short=12 HEAD OUTPUT_VARIABLE commit
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${GIT} -C ${SOURCE} diff-index --quiet HEAD -- RESULT_VARIABLE changed ERROR_QUIET)
  if(changed AND NOT commit STREQUAL "")
    string(APPEND commit ", modified")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define ATRIUM_COMMIT \"${commit}\"\n")
