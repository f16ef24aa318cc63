#pragma once

#include <functional>
#include <memory>
#include <string>

#include "avoidance/module.h"
#include "sim/scenario/foreign_config.h"

namespace hedgehop::sim {

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
