#pragma once

#include "avoidance/module.h"
#include "sim/flight/map_record.h"
#include "sim/verdict/map_score.h"

namespace hedgehop::sim {

/// Keeps a module's chart, decision by decision: the last one, and of the ways planned the detours, every 2 s and
/// whenever the number of their turns changes.
class MapLog {
 public:
  /// @param t_s  rising.
  void add(double t_s, avoidance::Chart chart);

  /// The record so far, empty for a module that keeps no chart; the log is empty afterwards.
  /// @param score  of the same charts; null where the true corners are unknown.
  MapRecord take(const MapScore* score);

 private:
  avoidance::Chart last_;
  std::vector<PlannedWay> ways_;
};

}  // namespace hedgehop::sim
