# Packages, all from Debian (scripts/packages lists them). Their headers are system headers: no warnings from them.
include_guard()
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(yaml-cpp 0.7 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)

include(HedgehopOpenCV)
include(HedgehopPackages)

if(HEDGEHOP_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
if(HEDGEHOP_BENCH)
  find_package(benchmark REQUIRED)
endif()
