#pragma once

#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hedgehop::sim {

/// How a worker process ended.
struct WorkerEnd {
  enum class Kind {
    exited,     ///< by itself; code is its exit status
    signalled,  ///< by a signal, its number in code
    overdue,    ///< killed here: its time was over
    stopped,    ///< killed here: the campaign was interrupted
    unstarted   ///< no process could be made; the cause is in last_line
  };
  Kind kind = Kind::exited;
  int code = 0;
  std::string last_line;  ///< last line that is not empty of its standard error, at most 4 kB of it
  double wall_s = 0.0, cpu_s = 0.0;
};

/// "exit status 3: cannot write x", "killed by SIGSEGV (Segmentation fault)", "killed: over its limit of 10 s".
/// @param limit_s  the limit it ran under, > 0, for the message.
std::string cause_words(const WorkerEnd& end, double limit_s);

/// A child process in a process group of its own, its standard output thrown away, its standard error read.
class Worker {
 public:
  using Clock = std::chrono::steady_clock;

  /// Starts `command` (an absolute path and its arguments) with the given signal mask.
  /// Throws std::system_error when no process can be made.
  Worker(const std::vector<std::string>& command, const sigset_t& mask);
  ~Worker();  ///< kills what still runs
  Worker(Worker&& other) noexcept;
  Worker& operator=(Worker&&) = delete;

  int process_descriptor() const { return process_; }  ///< readable when the process has ended
  int error_descriptor() const { return error_; }      ///< readable when there is standard error to take; -1 at its end
  Clock::time_point started() const { return started_; }

  bool killed() const { return killed_.has_value(); }

  /// Reads what standard error holds now.
  void take_errors();
  /// Ends the whole process group; `why` is how the end will be reported.
  void kill(WorkerEnd::Kind why);
  /// Waits for the end and returns it. Call it once process_descriptor() is readable.
  WorkerEnd join();

 private:
  pid_t pid_ = -1;
  int process_ = -1, error_ = -1;
  Clock::time_point started_;
  std::optional<WorkerEnd::Kind> killed_;
  std::string tail_;
};

}  // namespace hedgehop::sim
