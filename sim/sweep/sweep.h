#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/batch/flight_table.h"
#include "sim/batch/fly_orders.h"
#include "sim/sweep/sweep_file.h"

namespace hedgehop::sim {

/// One part of a sweep that is distributed over machines: every `of`-th flight, starting with number `index`.
struct Shard {
  size_t index = 1, of = 1;  ///< 1 <= index <= of
};

/// Reads a shard such as "2/8". Throws InputError for any other text.
Shard parse_shard(const std::string& text);

/// Flights of a sweep.
struct SweepOrders {
  std::vector<Order> orders;
  std::vector<std::vector<std::string>> values;  ///< of the parameters, one list per order
  std::vector<std::string> points;               ///< number of the point, one per order

  void add(Order order, const std::vector<std::string>& point_values, const std::string& point);
  void append(const SweepOrders& more);
};

/// Returns the table of flights with additional columns for the point's number and the parameter values.
/// @param before  further columns to the left of these.
Table sweep_table(const SweepConfig& sweep, const SweepOrders& orders, const std::vector<FlightRecord>& records,
                  const std::vector<Table::Column>& before = {});

/// A sweep as a job array of an existing Slurm cluster, one shard per task.
struct SlurmJob {
  std::filesystem::path program;       ///< hedgehop, absolute path, valid on all nodes
  std::filesystem::path sweep;         ///< the sweep's file as given; used in the re-run commands of tables
  std::filesystem::path out;           ///< results folder, absolute, on a disk shared by all nodes
  std::filesystem::path folder;        ///< working folder, so that relative paths stay valid; absolute
  std::filesystem::path worker;        ///< program of the workers if not hedgehop itself; absolute or empty
  std::filesystem::path junit;         ///< written by the merge step; absolute or empty
  size_t tasks = 1;                    ///< shards, 1..1000 (Slurm's own limit of an array's index)
  size_t cores = 1;                    ///< per task, equal to its number of workers
  double limit_s = 0.0;                ///< of a flight; 0 for no limit
  bool other_builds = false;           ///< whether results of other builds are reused
  std::vector<std::string> overrides;  ///< "a.b=value", of every point
  std::vector<std::string> options;    ///< for every sbatch, such as --partition=night
};

/// Returns the batch script of the array. It flies a shard and re-queues the task once if flights have no result.
std::string array_script(const SlurmJob& job);
/// Returns the batch script of the merge step, which collects the results of all shards.
std::string merge_script(const SlurmJob& job);

/// Writes both scripts into the results' folder and submits them. @return the array's job number.
/// Throws std::runtime_error with sbatch's message if it fails or does not exist.
std::string submit(const SlurmJob& job);

/// Writes the table as table `flights` of an SQLite 3 file. The file is written under another name and then renamed, so
/// an existing file is always complete. Throws std::runtime_error that names the file and the cause.
void write_sqlite(const std::filesystem::path& file, const Table& table);

}  // namespace hedgehop::sim
