#pragma once

#include <optional>

#include "sim/flight/flight.h"
#include "sim/loop/map_log.h"
#include "sim/verdict/map_score.h"

namespace hedgehop::sim {

/// Scores a module's map during a flight, where the scene's corners are known.
class MapJudge : public MapObserver {
 public:
  void on_map(const MapInstant& now) override;
  /// Adds the map's metrics to the flight's result, and to its record which points are true.
  void conclude(Flight& flight) const;

 private:
  std::optional<MapScore> score_;
};

}  // namespace hedgehop::sim
