#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/batch/flight_table.h"
#include "sim/batch/fly_orders.h"
#include "sim/sweep/sweep_file.h"

namespace hedgehop::sim {

/// One part of a sweep, for several machines: every `of`-th flight, beginning with number `index`.
struct Shard {
  size_t index = 1, of = 1;  ///< 1 <= index <= of
};

/// "2/8". Throws InputError for anything else.
Shard parse_shard(const std::string& text);

/// A sweep's flights, all of them.
struct SweepOrders {
  std::vector<Order> orders;
  std::vector<std::vector<std::string>> values;  ///< of the parameters, one list an order
  std::vector<size_t> points;                    ///< number of the point, one an order

  void add(const SweepConfig& sweep, size_t point, const std::vector<std::string>& point_values);
  void append(const SweepOrders& more);
};

/// Throws InputError with the faults of every point that the scenario refuses. Not for OptimizeDesign.
SweepOrders sweep_orders(const SweepConfig& sweep);

/// The orders of a shard.
SweepOrders part_of(const SweepOrders& all, Shard shard);

/// The flights' table with the point's number and the parameters' values as columns of their own.
/// @param before  further columns that stand before them.
Table sweep_table(const SweepConfig& sweep, const SweepOrders& orders, const std::vector<FlightRecord>& records,
                  const std::vector<ExtraColumn>& before = {});

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

/// Writes the table as table `flights` of an SQLite 3 file, aside and then renamed, so that a file that is there is
/// whole. Throws std::runtime_error naming the file and the cause.
void write_sqlite(const std::filesystem::path& file, const Table& table);

}  // namespace hedgehop::sim
