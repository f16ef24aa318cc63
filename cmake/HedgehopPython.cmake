# Python, for the package `hedgehop` (sim/python) and its tests: Debian's own where there is one, for its packages of numpy
# and pybind11 belong to that.
include_guard()
if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python3 3.9 QUIET COMPONENTS Interpreter Development.Module Development.Embed NumPy)
find_package(pybind11 2.10 QUIET CONFIG)
if(Python3_FOUND AND pybind11_FOUND)
  set(HEDGEHOP_PYTHON ON)
else()
  set(HEDGEHOP_PYTHON OFF)
endif()
hedgehop_feature(${HEDGEHOP_PYTHON} "modules in Python, and flights from it (where python3-hedgehop is installed)"
                 "python3-dev, pybind11-dev and python3-numpy")
