#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/batch/interruption.h"
#include "sim/batch/worker.h"

namespace hedgehop::sim {

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
