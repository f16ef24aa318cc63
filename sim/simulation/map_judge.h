#pragma once

#include <optional>

#include "sim/flight/flight.h"
#include "sim/loop/map_log.h"
#include "sim/verdict/map_score.h"

namespace hedgehop::sim {

/// Scores a module's map during a flight if the scene has known corners.
class MapJudge : public MapObserver {
 public:
  void on_map(const MapInstant& now) override;
  /// Adds the map's metrics to the flight's result, and marks the true points in its record.
  void conclude(Flight& flight) const;

 private:
  std::optional<MapScore> score_;
};

}  // namespace hedgehop::sim
