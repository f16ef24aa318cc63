#pragma once

#include <sys/types.h>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

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

/// Several worker processes at a time, one for each job, in the order of the jobs.
struct WorkerPool {
  size_t workers = 1;    ///< processes at a time, >= 1
  double limit_s = 0.0;  ///< longest wall time of one process, then it is killed; 0 for no limit
  /// Whether a job still matters, looked at before it starts and whenever another has ended: one that no longer does is
  /// not started, or is killed and reported as stopped. None: all do.
  std::function<bool(size_t job)> wanted = {};

  /// Runs a process for each job and calls `ended` as each ends. When the interruption comes, all are killed, reported
  /// as stopped, and no other is started. @param command  of a job: absolute path and arguments.
  /// @return false when it was interrupted. Waits in poll(2), never busily.
  bool run(size_t jobs, const std::function<std::vector<std::string>(size_t job)>& command, Interruption& interruption,
           const std::function<void(size_t job, const WorkerEnd&)>& ended) const;
};

}  // namespace hedgehop::sim
