#include "sim/plugin/call_guard.h"

#include <fmt/format.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csetjmp>
#include <csignal>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

namespace hedgehop::sim {
namespace {

constexpr std::array kCrashes = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr int kTimeOver = SIGALRM;

// Signal handlers can access globals only. A crash and a timeout are delivered to the thread of the call.
thread_local sigjmp_buf return_point;
thread_local volatile sig_atomic_t is_inside = 0;

void leave(int signal) {
  if (is_inside == 0 && signal == kTimeOver) return;  // the call ended at the timeout
  if (is_inside == 0) {                               // a crash outside a guarded call ends the process
    ::signal(signal, SIG_DFL);
    ::raise(signal);
    return;
  }
  is_inside = 0;
  siglongjmp(return_point, signal);
}

/// The cause may be a stack overflow.
void use_other_stack() {
  thread_local std::vector<char> stack(64 * 1024);
  stack_t other{};
  other.ss_sp = stack.data();
  other.ss_size = stack.size();
  ::sigaltstack(&other, nullptr);
}

timer_t make_timer() {
  sigevent event{};
  event.sigev_notify = SIGEV_THREAD_ID;
  event.sigev_signo = kTimeOver;
  event._sigev_un._tid = static_cast<pid_t>(::syscall(SYS_gettid));
  timer_t timer{};
  if (::timer_create(CLOCK_MONOTONIC, &event, &timer) != 0)
    throw std::runtime_error("cannot create the timer of a plugin call");
  return timer;
}

/// A thread's own.
class Timer {
 public:
  Timer() : timer_(make_timer()) {}
  ~Timer() { ::timer_delete(timer_); }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;
  void set(double seconds) const {
    itimerspec time{};
    const double whole = std::floor(seconds);
    time.it_value.tv_sec = static_cast<time_t>(whole);
    time.it_value.tv_nsec = static_cast<long>((seconds - whole) * 1e9);
    ::timer_settime(timer_, 0, &time, nullptr);
  }

 private:
  timer_t timer_;
};

void catch_signals() {
  use_other_stack();
  struct sigaction action {};
  action.sa_handler = leave;
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  for (const int signal : kCrashes) ::sigaction(signal, &action, nullptr);
  ::sigaction(kTimeOver, &action, nullptr);
}

std::string words(int signal, double limit_s) {
  if (signal == kTimeOver) return fmt::format("did not return within {:g} s", limit_s);
  return fmt::format("crashed ({})", ::strsignal(signal));
}

}  // namespace

void call_guarded(double limit_s, const std::function<void()>& call) {
  thread_local const Timer timer = [] {
    catch_signals();
    return Timer();
  }();
  const int signal = sigsetjmp(return_point, 0);
  if (signal != 0) {
    timer.set(0.0);
    throw CallBroken(words(signal, limit_s));
  }
  is_inside = 1;
  timer.set(limit_s);
  try {
    call();
  } catch (...) {
    is_inside = 0;
    timer.set(0.0);
    throw;
  }
  is_inside = 0;
  timer.set(0.0);
}

}  // namespace hedgehop::sim
