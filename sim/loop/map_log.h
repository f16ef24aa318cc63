#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "avoidance/module.h"
#include "scenes/scene.h"
#include "sim/collision/proximity.h"
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

/// A module's map at one decision, and the truth to compare it with. Good until the next call.
struct MapInstant {
  double t_s = 0.0;
  const avoidance::Map& map;
  const avoidance::MountedCamera& camera;  ///< the first that the module needs, as it is truly mounted
  Eigen::Isometry3d X_WB_true;
  Eigen::Vector3d p_WB_start_true;  ///< where the flight began, m
  const scenes::Scene& scene;
  const CollisionWorld& world;
  bool sees_through_walls = false;  ///< whether the module gets corners that solids hide
};

/// Observes a module's map, decision by decision; cannot reach the flight.
class MapObserver {
 public:
  virtual ~MapObserver() = default;
  /// After every decision of a module that needs a camera.
  virtual void on_map(const MapInstant& now) = 0;
};

}  // namespace hedgehop::sim
