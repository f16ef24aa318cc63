#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "avoidance/module.h"
#include "sim/scenario/avoidance_config.h"

namespace hedgehop::sim {

/// Returns the avoidance module. A foreign module is loaded in a process of its own (module_process.h), unless its
/// config says `in_process`. @param folder  working folder of that process; empty: a temporary one. Throws
/// std::invalid_argument on an invalid config of a module of this tree, and InputError with the library if it is
/// missing or invalid, was built against another interface, lacks the module, or refuses its parameters. Throws
/// ModuleFault if the module fails in another way while it is made.
std::unique_ptr<avoidance::Module> make_module(const AvoidanceConfig& config, const std::filesystem::path& folder = {});

/// The module that an interpreter must make.
struct PythonRequest {
  std::string file, class_name;
  std::string parameters;  ///< keyword arguments of the class: a JSON object
};
/// Throws std::invalid_argument with one line if the class does not exist or refuses its parameters, and another
/// std::exception with one line if it raises another exception.
using PythonMaker = std::function<std::unique_ptr<avoidance::Module>(const PythonRequest&)>;

/// Sets the running interpreter that makes modules in Python, in this process. Without it, each such module loads an
/// interpreter in its process.
void set_python_maker(PythonMaker maker);

/// Throws InputError if this build has no Python, or if the file or its class is invalid, and ModuleFault as
/// make_module().
std::unique_ptr<avoidance::Module> make_python_module(const PythonConfig& config, const std::filesystem::path& folder);

}  // namespace hedgehop::sim
