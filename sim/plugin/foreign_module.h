#pragma once

#include <functional>
#include <memory>
#include <string>

#include "avoidance/module.h"
#include "sim/scenario/avoidance_config.h"

namespace hedgehop::sim {

/// Makes the module that decides where to fly, loading its library when it comes from outside. Such a module's every
/// call is guarded (call_guard.h): one that crashed or hung is never called again, and says so.
/// Throws std::invalid_argument on a bad config of a module of this tree, and InputError naming the library when it is
/// missing or none, was built against another interface, lacks the module, or refuses its parameters.
std::unique_ptr<avoidance::Module> make_module(const AvoidanceConfig& config);

/// Which module an interpreter is to make.
struct PythonRequest {
  std::string file, class_name;
  std::string parameters;  ///< keyword arguments of the class: a JSON object
};
/// Throws std::exception with one line when there is no such class, or it raises.
using PythonMaker = std::function<std::unique_ptr<avoidance::Module>(const PythonRequest&)>;

/// Says who makes modules in Python: an interpreter that runs already. Otherwise the first such module loads one.
void set_python_maker(PythonMaker maker);

/// Throws InputError when this build has no Python, or the file or its class cannot be used.
std::unique_ptr<avoidance::Module> make_python_module(const PythonConfig& config);

}  // namespace hedgehop::sim
