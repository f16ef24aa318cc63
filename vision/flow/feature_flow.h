#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "vision/camera/camera.h"

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
void describe(Visitor& v, FeatureFlowConfig& c) {
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

}  // namespace hedgehop::vision::flow
