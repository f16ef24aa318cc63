#pragma once

#include <stdexcept>

namespace hedgehop::sim {

/// A failure of a module other than a std::exception that it throws: a crash, an exit, a timeout, a thrown number.
struct ModuleFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace hedgehop::sim
