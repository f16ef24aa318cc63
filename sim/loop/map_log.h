#pragma once

#include "avoidance/module.h"
#include "sim/flight/map_record.h"
#include "sim/verdict/map_score.h"

namespace hedgehop::sim {

/// Keeps a module's map, decision by decision: the last one, and of the planned paths the detours, every 2 s and
/// whenever the number of their turns changes.
class MapLog {
 public:
  /// @param t_s  rising.
  void add(double t_s, avoidance::Map map);

  /// The record so far, empty for a module that keeps no map; the log is empty afterwards.
  /// @param score  of the same maps; null where the true corners are unknown.
  MapRecord take(const MapScore* score);

 private:
  avoidance::Map last_;
  std::vector<PlannedPath> paths_;
};

}  // namespace hedgehop::sim
