#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace hedgehop::sim {

/// Returns the message of the exception that an action throws.
inline std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no exception";
}

}  // namespace hedgehop::sim
