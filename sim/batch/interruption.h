#pragma once

#include <csignal>

namespace hedgehop::sim {

/// While it exists, SIGINT and SIGTERM do not end the process but make a descriptor readable. One at a time, created
/// before threads.
class Interruption {
 public:
  /// Throws std::runtime_error when the descriptor cannot be created.
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Readable once a signal has come.
  int descriptor() const { return descriptor_; }
  /// Reads the pending signals; true from the first signal on.
  bool came();
  /// The first signal, 0 before it.
  int signal() const { return signal_; }
  /// The process's mask from before, for its children.
  const sigset_t& mask_before() const { return before_; }

 private:
  sigset_t before_{};
  int descriptor_ = -1;
  int signal_ = 0;
};

}  // namespace hedgehop::sim
