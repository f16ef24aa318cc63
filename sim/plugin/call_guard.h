#pragma once

#include <functional>
#include <stdexcept>

namespace hedgehop::sim {

/// A call crashed or hung.
struct CallBroken : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Calls code that is not ours: a crash (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) or no answer in time becomes
/// CallBroken. What the call held is then lost and its memory in doubt: nothing of it may be called again, and the
/// process should write what it has and end. One guarded call at a time in a thread.
/// @param limit_s  wall time, > 0; it decides nothing but that the call is given up.
void call_guarded(double limit_s, const std::function<void()>& call);

}  // namespace hedgehop::sim
