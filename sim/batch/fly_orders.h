#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/batch/record.h"
#include "sim/batch/worker_pool.h"

namespace hedgehop::sim {

/// How the flights of a campaign are flown.
struct FlyOptions {
  std::filesystem::path program;  ///< of the workers: the hedgehop that runs now, absolute
  std::filesystem::path out;      ///< each flight's folder is <out>/<order.id>
  bool other_builds = false;      ///< results of other builds are reused, too
  size_t workers = 1;             ///< >= 1
  double limit_s = 0.0;           ///< maximum wall time of a flight, 0 for none
  bool reports = false;           ///< flights leave films and reports
  std::vector<std::string> keep;  ///< artifacts of failed flights: see kept_artifacts()
};

/// Returns the artifacts of a text such as "failed=report,film,replay,csv"; none if the text is invalid.
std::optional<std::vector<std::string>> kept_artifacts(const std::string& text);

/// Which earlier results are reused, so that their orders are not flown again.
enum class Reuse {
  none,
  passed,  ///< those of Verdict::passed
  all
};

/// The end of one flight.
struct EndedFlight {
  const FlightRecord& record;
  bool reused = false;  ///< an earlier result was reused
};

/// Flies orders in worker processes. A worker that crashes, exceeds the limit
/// or is killed fails its own flight only. Orders with a fault are not flown.
class OrderFlights {
 public:
  OrderFlights(const std::vector<Order>& orders, FlyOptions options, Reuse reuse, Interruption& interruption);

  /// Waits for the next flight to end: orders with a fault and reused results
  /// first, in their order, then flights as they end. None if all orders have
  /// ended, were dropped or were interrupted.
  std::optional<EndedFlight> next();

  /// Drops an order that has not ended: it is neither reused nor flown, and its
  /// process is killed. Its record stays missing.
  void drop(const Order& order);

  /// Returns one record per order, in their order; missing if it was dropped or
  /// interrupted.
  std::vector<FlightRecord> take_records() { return std::move(records_); }

 private:
  std::optional<EndedFlight> next_unflown();
  void start(size_t index);
  /// Returns the smallest number that no running worker has, for resources that only one process may use.
  size_t free_worker() const;
  void conclude(FlightRecord& record, const WorkerEnd& end) const;

  FlyOptions options_;
  Reuse reuse_;
  std::vector<FlightRecord> records_;
  std::set<std::string> dropped_;       ///< ids
  size_t examined_ = 0;                 ///< orders that next_unflown() has seen
  std::vector<size_t> to_fly_;          ///< indices of records
  size_t started_ = 0;                  ///< of to_fly_
  std::map<size_t, size_t> worker_of_;  ///< number of the worker of each running order
  WorkerPool pool_;
};

/// Returns the records of earlier flights, none flown. @param folders  of
/// campaigns, searched in this order.
/// @param other_builds  results of other builds count, too.
std::vector<FlightRecord> gather(const std::vector<Order>& orders, const std::vector<std::filesystem::path>& folders,
                                 bool other_builds);

}  // namespace hedgehop::sim
