#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>

#include "vision/stereo/disparity.h"
#include "vision/stereo/flight_corridor.h"

namespace hedgehop::avoidance::section_grid {

/// Remembers the space that recent depth images have shown to be free, also after it has left the image, such as the
/// space below and behind an obstacle that the vehicle has climbed over. Not in the paper.
class SeenSpace {
 public:
  /// Forgets everything.
  void reset() { images_.clear(); }

  /// Adds an image. @param t_ns  its time, increasing. @param pyramid  with the level kBlockLevel. @param X_WC
  /// estimated pose of its camera.
  void update(int64_t t_ns, const vision::stereo::DepthPyramid& pyramid, const vision::stereo::StereoGeometry& geometry,
              const Eigen::Isometry3d& X_WC);

  /// Returns whether the newest image that has a point in view shows that it is free: depth beyond the point, or no
  /// depth. A point that no image has in view is not free.
  /// @param p_W  in W, m.
  bool free(const Eigen::Vector3d& p_W) const;

  /// Returns whether a straight path is free to a distance of `radius_m` >= 0. @param from_W, to_W  its ends, m.
  bool free_path(const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W, double radius_m) const;

  static constexpr int kBlockLevel = 3;  ///< blocks of 8 px, of which the nearest point counts

 private:
  struct Image {
    int64_t t_ns;
    Eigen::Isometry3d X_CW;
    cv::Mat nearest16;  ///< disparity x 16 of the nearest point of each block
  };

  std::deque<Image> images_;  ///< oldest first
  vision::stereo::StereoGeometry geometry_;
  cv::Size image_;
};

}  // namespace hedgehop::avoidance::section_grid
