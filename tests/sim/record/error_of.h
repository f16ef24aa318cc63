#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace hedgehop::sim {

/// What an action that fails says.
inline std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace hedgehop::sim
