#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <vector>

#include "vision/stereo/disparity.h"
#include "vision/stereo/flight_corridor.h"

namespace hedgehop::avoidance::stereo {

struct PassedObstaclesConfig {
  double radius_m = 2.0;  ///< radius of the cylinder that must be free of passed obstacles, >= 0; 0 disables the memory
  double near_m = 12.0;   ///< maximum distance of a remembered obstacle, > 0; farther positions are too uncertain
  double keep_s = 8.0;    ///< duration of the memory, > 0
};

/// Remembers near obstacles that have left the image at its edges, so that the vehicle does not turn into an obstacle
/// that it is passing. The newest image overrides the memory: a point that is in view again is deleted.
/// Not in the paper: the aircraft of [Andert2007] sec. 4.1 uses only its last image.
class PassedObstacles {
 public:
  enum class Among { hidden, all };

  explicit PassedObstacles(const PassedObstaclesConfig& config) : config_(config) {}

  /// Adds an image. @param X_WC  estimated pose of the camera that the pyramid belongs to. @param t_ns  time of the
  /// image, increasing.
  void update(int64_t t_ns, const vision::stereo::DepthPyramid& pyramid, const vision::stereo::StereoGeometry& geometry,
              const Eigen::Isometry3d& X_WC);

  /// Returns whether a straight path from the camera along `direction_W` (any length above 0) keeps the distance
  /// `radius_m` from all remembered points. If an obstacle is closer already, it may come closer by a tenth.
  /// @param reach_m  length of the path, >= 0. @param among  all: points seen in the last second count too, in view or
  /// not, and no point may be within the radius of the camera, in any direction.
  bool free(const Eigen::Vector3d& direction_W, double reach_m = std::numeric_limits<double>::infinity(),
            Among among = Among::hidden) const;

  /// Returns the distance of the camera from the nearest point, in view or remembered, m; +infinity if there is none.
  double nearest_m() const;
  /// Remembered points that are out of view, in W, m.
  std::vector<Eigen::Vector3d> points_W() const;

 private:
  struct Point {
    Eigen::Vector3d p_WP;
    int64_t t_ns;
  };
  bool in_view(const Eigen::Vector3d& p_CP, const vision::stereo::DepthPyramid& pyramid,
               const vision::stereo::StereoGeometry& geometry) const;

  PassedObstaclesConfig config_;
  std::vector<Point> hidden_;   ///< out of view of the last image
  std::vector<Point> visible_;  ///< in the last image
  std::vector<Point> recent_;   ///< in the images of the last second: a thin obstacle is not matched in every image
  Eigen::Vector3d p_WC_ = Eigen::Vector3d::Zero();
};

}  // namespace hedgehop::avoidance::stereo
