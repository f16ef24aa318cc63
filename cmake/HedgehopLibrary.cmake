# Declares libraries and tests, and enforces the layer table of the top CMakeLists.txt.
include_guard()

add_library(hedgehop_warnings INTERFACE)
target_compile_options(hedgehop_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                       -Wold-style-cast -Woverloaded-virtual -Wno-missing-field-initializers
                       # a unity build includes sources like headers
                       $<$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>:-Wno-subobject-linkage>
                       # false alarms of GCC 12 at -O3 in std::string and Eigen
                       -Wno-restrict -Wno-maybe-uninitialized -Wno-stringop-overflow -Wno-array-bounds)
if(HEDGEHOP_WERROR)
  target_compile_options(hedgehop_warnings INTERFACE -Werror)
endif()

# Libraries are position-independent because external modules link against them. This option keeps inlining as without it.
set(HEDGEHOP_LIBRARY_OPTIONS -fno-semantic-interposition)
# Halves the compile time of code that does not run inside the simulation loop.
set(HEDGEHOP_COLD_OPTIONS $<$<CONFIG:Release>:-Og>)

# hedgehop_library(<folder> [COLD] HDRS ... [SRCS ...] DEPS <folders> [PACKAGES <targets>]); without SRCS a header-only library
function(hedgehop_library folder)
  cmake_parse_arguments(arg "COLD" "" "HDRS;SRCS;DEPS;PACKAGES" ${ARGN})
  string(REPLACE "/" "_" name ${folder})
  set(target hedgehop_${name})
  hedgehop_check_layers(${folder} "${arg_DEPS}")

  if(arg_SRCS)
    set(scope PUBLIC)
    add_library(${target} STATIC ${arg_SRCS})
    if(TARGET hedgehop_sim_libm)  # absent in the small projects of tests/style
      target_link_libraries(${target} PUBLIC hedgehop_sim_libm)
    endif()
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    set(headers hedgehop_library_headers)
    target_compile_options(${target} PRIVATE ${HEDGEHOP_LIBRARY_OPTIONS})
    if(arg_COLD)
      set(headers hedgehop_cold_headers)
      target_compile_options(${target} PRIVATE ${HEDGEHOP_COLD_OPTIONS})
    endif()
    if(COMMAND hedgehop_use_precompiled)  # absent in the small projects of tests/style
      hedgehop_use_precompiled(${target} ${headers})
    endif()
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:hedgehop_warnings>)
  else()
    set(scope INTERFACE)
    add_library(${target} INTERFACE)
  endif()
  string(REPLACE "_" "::" alias ${name})
  add_library(hedgehop::${alias} ALIAS ${target})
  target_sources(${target} ${scope} FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${arg_HDRS})
  set_target_properties(${target} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
  target_compile_features(${target} ${scope} cxx_std_20)
  foreach(dep IN LISTS arg_DEPS)
    string(REPLACE "/" "_" dep ${dep})
    target_link_libraries(${target} ${scope} hedgehop_${dep})
  endforeach()
  target_link_libraries(${target} ${scope} ${arg_PACKAGES})
endfunction()

# hedgehop_loaded_library(<name> USER <target> SRCS ... PACKAGES ...): a shared library that the code of the target loads when
# it is needed, because the packages take long to load.
function(hedgehop_loaded_library name)
  cmake_parse_arguments(arg "" "USER" "SRCS;PACKAGES" ${ARGN})
  add_library(${name} MODULE ${arg_SRCS})
  set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${HEDGEHOP_LOADED_LIBRARIES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_features(${name} PRIVATE cxx_std_20)
  target_link_libraries(${name} PRIVATE ${arg_PACKAGES} hedgehop_warnings)
  set_property(GLOBAL APPEND PROPERTY HEDGEHOP_LOADED ${name})
  add_dependencies(${arg_USER} ${name})
endfunction()

# Installs the libraries and headers that modules and loops outside this tree are built against.
function(hedgehop_offer)
  foreach(folder IN LISTS ARGN)
    string(REPLACE "/" "_" name ${folder})
    set_target_properties(hedgehop_${name} PROPERTIES EXPORT_NAME ${name})
    install(TARGETS hedgehop_${name} EXPORT hedgehop COMPONENT development
            FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hedgehop COMPONENT development)
  endforeach()
endfunction()

function(hedgehop_check_layers folder deps)
  foreach(row IN LISTS HEDGEHOP_LAYERS)
    if(row MATCHES "^${folder}:(.*)$")
      separate_arguments(allowed UNIX_COMMAND "${CMAKE_MATCH_1}")
      foreach(dep IN LISTS deps)
        if(NOT dep IN_LIST allowed)
          message(FATAL_ERROR "${folder} may not depend on ${dep}; it may use: ${allowed} (HEDGEHOP_LAYERS)")
        endif()
      endforeach()
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "${folder} has no row in HEDGEHOP_LAYERS")
endfunction()

# hedgehop_test(<name> SRCS ... DEPS <folders> [LABEL unit|physics|vision|render|loop] [LONG <tests>]): one GoogleTest
# program. Tests that match a pattern of LONG take about one second or more. They get the label `long`, all others LABEL.
function(hedgehop_test name)
  cmake_parse_arguments(arg "" "LABEL" "SRCS;DEPS;PACKAGES;LONG" ${ARGN})
  if(NOT arg_LABEL)
    set(arg_LABEL unit)
  endif()
  add_executable(${name} ${arg_SRCS})
  hedgehop_use_precompiled(${name} hedgehop_test_headers)
  target_compile_options(${name} PRIVATE ${HEDGEHOP_COLD_OPTIONS})
  target_compile_definitions(${name} PRIVATE HEDGEHOP_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE hedgehop_warnings ${arg_PACKAGES} GTest::gmock GTest::gtest GTest::gtest_main)
  foreach(dep IN LISTS arg_DEPS)
    string(REPLACE "/" "_" dep ${dep})
    target_link_libraries(${name} PRIVATE hedgehop_${dep})
  endforeach()
  hedgehop_add_suites(${name} LABEL ${arg_LABEL} LONG ${arg_LONG})
endfunction()

# hedgehop_add_suites(<program> LABEL <label> [PREFIX <prefix>] [LONG <patterns>] [OMITTED <patterns>] [ENVIRONMENT <variable>]):
# after each build of a GoogleTest program, lists its suites as tests of ctest.
function(hedgehop_add_suites program)
  cmake_parse_arguments(arg "" "LABEL;PREFIX;ENVIRONMENT" "LONG;OMITTED" ${ARGN})
  list(JOIN arg_LONG ":" long)
  list(JOIN arg_OMITTED ":" omitted)
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${arg_PREFIX}${program}_suites.cmake)
  if(NOT EXISTS ${include})
    file(WRITE ${include} "add_test([[${program}: not built]] false)\n")
  endif()
  add_custom_command(TARGET ${program} POST_BUILD VERBATIM
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${program}> -D INCLUDE=${include} -D PREFIX=${arg_PREFIX}
            -D LABEL=${arg_LABEL} -D "LONG=${long}" -D "OMITTED=${omitted}" -D "ENVIRONMENT=${arg_ENVIRONMENT}"
            -P ${PROJECT_SOURCE_DIR}/cmake/add_suites.cmake)
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()
