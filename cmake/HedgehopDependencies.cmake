# Packages, all from Debian (scripts/packages lists them). Their headers are system headers: no warnings from them.
include_guard()
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(yaml-cpp 0.7 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)

include(HedgehopOpenCV)

find_library(OSMESA_LIBRARY OSMesa REQUIRED)
find_path(OSMESA_INCLUDE_DIR GL/osmesa.h REQUIRED)

add_library(hedgehop_osmesa INTERFACE)
target_link_libraries(hedgehop_osmesa INTERFACE ${OSMESA_LIBRARY})
target_include_directories(hedgehop_osmesa SYSTEM INTERFACE ${OSMESA_INCLUDE_DIR})

find_library(EGL_LIBRARY EGL REQUIRED)
find_path(EGL_INCLUDE_DIR EGL/egl.h REQUIRED)
add_library(hedgehop_egl INTERFACE)
target_link_libraries(hedgehop_egl INTERFACE ${EGL_LIBRARY})
target_include_directories(hedgehop_egl SYSTEM INTERFACE ${EGL_INCLUDE_DIR})

find_library(ASSIMP_LIBRARY assimp REQUIRED)
find_path(ASSIMP_INCLUDE_DIR assimp/Importer.hpp REQUIRED)
add_library(hedgehop_assimp INTERFACE)
target_link_libraries(hedgehop_assimp INTERFACE ${ASSIMP_LIBRARY})
target_include_directories(hedgehop_assimp SYSTEM INTERFACE ${ASSIMP_INCLUDE_DIR})

add_library(hedgehop_bullet INTERFACE)
# Clearances are wanted to a millimeter a kilometer from the origin: the double-precision build, which Debian ships beside
# the other. Every user must see the same btScalar.
find_library(BULLET_COLLISION_LIBRARY BulletCollision-float64 REQUIRED)
find_library(BULLET_LINEAR_MATH_LIBRARY LinearMath-float64 REQUIRED)
find_path(BULLET_INCLUDE_DIR btBulletCollisionCommon.h PATH_SUFFIXES bullet REQUIRED)
target_link_libraries(hedgehop_bullet INTERFACE ${BULLET_COLLISION_LIBRARY} ${BULLET_LINEAR_MATH_LIBRARY})
target_include_directories(hedgehop_bullet SYSTEM INTERFACE ${BULLET_INCLUDE_DIR})
target_compile_definitions(hedgehop_bullet INTERFACE BT_USE_DOUBLE_PRECISION)

if(HEDGEHOP_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
if(HEDGEHOP_BENCH)
  find_package(benchmark REQUIRED)
endif()
