#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "sim/fields/field.h"
#include "vision/camera/camera.h"

// The functions below treat optic flow on the unit sphere, with rays instead of pixels, and hold for every lens.

namespace hedgehop::vision::flow {

/// Parameters of corner detection and tracking.
struct FeatureFlowConfig {
  int most = 250;                ///< maximum corners per region; [Zingg2010] sec. IV-D has about 250 per side
  double quality = 0.02;         ///< minimum strength, as a share of the region's maximum
  double least_strength = 1e-4;  ///< minimum of the smaller eigenvalue, grey in 0..1; above noise
  int apart_px = 5;
  int window_px = 15, levels = 3;  ///< of the tracking pyramid
  double round_trip_px = 0.5;      ///< maximum error after tracking back; 0: not checked
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FeatureFlowConfig> auto& c) {
  v("most", c.most, {.at_least = 1, .at_most = 10000, .meaning = "maximum number of corners per region"});
  v("quality", c.quality,
    {.above = 0.0, .at_most = 1.0, .meaning = "minimum strength of a corner, as a share of the region's maximum"});
  v("least_strength", c.least_strength,
    {.at_least = 0.0, .meaning = "minimum strength of a corner, squared gradient with grey from 0 to 1"});
  v("apart", c.apart_px, {.unit = "px", .at_least = 1, .at_most = 1000, .meaning = "minimum distance between corners"});
  v("window", c.window_px, {.unit = "px", .at_least = 3, .at_most = 99, .meaning = "side of the tracking window, odd"});
  v("levels", c.levels, {.at_least = 1, .at_most = 8, .meaning = "number of levels of the image pyramid"});
  v("round_trip", c.round_trip_px,
    {.unit = "px",
     .at_least = 0.0,
     .meaning = "maximum distance of a corner from its start after tracking back; 0: not checked"});
}

/// A corner in two images.
struct RayPair {
  Eigen::Vector2d before_px, after_px;
  Eigen::Vector3d before_C, after_C;  ///< unit rays, each in C at the time of its image
};

/// Returns the corners of the older image that are found in the newer one, as rays: Shi-Tomasi corners tracked by
/// pyramidal Lucas-Kanade.
/// @param older, newer  CV_8UC1, of the camera's size.
/// @param regions  masks of that size, CV_8UC1; corners are detected at pixels that are not 0.
/// @return one list per region. Throws std::invalid_argument on different sizes or an invalid config.
/// Source: [Zingg2010] sec. IV-A, eq. (3), (4) and (8). Differs: corners are also tracked back.
std::vector<std::vector<RayPair>> feature_flow(const cv::Mat& older, const cv::Mat& newer,
                                               std::span<const cv::Mat> regions, const camera::Camera& camera,
                                               const FeatureFlowConfig& config);

/// Returns the ray that a corner would have in the newer image if the camera had not rotated.
/// @param after_C  in C at the newer image (C2). @param R_C1C2  rotation of C2 in C at the older image (C1).
/// @return in C1. Source: [Zingg2010] eq. (5). Differs: the whole rotation, not a product of three changes of angle.
Eigen::Vector3d derotate_ray(const Eigen::Vector3d& after_C, const Eigen::Matrix3d& R_C1C2);

/// Returns the angle between two rays of any length, rad, 0..pi. Divided by the time between the images it is the flow.
/// Source: [Zingg2010] eq. (6) and (7). Differs: also uses the sine, because the arc cosine near 1 loses half the
/// digits.
double flow_angle_rad(const Eigen::Vector3d& before, const Eigen::Vector3d& after);

/// Returns the distance of a fixed point from the camera at the newer image, m; +inf without flow.
/// @param before, after  unit rays in the older and newer image in one frame, derotated.
/// @param traveled  displacement of the camera between the images, in that frame, m.
/// Source: [Zingg2010] eq. (2). Differs: uses the sine of the flow's angle instead of the angle. By the law of sines
/// this is exact for finite motion, measured from the newer position.
double distance_m(const Eigen::Vector3d& before, const Eigen::Vector3d& after, const Eigen::Vector3d& traveled);

/// Returns the angle between the direction of a ray's flow and that of a fixed point, rad, 0..pi. The flow of a fixed
/// point follows the great circle away from the direction of travel. Returns pi / 2 if either direction is undefined.
/// Parameters as for distance_m().
double direction_error_rad(const Eigen::Vector3d& before, const Eigen::Vector3d& after,
                           const Eigen::Vector3d& traveled);

/// Returns the angle between a flow vector and the tangent of the circle around `center_px` through its start, rad,
/// 0..pi/2; pi / 2 without flow. Source: [Zingg2010] sec. IV-D.
double off_tangent_rad(const Eigen::Vector2d& before_px, const Eigen::Vector2d& after_px,
                       const Eigen::Vector2d& center_px);

}  // namespace hedgehop::vision::flow
