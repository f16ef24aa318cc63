#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "sim/fields/field.h"
#include "vision/camera/camera.h"

/// Optic flow on the unit sphere: rays instead of pixels, so that it holds for any lens.

namespace hedgehop::vision::flow {

/// How corners are detected and tracked.
struct FeatureFlowConfig {
  int most = 250;                ///< corners per region; [Zingg2010] sec. IV-D has about 250 a side
  double quality = 0.02;         ///< least strength, as a share of the region's strongest corner's
  double least_strength = 1e-4;  ///< smaller eigenvalue of the gradients' products, grey in 0..1: noise stays below
  int apart_px = 5;
  int window_px = 15, levels = 3;  ///< of the pyramidal search
  double round_trip_px = 0.5;      ///< tracked back, a corner must end this close to its start; 0: not checked
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FeatureFlowConfig> auto& c) {
  v("most", c.most, {.at_least = 1, .at_most = 10000, .meaning = "corners tracked per region"});
  v("quality", c.quality,
    {.above = 0.0, .at_most = 1.0, .meaning = "least strength of a corner, as a share of the region's strongest"});
  v("least_strength", c.least_strength,
    {.at_least = 0.0, .meaning = "least strength of a corner, squared gradient with grey from 0 to 1"});
  v("apart", c.apart_px, {.unit = "px", .at_least = 1, .at_most = 1000, .meaning = "least distance of two corners"});
  v("window", c.window_px, {.unit = "px", .at_least = 3, .at_most = 99, .meaning = "side of the tracking window, odd"});
  v("levels", c.levels, {.at_least = 1, .at_most = 8, .meaning = "of the image pyramid"});
  v("round_trip", c.round_trip_px,
    {.unit = "px",
     .at_least = 0.0,
     .meaning = "tracked back, a corner must end this close to its start; 0: not checked"});
}

/// One corner in two images.
struct RayPair {
  Eigen::Vector2d before_px, after_px;
  Eigen::Vector3d before_C, after_C;  ///< rays of length 1, each in C at its own image
};

/// Returns the corners of the older image that are found in the newer one, region by region: Shi and Tomasi's
/// corners, tracked by pyramidal Lucas-Kanade, as rays.
/// @param older, newer  CV_8UC1, of the camera's size.
/// @param regions  masks of that size, CV_8UC1; corners begin where one is not 0.
/// @return as many lists as regions. Throws std::invalid_argument on sizes that differ or a bad config.
/// Source: [Zingg2010] sec. IV-A, eq. (3), (4) and (8). Differs: corners are also tracked back.
std::vector<std::vector<RayPair>> feature_flow(const cv::Mat& older, const cv::Mat& newer,
                                               std::span<const cv::Mat> regions, const camera::Camera& camera,
                                               const FeatureFlowConfig& config);

/// Returns the ray that a corner would have in the newer image, had the camera not rotated.
/// @param after_C  in C at the newer image (C2). @param R_C1C2  rotation of C2 in C at the older image (C1).
/// @return in C1. Source: [Zingg2010] eq. (5). Differs: the whole rotation, not a product of three changes of angle.
Eigen::Vector3d derotate_ray(const Eigen::Vector3d& after_C, const Eigen::Matrix3d& R_C1C2);

/// Returns the angle between two rays of any length, rad, 0..pi. Over the time between the images it is the flow.
/// Source: [Zingg2010] eq. (6) and (7). Differs: from the sine as well, for the arc cosine of 1 loses half the digits.
double flow_angle_rad(const Eigen::Vector3d& before, const Eigen::Vector3d& after);

/// Returns the distance of a fixed point from where the camera is at the newer image, m; +inf without flow.
/// @param before, after  rays in the older and newer image in one frame, derotated, length 1.
/// @param traveled  of the camera between the images, in that frame, m.
/// Source: [Zingg2010] eq. (2). Differs: the sine of the flow's angle instead of the angle: by the law of sines it then
/// holds for finite motion, from the newer place.
double distance_m(const Eigen::Vector3d& before, const Eigen::Vector3d& after, const Eigen::Vector3d& traveled);

/// Returns the angle between the direction of a ray's flow and that of a fixed point's flow, rad, 0..pi. A fixed
/// point's flow follows the great circle away from the direction of travel. pi / 2 where either is undefined.
/// Parameters as distance_m().
double direction_error_rad(const Eigen::Vector3d& before, const Eigen::Vector3d& after,
                           const Eigen::Vector3d& traveled);

/// Returns the angle between a flow vector and the tangent of the circle round `center_px` on which it begins, rad,
/// 0..pi/2; pi / 2 where there is no flow. Source: [Zingg2010] sec. IV-D.
double off_tangent_rad(const Eigen::Vector2d& before_px, const Eigen::Vector2d& after_px,
                       const Eigen::Vector2d& center_px);

}  // namespace hedgehop::vision::flow
