# Python for the package `hedgehop` (sim/python) and its tests. The default is the system's Python, because the system's numpy
# and pybind11 belong to it. -DPython3_EXECUTABLE=FILE selects another one, for which everything must be found.
include_guard()
set(selected ${Python3_EXECUTABLE})
if(NOT selected AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python3 3.9 QUIET COMPONENTS Interpreter Development.Module OPTIONAL_COMPONENTS Development.Embed)

# The first version of pybind11 that supports this Python, according to pybind11's docs/changelog.md.
set(oldest_pybind11 2.10)
if(Python3_VERSION VERSION_GREATER_EQUAL 3.14)
  set(oldest_pybind11 3.0)
elseif(Python3_VERSION VERSION_GREATER_EQUAL 3.13)
  set(oldest_pybind11 2.13)
elseif(Python3_VERSION VERSION_GREATER_EQUAL 3.12)
  set(oldest_pybind11 2.11)
endif()
# A pybind11 that pip installed for this Python is preferred to the system's.
execute_process(COMMAND ${Python3_EXECUTABLE} -m pybind11 --cmakedir OUTPUT_VARIABLE of_this_python ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE)
find_package(pybind11 ${oldest_pybind11} QUIET CONFIG HINTS ${of_this_python})

set(HEDGEHOP_PYTHON OFF)
set(HEDGEHOP_PYTHON_VERSION 3)
if(Python3_FOUND AND pybind11_FOUND)
  set(HEDGEHOP_PYTHON ON)
  set(HEDGEHOP_PYTHON_TARGETS hedgehop_native)
  set(HEDGEHOP_PYTHON_VERSION ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR})
elseif(selected AND NOT Python3_FOUND)
  message(FATAL_ERROR "${selected} is no Python 3.9 or later with its headers (Debian's package: python3-dev)")
elseif(selected)
  message(FATAL_ERROR "Python ${Python3_VERSION} (${selected}) needs pybind11 ${oldest_pybind11} or later, found: "
                      "${pybind11_CONSIDERED_VERSIONS}; install it: ${selected} -m pip install pybind11")
endif()
# The program runs modules in the interpreter's shared library, which not every Python has.
set(HEDGEHOP_EMBEDDED_PYTHON OFF)
if(HEDGEHOP_PYTHON AND Python3_Development.Embed_FOUND AND Python3_LIBRARIES MATCHES "\\.so")
  set(HEDGEHOP_EMBEDDED_PYTHON ON)
  list(APPEND HEDGEHOP_PYTHON_TARGETS hedgehop_python)
endif()
hedgehop_feature(${HEDGEHOP_PYTHON} "Python package, for Python ${HEDGEHOP_PYTHON_VERSION}"
                 "python3-dev and pybind11-dev (${oldest_pybind11} or later)")
hedgehop_feature(${HEDGEHOP_EMBEDDED_PYTHON}
                 "Python modules, in Python ${HEDGEHOP_PYTHON_VERSION} (needs python3-hedgehop at run time)"
                 "python3-dev and pybind11-dev, for a Python with a shared library (--enable-shared)")
