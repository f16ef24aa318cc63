#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hedgehop::sim {

/// A sweep as a job array of an existing Slurm, one shard a task.
struct SlurmJob {
  std::filesystem::path program;     ///< hedgehop, absolute, as all nodes see it
  std::filesystem::path sweep;       ///< the sweep's file as it was named: the tables' re-run commands use that name
  std::filesystem::path out;         ///< the results, absolute, on a disk that all nodes share
  std::filesystem::path folder;      ///< to run in, so that relative paths stay valid; absolute
  std::filesystem::path worker;      ///< program of the workers when not hedgehop itself; absolute or empty
  std::filesystem::path junit;       ///< written by the step that gathers the results; absolute or empty
  size_t tasks = 1;                  ///< shards, 1..1000 (Slurm's own limit of an array's index)
  size_t cores = 1;                  ///< of a task, and workers
  double limit_s = 0.0;              ///< of a flight, 0 for none
  std::vector<std::string> options;  ///< for every sbatch, such as --partition=night
};

/// The batch script of the array: flies a shard; flights that left no result have the task re-queued once.
std::string array_script(const SlurmJob& job);
/// The batch script of the step after it, which gathers the results of all shards.
std::string merge_script(const SlurmJob& job);

/// Writes both scripts into the results' folder and submits them. @return the array's job number.
/// Throws std::runtime_error with sbatch's message when it refuses or does not exist.
std::string submit(const SlurmJob& job);

}  // namespace hedgehop::sim
