#include <pybind11/pybind11.h>

#include <csignal>

#include "sim/config/input_error.h"
#include "sim/flight/build.h"
#include "sim/python/bindings.h"

PYBIND11_MODULE(_native, native) {
  namespace py = pybind11;
  native.doc() = "The C++ side of hedgehop; use the package's own names.";
  py::register_exception<hedgehop::sim::InputError>(native, "InputError", PyExc_ValueError).doc() =
      "Input that its author can fix: every fault, a line each, as `hedgehop run` prints them.";
  native.attr("version") = std::string(hedgehop::sim::version());
  native.attr("build") = std::string(hedgehop::sim::build_identity());
  hedgehop::python::bind_states(native);
  hedgehop::python::bind_modules(native);
  hedgehop::python::bind_simulation(native);
}
