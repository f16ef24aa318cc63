#pragma once

#include <functional>
#include <stdexcept>

namespace hedgehop::sim {

/// A call crashed or hung.
struct CallBroken : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Calls foreign code: a crash (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) or a timeout becomes CallBroken. The state of
/// that code is then undefined: it must not be called again, and the process should write its results and end. One
/// guarded call at a time per thread.
/// @param limit_s  wall time, > 0; it affects only the abort of the call.
void call_guarded(double limit_s, const std::function<void()>& call);

}  // namespace hedgehop::sim
