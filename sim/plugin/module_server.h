#pragma once

#include <string>

#include "sim/plugin/channel.h"
#include "sim/plugin/module_process.h"

namespace hedgehop::sim {

/// The calls of a module, in its requests.
enum class ModuleCall { load, reset, update, metrics, map, annotate, end };

/// An image of a request: in the shared memory, or in the message if it does not fit.
struct SharedImage {
  int rows = 0, cols = 0, type = 0;
  size_t offset = 0;
  bool is_inside = false;  ///< of the message
};

/// How a call ended, at the head of its answer.
enum class ModuleAnswer {
  done,
  input_error,
  refused,  ///< the module threw a std::logic_error, such as std::invalid_argument
  failed,   ///< the module threw another std::exception
  fault     ///< any other failure of the module
};

/// Answers the requests of the channel until it ends, then ends the process. @param memory  file of the images.
[[noreturn]] void serve_module(const ModuleSource& source, Channel& channel, int memory);

}  // namespace hedgehop::sim
