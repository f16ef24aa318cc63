#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace hedgehop::sim::cli {

/// Writes the files at the end of a campaign. If one write fails (a full disk), the others are still written and the
/// results are still printed.
class EveryWrite {
 public:
  template <class Write>
  void attempt(Write write) {
    try {
      write();
    } catch (const std::exception& error) {
      if (fault_.empty()) fault_ = error.what();
    }
  }
  bool well() const { return fault_.empty(); }
  /// Throws std::runtime_error with the first error, if there was one.
  void raise() const {
    if (!well()) throw std::runtime_error(fault_);
  }

 private:
  std::string fault_;
};

}  // namespace hedgehop::sim::cli
