# Run after PROGRAM, tests of googletest, is linked: writes FILE, by which ctest has an entry FOLDER.SUITE for each suite. Tests
# of a suite share a device and the kernels that it compiled; an entry for each test would make both again.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE list RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests: ${result}")
endif()
# A suite's line ends in a dot and maybe a comment; those of its tests are indented.
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${list}")
set(text)
foreach(suite ${suites})
  string(STRIP "${suite}" suite)
  string(REGEX REPLACE "\\.$" "" suite "${suite}")
  string(APPEND text "add_test([=[${FOLDER}.${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
    "set_tests_properties([=[${FOLDER}.${suite}]=] PROPERTIES TIMEOUT 900 ENVIRONMENT [=[${ENVIRONMENT}]=])\n")
endforeach()
file(WRITE ${FILE} "${text}")
