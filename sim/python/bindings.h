#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "avoidance/module.h"

/// The C++ side of the Python package `hedgehop`: states, commands, modules and the simulation, with the unit of every
/// figure in its name.
namespace hedgehop::python {

/// What a module gets, as Python sees it.
struct Observation {
  int64_t t_ns = 0;
  pybind11::dict images;  ///< role: array; a view that is good until the simulation moves on
  avoidance::NavigationState navigation;
  avoidance::Goal goal;
};
Observation to_python(const avoidance::Observation& observation);

/// A command, or the Decision that holds one. Throws std::invalid_argument for anything else.
avoidance::Decision to_decision(const pybind11::handle& answer);

/// A module whose class is Python's. @param instance  has `update`; `needs`, `reset`, `signals`, `metrics`, `annotate`
/// where it wants them. Every call takes the interpreter's lock; what Python raises comes out as std::runtime_error of
/// one line, with the places.
std::unique_ptr<avoidance::Module> adopt(pybind11::object instance);

void bind_states(pybind11::module_& native);
void bind_modules(pybind11::module_& native);
void bind_simulation(pybind11::module_& native);

}  // namespace hedgehop::python
