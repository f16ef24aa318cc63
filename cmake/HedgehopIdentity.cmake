# The identity of the build, stored in every result: a hash of the sources that determine flights and figures, of the compiler and
# of its flags. It is made at build time and is equal for equal sources inside and outside a git checkout.
include_guard()

set(identity ${PROJECT_BINARY_DIR}/generated/sim/flight/build_identity.h)
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
add_custom_target(hedgehop_identity
  COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -D HEADER=${identity} -D VERSION=${PROJECT_VERSION}
          "-D COMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
          "-D FLAGS=${CMAKE_BUILD_TYPE} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}"
          -P ${CMAKE_CURRENT_LIST_DIR}/write_identity.cmake
  BYPRODUCTS ${identity}
  VERBATIM)
