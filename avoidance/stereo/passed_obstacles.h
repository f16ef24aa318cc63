#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <vector>

#include "vision/stereo/disparity.h"
#include "vision/stereo/flight_corridor.h"

namespace hedgehop::avoidance::stereo {

struct PassedObstaclesConfig {
  double radius_m = 2.0;  ///< of the cylinder that must be free of them, >= 0; 0 remembers nothing
  double near_m = 12.0;   ///< what is farther is not remembered, for its place is too uncertain; > 0
  double keep_s = 8.0;    ///< for how long, > 0
};

/// Remembers near obstacles that have left the image at its edges, so that the vehicle does not turn into what it is
/// just passing. The newest image overrides memory: a point that comes into view again is forgotten.
/// Ours: the aircraft of [Andert2007] sec. 4.1 knows its last image alone.
class PassedObstacles {
 public:
  explicit PassedObstacles(const PassedObstaclesConfig& config) : config_(config) {}

  /// Adds what an image shows. @param X_WC  pose of the camera that the pyramid belongs to, as estimated.
  /// @param t_ns  of the image, rising.
  void update(int64_t t_ns, const vision::stereo::DepthPyramid& pyramid, const vision::stereo::StereoGeometry& geometry,
              const Eigen::Isometry3d& X_WC);

  /// Whether a straight path from the camera along `direction_W` (any length above 0) keeps `radius_m` from all that
  /// is remembered. An obstacle that is closer already may come closer by a tenth.
  /// @param reach_m  length of the path, >= 0.
  bool free(const Eigen::Vector3d& direction_W, double reach_m = std::numeric_limits<double>::infinity()) const;

  /// Remembered and out of view, in W, m.
  std::vector<Eigen::Vector3d> points_W() const;

 private:
  struct Point {
    Eigen::Vector3d p_WP;
    int64_t t_ns;
  };
  bool in_view(const Eigen::Vector3d& p_CP, const vision::stereo::DepthPyramid& pyramid,
               const vision::stereo::StereoGeometry& geometry) const;

  PassedObstaclesConfig config_;
  std::vector<Point> hidden_;   ///< out of the last image's view
  std::vector<Point> visible_;  ///< of the last image
  Eigen::Vector3d p_WC_ = Eigen::Vector3d::Zero();
};

}  // namespace hedgehop::avoidance::stereo
