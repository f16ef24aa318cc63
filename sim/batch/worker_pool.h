#pragma once

#include <sys/types.h>
#include <chrono>
#include <csignal>
#include <deque>
#include <filesystem>
#include <list>
#include <optional>
#include <string>
#include <vector>

namespace hedgehop::sim {

/// While it exists, SIGINT and SIGTERM do not end the process but make a
/// descriptor readable. One at a time, created before threads.
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
  std::string last_line;  ///< last line that is not empty of its standard error,
                          ///< at most 4 kB of it
  double wall_s = 0.0, cpu_s = 0.0;
};

/// "exit status 3: cannot write x", "killed by SIGSEGV (Segmentation fault)",
/// "killed: over its limit of 10 s".
/// @param limit_s  the limit it ran under, > 0, for the message.
std::string cause_words(const WorkerEnd& end, double limit_s);

/// A child process in a process group of its own, its standard output thrown
/// away, its standard error read.
class Worker {
 public:
  using Clock = std::chrono::steady_clock;

  /// Starts `command` (an absolute path and its arguments) with the given
  /// signal mask. Throws std::system_error when no process can be made.
  Worker(const std::vector<std::string>& command, const sigset_t& mask);
  ~Worker();  ///< kills running processes
  Worker(Worker&& other) noexcept;
  Worker& operator=(Worker&&) = delete;

  int process_descriptor() const { return process_; }  ///< readable when the process has ended
  int error_descriptor() const { return error_; }      ///< readable when there is standard error to take; -1 at its end
  Clock::time_point started() const { return started_; }

  bool killed() const { return killed_.has_value(); }

  /// Reads the available standard error output.
  void take_errors();
  /// Ends the whole process group; `why` is how the end will be reported.
  void kill(WorkerEnd::Kind why);
  /// Waits for the end and returns it. Call it once process_descriptor() is
  /// readable.
  WorkerEnd join();

 private:
  pid_t pid_ = -1;
  int process_ = -1, error_ = -1;
  Clock::time_point started_;
  std::optional<WorkerEnd::Kind> killed_;
  std::string tail_;
};

/// The end of the process of a job.
struct JobEnd {
  size_t job = 0;
  WorkerEnd end;
};

/// Several worker processes at a time, one per job. After an interruption, all
/// are killed and no other starts.
class WorkerPool {
 public:
  /// @param workers  processes at a time, >= 1. @param limit_s  maximum wall
  /// time of one process, then it is killed; 0 for no limit.
  WorkerPool(size_t workers, double limit_s, Interruption& interruption)
      : workers_(workers), limit_s_(limit_s), interruption_(interruption) {}

  /// Whether another process may start.
  bool has_room() const { return running_.size() < workers_ && !interruption_.came(); }
  /// Starts a process. If it cannot be started, next() returns its end. @param
  /// command  absolute path and arguments.
  void start(size_t job, const std::vector<std::string>& command);
  /// Kills the processes of some jobs; next() returns their ends as stopped.
  template <class IsStopped>
  void stop_if(IsStopped is_stopped) {
    for (Running& running : running_) {
      if (is_stopped(running.job)) running.worker.kill(WorkerEnd::Kind::stopped);
    }
  }
  /// Waits for the end of one process, in poll(2); none if no process runs.
  std::optional<JobEnd> next();

 private:
  struct Running {
    size_t job;
    Worker worker;
  };
  void wait() const;
  double left_s(const Worker& worker) const;

  size_t workers_;
  double limit_s_;
  Interruption& interruption_;
  std::list<Running> running_;
  std::deque<JobEnd> ended_;
};

}  // namespace hedgehop::sim
