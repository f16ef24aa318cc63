include_guard()
# Packages that have no usable CMake package. External loops that link Hedgehop use this file, too.

# hedgehop_package(<target> <a header> LIBRARIES ... [PATH <suffix of the header's folder>] [OPTIONAL]): an optional package
# that is not found gets no target.
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
hedgehop_package(hedgehop_assimp assimp/Importer.hpp LIBRARIES assimp OPTIONAL)
# Images in files: OpenCV's imgcodecs would load 76 more libraries.
hedgehop_package(hedgehop_png png.h LIBRARIES png)
hedgehop_package(hedgehop_turbojpeg turbojpeg.h LIBRARIES turbojpeg)
# Checksums and compression of logs.
hedgehop_package(hedgehop_zlib zlib.h LIBRARIES z)
hedgehop_package(hedgehop_zstd zstd.h LIBRARIES zstd)
hedgehop_package(hedgehop_lz4 lz4frame.h LIBRARIES lz4)
hedgehop_package(hedgehop_tiff tiffio.h LIBRARIES tiff OPTIONAL)
hedgehop_package(hedgehop_webp webp/decode.h LIBRARIES webp OPTIONAL)
# libosmium consists of headers, which use expat and zlib.
hedgehop_package(hedgehop_osmium osmium/osm.hpp LIBRARIES expat z OPTIONAL)
hedgehop_package(hedgehop_gdal gdal.h PATH gdal LIBRARIES gdal OPTIONAL)
# Clearances must be accurate to 1 mm at a distance of 1 km from the origin, so Hedgehop uses Bullet's double-precision build.
# In Debian, it has a suffix and is next to the single-precision one; a build of Bullet's own sources has no suffix. All users
# of the header must see the same btScalar.
find_library(HEDGEHOP_BULLET_FLOAT64 BulletCollision-float64)
set(suffix)
if(HEDGEHOP_BULLET_FLOAT64)
  set(suffix -float64)
endif()
hedgehop_package(hedgehop_bullet btBulletCollisionCommon.h PATH bullet
                 LIBRARIES BulletCollision${suffix} LinearMath${suffix})
target_compile_definitions(hedgehop_bullet INTERFACE BT_USE_DOUBLE_PRECISION)
if(NOT HEDGEHOP_BULLET_FLOAT64)
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_LIBRARIES hedgehop_bullet)
  # Links only if the library has the function for btScalar = double.
  check_cxx_source_compiles("#include <btBulletCollisionCommon.h>
    int main() { return btCapsuleShape(1.0, 2.0).getHalfHeight() < 0; }" HEDGEHOP_BULLET_IS_DOUBLE)
  unset(CMAKE_REQUIRED_LIBRARIES)
  if(NOT HEDGEHOP_BULLET_IS_DOUBLE)
    message(FATAL_ERROR "${HEDGEHOP_BULLET_BulletCollision} is single precision. Build Bullet with -DUSE_DOUBLE_PRECISION=ON "
                        "-DBUILD_SHARED_LIBS=ON, install it into DIR and set CMAKE_PREFIX_PATH=DIR")
  endif()
endif()
