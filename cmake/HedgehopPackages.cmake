include_guard()
# The other packages without a usable CMake package, for who builds Hedgehop or a loop of one's own upon it.

# hedgehop_package(<target> <a header> LIBRARIES ... [PATH <suffix of the header's folder>] [OPTIONAL]): what is optional and
# not there has no target.
function(hedgehop_package target header)
  cmake_parse_arguments(arg "OPTIONAL" "PATH" "LIBRARIES" ${ARGN})
  string(TOUPPER ${target} upper)
  set(required REQUIRED)
  if(arg_OPTIONAL)
    set(required)
  endif()
  find_path(${upper}_INCLUDE_DIR ${header} PATH_SUFFIXES ${arg_PATH} ${required})
  if(NOT ${upper}_INCLUDE_DIR)
    return()
  endif()
  set(libraries)
  foreach(library IN LISTS arg_LIBRARIES)
    find_library(${upper}_${library} ${library} ${required})
    if(NOT ${upper}_${library})
      return()
    endif()
    list(APPEND libraries ${${upper}_${library}})
  endforeach()
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${${upper}_INCLUDE_DIR})
  target_link_libraries(${target} INTERFACE ${libraries})
endfunction()
hedgehop_package(hedgehop_osmesa GL/osmesa.h LIBRARIES OSMesa)
hedgehop_package(hedgehop_egl EGL/egl.h LIBRARIES EGL OPTIONAL)
hedgehop_package(hedgehop_assimp assimp/Importer.hpp LIBRARIES assimp OPTIONAL)
# Images in files: OpenCV's imgcodecs would bring 76 more libraries.
hedgehop_package(hedgehop_png png.h LIBRARIES png)
hedgehop_package(hedgehop_turbojpeg turbojpeg.h LIBRARIES turbojpeg)
# Clearances are wanted to a millimeter a kilometer from the origin: the double-precision build, which Debian ships beside
# the other. Every user must see the same btScalar.
hedgehop_package(hedgehop_bullet btBulletCollisionCommon.h PATH bullet
                 LIBRARIES BulletCollision-float64 LinearMath-float64)
target_compile_definitions(hedgehop_bullet INTERFACE BT_USE_DOUBLE_PRECISION)
