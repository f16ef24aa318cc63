# Python for the package `hedgehop` (sim/python) and its tests. Debian's Python is preferred because Debian's numpy and
# pybind11 belong to it.
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
hedgehop_feature(${HEDGEHOP_PYTHON} "Python modules and the Python package (needs python3-hedgehop at run time)"
                 "python3-dev, pybind11-dev and python3-numpy")
