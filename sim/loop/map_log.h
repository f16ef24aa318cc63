#pragma once

#include <vector>

#include "avoidance/module.h"
#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// Records a module's map: the points of the last decision, and of the planned paths the detours, every 2 s and
/// whenever the number of their turns changes.
class MapLog {
 public:
  /// @param t_s  rising.
  void add(double t_s, avoidance::Map map);

  /// The record so far, empty for a module that makes no map. What is true of it, a judge adds (MapScore::complete()).
  MapRecord record() const;

 private:
  avoidance::Map last_;
  std::vector<PlannedPath> paths_;
};

}  // namespace hedgehop::sim
