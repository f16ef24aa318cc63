#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <numbers>
#include <opencv2/core.hpp>

#include "vision/camera/camera.h"

namespace hedgehop::vision::corridor {

/// The parts of the view that are searched for walls. Azimuth from B's x axis, elevation from B's x-y plane upwards.
/// Source: [Zingg2010] sec. IV-D and fig. 7: two segments of 80 deg, 50 deg ahead left out. The elevations are ours.
struct CorridorRegions {
  double ahead_rad = 25.0 * std::numbers::pi / 180.0;  ///< left out to each side of the direction of travel
  double segment_rad = 80.0 * std::numbers::pi / 180.0;
  double lowest_rad = -25.0 * std::numbers::pi / 180.0;
  double highest_rad = 5.0 * std::numbers::pi / 180.0;
};

template <class Visitor>
void describe(Visitor& v, CorridorRegions& c) {
  v("ahead", c.ahead_rad,
    {.unit = "deg", .at_least = 0.0, .at_most = 90.0, .meaning = "left out to each side of the nose"});
  v("segment", c.segment_rad, {.unit = "deg", .above = 0.0, .at_most = 180.0, .meaning = "width of each side's view"});
  v("lowest", c.lowest_rad,
    {.unit = "deg", .at_least = -90.0, .at_most = 90.0, .meaning = "lowest elevation searched for walls"});
  v("highest", c.highest_rad,
    {.unit = "deg", .at_least = -90.0, .at_most = 90.0, .meaning = "highest elevation searched for walls"});
}

/// Indices into the array that region_masks() returns.
enum Region { kLeft, kRight, kAhead, kRegions };

/// Returns the pixels of each region: CV_8UC1 masks of its image's size, 255 inside.
/// @param X_BC  pose of the camera in B.
/// @param rim_px  pixels this near to the image's edge, or to where the lens shows nothing, stay out, >= 0.
/// Throws std::invalid_argument on angles that leave a region empty.
std::array<cv::Mat, kRegions> region_masks(const camera::Camera& camera, const Eigen::Isometry3d& X_BC,
                                           const CorridorRegions& regions, int rim_px);

}  // namespace hedgehop::vision::corridor
