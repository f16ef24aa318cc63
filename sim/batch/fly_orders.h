#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/batch/record.h"
#include "sim/batch/worker_pool.h"

namespace hedgehop::sim {

/// How a campaign's flights are flown.
struct FlyOptions {
  std::filesystem::path program;  ///< of the workers: the hedgehop that runs now, absolute
  std::filesystem::path out;      ///< each flight's folder is <out>/<order.id>
  bool other_builds = false;      ///< results of other builds stand, too
  size_t workers = 1;             ///< >= 1
  double limit_s = 0.0;           ///< longest wall time of a flight, 0 for none
  bool reports = false;           ///< flights leave films and reports
  /// Whether an order's flight still matters; looked at before it starts and whenever another has ended. One that no
  /// longer does is neither reused nor flown, and killed where it flies. None: all do.
  std::function<bool(const Order& order)> wanted = {};
};

/// Called when a flight ends, or at once for one that is not flown. @param reused  its former result is reused.
using OnRecord = std::function<void(const FlightRecord& record, bool reused)>;

/// Which former results are reused, so that their orders are not flown again.
enum class Reuse {
  none,
  passed,  ///< those whose checks all hold
  all
};

/// Flies orders in worker processes. A worker that crashes, hangs past the limit or is killed fails its own flight
/// only. Orders with a fault are not flown.
/// @return one record for each order, in their order; missing where the interruption came first.
std::vector<FlightRecord> fly_orders(const std::vector<Order>& orders, const FlyOptions& options, Reuse reuse,
                                     Interruption& interruption, const OnRecord& on_record);

/// The records that former flights left, none flown. @param folders  campaigns' folders, searched in this order.
/// @param other_builds  whether results of other builds stand, too.
std::vector<FlightRecord> gather(const std::vector<Order>& orders, const std::vector<std::filesystem::path>& folders,
                                 bool other_builds);

}  // namespace hedgehop::sim
