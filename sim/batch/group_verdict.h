#pragma once

#include <string>
#include <vector>

#include "sim/batch/campaign_file.h"
#include "sim/batch/record.h"
#include "sim/batch/statistics.h"

namespace hedgehop::sim {

/// The flights of a campaign that differ by the seed alone.
struct GroupSummary {
  std::string group;
  int64_t flights = 0, reached = 0, collided = 0, timeout = 0, fault = 0, failed = 0, missing = 0;
  int64_t completed = 0;  ///< of the timeouts: without a goal, which is a normal end
  int64_t unchecked = 0;  ///< flown without any check: neither a success nor a trial
  Count success;          ///< flights whose checks all hold, of those that ended; a refused order is no trial
  double min_clearance_m = 0.0, median_clearance_m = 0.0;  ///< to obstacles; NaN without a flight
  double median_time_s = 0.0;                              ///< of flight; NaN without a flight
};

/// One row a group, in the order of their first flights.
std::vector<GroupSummary> summarize(const std::vector<FlightRecord>& records);

/// A statistical check's result for one group.
struct GroupVerdict {
  std::string group, check;
  bool passed = false;
  double value = 0.0, limit = 0.0;
  std::string words;  ///< the whole sentence, with counts and interval
};

/// Returns the minimum number of flights that show a rate if all of them pass: the lower bound of the Wilson interval
/// is n / (n + z^2) then. @param rate  in [0, 1). @param confidence  in (0, 1).
int64_t flights_to_show(double rate, double confidence);

/// Refuses a rate that a group's flights cannot show even if all of them pass, before they are flown.
/// Throws InputError naming the number of flights that could; no number of flights shows a rate of 1.
void require_decidable(const std::vector<CampaignCheck>& checks, const std::vector<GroupSummary>& groups);

/// Refuses the checks of a batch before its flights, as above, and an earlier batch that cannot be read. Orders with a
/// fault do not count. Throws InputError.
void require_decidable(const BatchOrders& batch);

/// Results of all checks for all groups. A group that the earlier batch lacks fails no_worse.
/// Throws InputError naming the file when an earlier batch cannot be read.
std::vector<GroupVerdict> judge(const std::vector<CampaignCheck>& checks, const std::vector<GroupSummary>& groups);

}  // namespace hedgehop::sim
