# Precompiles the package headers that many sources include. Parsing them takes 70 % of a build without precompiled headers.
# Every file still includes the headers of its names: `scripts/style includes` checks it, and `scripts/slow-checks headers`
# compiles each header without these.
include_guard()

set(precompiled
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numbers> <optional> <random>
    <span> <sstream> <stdexcept> <string> <string_view> <utility> <variant> <vector>
    <Eigen/Dense> <fmt/format.h> <nlohmann/json.hpp> <opencv2/core.hpp> <opencv2/imgproc.hpp>)

# One precompiled header per set of flags: library code is position-independent, and GCC takes the optimization level from
# the precompiled header instead of the command line.
function(hedgehop_precompile name)
  file(WRITE ${PROJECT_BINARY_DIR}/generated/${name}.cpp "")
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/generated/${name}.cpp)
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_link_libraries(${name} PRIVATE hedgehop_warnings Eigen3::Eigen opencv_core fmt::fmt nlohmann_json::nlohmann_json)
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

# Definitions that a package requires for its headers must hold for every target that uses the precompiled headers.
function(hedgehop_use_precompiled target headers)
  target_precompile_headers(${target} REUSE_FROM ${headers})
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
endfunction()

hedgehop_precompile(hedgehop_library_headers ${precompiled})
set_target_properties(hedgehop_library_headers PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_compile_options(hedgehop_library_headers PRIVATE ${HEDGEHOP_LIBRARY_OPTIONS})
hedgehop_precompile(hedgehop_cold_headers ${precompiled})
set_target_properties(hedgehop_cold_headers PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_compile_options(hedgehop_cold_headers PRIVATE ${HEDGEHOP_LIBRARY_OPTIONS} ${HEDGEHOP_COLD_OPTIONS})
if(HEDGEHOP_TESTS)
  hedgehop_precompile(hedgehop_test_headers ${precompiled} <gmock/gmock.h> <gtest/gtest.h>)
  target_link_libraries(hedgehop_test_headers PRIVATE GTest::gmock GTest::gtest)
  target_compile_options(hedgehop_test_headers PRIVATE ${HEDGEHOP_COLD_OPTIONS})
endif()
