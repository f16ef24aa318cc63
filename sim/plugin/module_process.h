#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "avoidance/module.h"
#include "sim/plugin/module_fault.h"

namespace hedgehop::sim {

/// Makes a module. Called in the process of the module.
using ModuleSource = std::function<std::unique_ptr<avoidance::Module>()>;

struct ModuleProcessOptions {
  std::string name;              ///< of the module, for messages
  double limit_s = 10.0;         ///< maximum wall time of a call; it only decides when a hung module is given up
  double load_limit_s = 60.0;    ///< of making and of resetting the module
  std::filesystem::path folder;  ///< its working folder, with module.log; empty: a temporary one
};

/// Returns a module that `source` makes in a process of its own. Images pass through shared memory, each call is one
/// message. Whatever the module does there, a call returns or throws: a crash, an exit or a timeout becomes a
/// ModuleFault with the cause, and the process is killed with all its children. All later calls throw the same. A fault
/// in reset() is thrown by the calls after it, so that the flight has a verdict. annotate() runs in a copy of the
/// process: whatever it does there cannot change the flight. Throws InputError if `source` throws InputError,
/// std::invalid_argument with the text of a std::logic_error that the module throws while it is made, and ModuleFault
/// for any other failure.
std::unique_ptr<avoidance::Module> make_module_process(const ModuleSource& source, const ModuleProcessOptions& options);

}  // namespace hedgehop::sim
