#pragma once

#include <functional>
#include <memory>
#include <string>

#include "avoidance/module.h"
#include "sim/scenario/avoidance_config.h"

namespace hedgehop::sim {

/// Returns the avoidance module; a foreign module is loaded from its library. Every call of a foreign module is guarded
/// (call_guard.h): after a crash or a timeout it is never called again.
/// Throws std::invalid_argument on an invalid config of a module of this tree, and InputError with the library if it is
/// missing or invalid, was built against another interface, lacks the module, or refuses its parameters.
std::unique_ptr<avoidance::Module> make_module(const AvoidanceConfig& config);

/// The module that an interpreter must make.
struct PythonRequest {
  std::string file, class_name;
  std::string parameters;  ///< keyword arguments of the class: a JSON object
};
/// Throws std::exception with one line if the class does not exist or raises an exception.
using PythonMaker = std::function<std::unique_ptr<avoidance::Module>(const PythonRequest&)>;

/// Sets the running interpreter that makes modules in Python. Without it, the first such module loads an interpreter.
void set_python_maker(PythonMaker maker);

/// Throws InputError if this build has no Python, or if the file or its class is invalid.
std::unique_ptr<avoidance::Module> make_python_module(const PythonConfig& config);

}  // namespace hedgehop::sim
