#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace hedgehop::sim::cli {

/// Files that are written at the end of a campaign: one that fails (a full disk) keeps no other from being written,
/// nor results from being printed.
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
  /// Throws std::runtime_error with the first fault, if there was one.
  void raise() const {
    if (!well()) throw std::runtime_error(fault_);
  }

 private:
  std::string fault_;
};

}  // namespace hedgehop::sim::cli
