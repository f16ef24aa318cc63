#pragma once

#include <opencv2/core.hpp>

#include "avoidance/section_grid/section_law.h"

namespace hedgehop::avoidance::section_grid {

/// The view of a camera that may be mounted on its side or upside down, such as those of a pair with one camera above
/// the other. Its images are rotated by quarter turns so that their columns point down in B, as far as possible.
class UprightView {
 public:
  UprightView() = default;
  /// @param mounted  the camera as it is mounted.
  explicit UprightView(const SectionCamera& mounted);

  /// The camera of the rotated images. Its baseline has the length, but not the direction, of the mounted pair's.
  const SectionCamera& camera() const { return camera_; }

  /// Rotates an image of the mounted camera. @param upright  shares the memory of `mounted` if no turn is needed.
  void rotate(const cv::Mat& mounted, cv::Mat& upright) const;

 private:
  int turns_ = 0;  ///< quarter turns, clockwise, 0 to 3
  SectionCamera camera_;
};

}  // namespace hedgehop::avoidance::section_grid
