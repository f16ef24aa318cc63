#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/camera/camera.h"

namespace hedgehop::sim::mavlink {

/// Minimum range in a sector of the horizontal plane around the vehicle.
struct SectorRange {
  double nearest_m = std::numeric_limits<double>::infinity();  ///< from Bo; +infinity: no obstacle was seen
  bool seen = false;  ///< an obstacle was seen, or a part of the sector is free up to the maximum range
};

/// 72 sectors of 5 deg, clockwise from above. Sector i is centered at 5 i deg from the heading (frame H).
class ObstacleSectors {
 public:
  static constexpr int kCount = 72;
  static constexpr double kWidthDeg = 5.0;

  const SectorRange& at(int sector) const { return ranges_[static_cast<size_t>(sector)]; }
  /// Adds an obstacle in the direction of a horizontal position in H, m. @param range_m  horizontal, from Bo.
  void add_obstacle(double forward_m, double right_m, double range_m);
  /// Marks the sector of a horizontal position in H, m, as seen.
  void add_free(double forward_m, double right_m);
  /// Keeps the nearer obstacles of both.
  void merge(const ObstacleSectors& other);

 private:
  std::array<SectorRange, kCount> ranges_{};
};

/// Heights and ranges in which obstacles count.
struct SectorLimits {
  double above_m = 1.0, below_m = 1.0;  ///< height band around Bo, > 0
  double min_m = 0.2, max_m = 20.0;     ///< horizontal ranges from Bo, > 0
};

/// Converts the depth images of one camera to sectors.
class DepthToSectors {
 public:
  /// @param X_BC  pose of the camera in B. Throws std::invalid_argument if `max_m` is not above `min_m`.
  DepthToSectors(const vision::camera::Camera& camera, const Eigen::Isometry3d& X_BC, const SectorLimits& limits);

  /// Returns the sectors of a depth image. A point counts as an obstacle if it is within the heights and ranges of the
  /// limits. A ray that meets no surface up to the maximum range shows that the sector at its end is free, if the end
  /// is in the height band.
  /// @param depth_m  rows x cols, CV_32FC1, m: z in C, of a fisheye the range; +infinity: no surface; NaN: unknown.
  /// @param q_WB_est  attitude of B.
  ObstacleSectors sectors(const cv::Mat& depth_m, const Eigen::Quaterniond& q_WB_est) const;

 private:
  SectorLimits limits_;
  Eigen::Vector3d p_BC_;
  /// Per pixel the point at depth 1 m from C, in axes of B; NaN outside the image circle.
  std::vector<Eigen::Vector3f> rays_B_;
};

}  // namespace hedgehop::sim::mavlink
