#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "avoidance/local_map/kept_margin.h"
#include "avoidance/module.h"

namespace hedgehop::avoidance::local_map {

/// Chooses the status of decisions and counts them for the metrics.
class StatusCount {
 public:
  struct Situation {
    bool arrived = false;
    bool safe = false;            ///< whether a stop within the required clearance exists
    bool changes_height = false;  ///< whether the level of flight changes
    bool goes_on = false;         ///< whether there is a route, or unknown space to look at
    bool looks = false;           ///< at unknown space
  };

  /// @param margin_m  distance from the hull to occupied cells.
  std::string add(const Situation& now, const KeptMargin& kept_margin, double margin_m) {
    ++decisions_;
    stuck_ += !now.goes_on;
    stops_ += !now.safe;
    if (now.arrived) return "arrive";
    if (kept_margin.is_missed(margin_m)) return "close";
    if (!now.safe) return "brake";
    if (kept_margin.is_narrow()) return "narrow";
    if (now.changes_height) return "level";
    if (!now.goes_on) return "stuck";
    return now.looks ? "look" : "cruise";
  }

  std::vector<Metric> metrics(const KeptMargin& kept_margin) const {
    const auto share = [&](int64_t count) {
      return static_cast<double>(count) / static_cast<double>(std::max<int64_t>(1, decisions_));
    };
    std::vector<Metric> metrics = {{"brake_share", share(stops_), ""}, {"stuck_share", share(stuck_), ""}};
    if (kept_margin.is_kept() && decisions_ > 0) {
      metrics.push_back({"narrow_share", share(kept_margin.narrow_decisions()), ""});
      metrics.push_back({"close_share", share(kept_margin.missed_decisions()), ""});
      metrics.push_back({"map_margin", kept_margin.least_m(), "m"});
    }
    return metrics;
  }

 private:
  int64_t stops_ = 0, stuck_ = 0, decisions_ = 0;
};

}  // namespace hedgehop::avoidance::local_map
