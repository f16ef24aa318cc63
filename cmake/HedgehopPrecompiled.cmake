# The packages' headers that most sources read, parsed once: seven tenths of a build without it is reading them. Every
# source still includes what it uses; all_verify_interface_header_sets compiles each header without this.
include_guard()

set(precompiled
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numbers> <optional> <random>
    <span> <sstream> <stdexcept> <string> <string_view> <utility> <variant> <vector>
    <Eigen/Dense> <fmt/format.h> <nlohmann/json.hpp> <opencv2/core.hpp> <opencv2/imgproc.hpp>)

# One set of flags each: code of libraries is position independent, since modules from elsewhere are linked against it.
# GCC takes the level of optimization from what was precompiled, whatever the command says: cold code needs its own.
function(hedgehop_precompile name)
  file(WRITE ${PROJECT_BINARY_DIR}/generated/${name}.cpp "")
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/generated/${name}.cpp)
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_link_libraries(${name} PRIVATE hedgehop_warnings Eigen3::Eigen opencv_core fmt::fmt nlohmann_json::nlohmann_json)
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

# What a package defines for its own headers must hold for all who read the precompiled ones.
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
  set_target_properties(hedgehop_test_headers PROPERTIES UNITY_BUILD OFF)  # as of the tests
endif()
