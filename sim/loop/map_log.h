#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "avoidance/module.h"
#include "scenes/scene.h"
#include "sim/collision/proximity.h"
#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// Records a module's map: the points of the last decision, and the planned paths that are detours, every 2 s and on
/// every change of their number of waypoints.
class MapLog {
 public:
  /// @param t_s  increasing.
  void add(double t_s, avoidance::Map map);

  /// The record so far, empty for a module that makes no map. The verdict adds which points are true
  /// (MapScore::complete()).
  MapRecord record() const;

 private:
  avoidance::Map last_;
  std::vector<PlannedPath> paths_;
};

/// A module's map at one decision and the ground truth. Valid until the next call.
struct MapInstant {
  double t_s = 0.0;
  const avoidance::Map& map;
  const avoidance::MountedCamera& camera;  ///< the first that the module needs, as it is truly mounted
  Eigen::Isometry3d X_WB_true;
  Eigen::Vector3d p_WB_start_true;  ///< start of the flight, m
  const scenes::Scene& scene;
  const CollisionWorld& world;
  bool sees_through_walls = false;  ///< whether the module gets corners that solids hide
};

/// Observes a module's map at every decision; it cannot affect the flight.
class MapObserver {
 public:
  virtual ~MapObserver() = default;
  /// Called after every decision of a module that needs a camera.
  virtual void on_map(const MapInstant& now) = 0;
};

}  // namespace hedgehop::sim
