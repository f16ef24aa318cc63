include_guard()
# SLEEF, whose functions sim/libm calls: needed by whatever is linked against a library of Hedgehop.
find_path(SLEEF_INCLUDE_DIR sleef.h REQUIRED)
find_library(SLEEF_LIBRARY sleef REQUIRED)
add_library(hedgehop_sleef INTERFACE IMPORTED GLOBAL)
target_link_libraries(hedgehop_sleef INTERFACE ${SLEEF_LIBRARY})
target_include_directories(hedgehop_sleef SYSTEM INTERFACE ${SLEEF_INCLUDE_DIR})
