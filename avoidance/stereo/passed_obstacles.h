#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "vision/stereo/depth_pyramid.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::avoidance::stereo {

struct PassedObstaclesConfig {
  double radius_m = 2.0;  ///< of the cylinder that must be free of them; 0 remembers nothing
  double near_m = 12.0;   ///< what is farther is not remembered: its place is too uncertain
  double keep_s = 8.0;
};
template <class Visitor>
void describe(Visitor& v, PassedObstaclesConfig& c) {
  v("radius", c.radius_m,
    {.unit = "m",
     .at_least = 0.0,
     .meaning = "of the cylinder that must be free of what has left the image; 0 remembers nothing"});
  v("near", c.near_m, {.unit = "m", .above = 0.0, .meaning = "obstacles seen closer than this are remembered"});
  v("keep", c.keep_s, {.unit = "s", .above = 0.0, .meaning = "for how long"});
}

/// Remembers near obstacles that have left the image at its edges, so that the vehicle does not turn into what it is
/// just passing. What the image shows is no matter for memory: a point that comes into view again is forgotten.
/// Ours: the aircraft of [Andert2007] sec. 4.1 knows its last image alone.
class PassedObstacles {
 public:
  explicit PassedObstacles(const PassedObstaclesConfig& config) : config_(config) {}

  /// Takes in what an image shows. @param X_WC  pose of the camera that the pyramid belongs to, as estimated.
  /// @param t_ns  of the image, rising.
  void update(int64_t t_ns, const vision::stereo::DepthPyramid& pyramid, const vision::stereo::StereoGeometry& geometry,
              const Eigen::Isometry3d& X_WC);

  /// Whether a way from the camera along `direction_W` (any length above 0) keeps `radius_m` from everything
  /// remembered. What is closer already must come no closer, but for a tenth.
  bool free(const Eigen::Vector3d& direction_W) const;

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
