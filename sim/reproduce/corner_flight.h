#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "vision/landmarks/landmark_filter.h"

/// The flights of [Shah2009] ch. 4 and 5, without images as in the thesis: a camera reports all corners of the scene at
/// 10 Hz, also through walls.
namespace hedgehop::sim {

/// Camera at p_WC that looks at a point, its image upright.
Eigen::Isometry3d looking_at(const Eigen::Vector3d& p_WC, const Eigen::Vector3d& target_W);

/// A flight: the camera's trajectory and the corners.
struct CornerFlight {
  std::vector<Eigen::Vector3d> corners_W;  ///< m
  std::function<Eigen::Isometry3d(double t_s)> X_WC;
  double duration_s = 100.0;
  vision::camera::PinholeCamera camera;
};

/// About a cube with 8 corners, [Shah2009] table 4.1: 140 ft up, on a circle of 140 ft, 0.36 deg/s, field of view 30
/// deg.
CornerFlight cube_lateral_flight();
/// The same about high-rises with 35 corners.
CornerFlight highrise_lateral_flight();
/// Toward 35 corners, [Shah2009] table 5.1: level, 1.4 ft/s. Differs: the start distance, not published, is 120 m.
CornerFlight highrise_forward_flight();

/// Errors of a flight's map.
struct CornerFlightResult {
  std::vector<double> error_percent;  ///< of every image: mean over all coordinates of all corners
  double converged_s = NAN;           ///< from then on that mean stays within 3 %; NaN if it never does
  std::vector<double> filter_ms;      ///< wall time of the filter, of every image
  size_t landmarks = 0;               ///< confirmed, at the end
};

/// Called after every image with the map and each corner's landmark in it.
using WatchMap = std::function<void(double t_s, const vision::landmarks::LandmarkMap& map,
                                    const std::map<size_t, int64_t>& id_of_corner)>;

/// Flies with white errors of the navigation as the filter expects them, and of the corners, 0.5 px.
/// A coordinate's error is a share of the distance from the first camera to the corner.
CornerFlightResult fly_past_corners(const CornerFlight& flight, const vision::landmarks::LandmarkMapConfig& config,
                                    uint64_t seed, const WatchMap& watch = {});

}  // namespace hedgehop::sim
