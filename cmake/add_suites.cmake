# Writes INCLUDE, from which ctest reads the tests of the GoogleTest program PROGRAM: one per suite and one per pattern of LONG.
#   cmake -D PROGRAM= -D INCLUDE= -D PREFIX= -D LABEL= -D LONG= -D OMITTED= -D ENVIRONMENT= -P add_suites.cmake
# LONG and OMITTED are GoogleTest patterns, separated by ":". A process per suite instead of one per test saves loading a hundred
# libraries each time.

execute_process(COMMAND ${PROGRAM} --gtest_list_tests --gtest_filter=-${LONG}:${OMITTED}
                OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[][;]" "" listed "${listed}")  # CMake would read lists in parameters
string(REPLACE "\n" ";" listed "${listed}")
set(suites)
foreach(line IN LISTS listed)
  if(line MATCHES "^([^ ]+)[.]")
    set(suite ${CMAKE_MATCH_1})
  elseif(line MATCHES "^  " AND NOT "${suite}.${line}" MATCHES "DISABLED_")
    list(APPEND suites ${suite})
  endif()
endforeach()
list(REMOVE_DUPLICATES suites)

set(text "")
foreach(suite IN LISTS suites)
  string(APPEND text "add_test([[${PREFIX}${suite}]] [[${PROGRAM}]] [[--gtest_filter=${suite}.*-${LONG}:${OMITTED}]])\n"
                     "set_tests_properties([[${PREFIX}${suite}]] PROPERTIES LABELS ${LABEL} ENVIRONMENT [[${ENVIRONMENT}]])\n")
endforeach()
string(REPLACE ":" ";" LONG "${LONG}")
foreach(pattern IN LISTS LONG)
  execute_process(COMMAND ${PROGRAM} --gtest_list_tests --gtest_filter=${pattern}
                  OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
  if(NOT listed MATCHES "\n  ")  # a test of ctest without tests would pass
    message(FATAL_ERROR "${PROGRAM} has no test that matches ${pattern}")
  endif()
  string(APPEND text "add_test([[${PREFIX}${pattern}]] [[${PROGRAM}]] [[--gtest_filter=${pattern}-${OMITTED}]])\n"
                     "set_tests_properties([[${PREFIX}${pattern}]] PROPERTIES LABELS long ENVIRONMENT [[${ENVIRONMENT}]])\n")
endforeach()
file(WRITE ${INCLUDE} "${text}")
