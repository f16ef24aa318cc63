#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <span>

#include "scenes/scene.h"
#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// Returns the transmittance of hazy air, exp(-d ln 20 / visibility), by Koschmieder's law, [WMO8] ch. 9: 1 at 0 m,
/// 0.05 at the visibility, 0 at infinity.
double transmittance(double distance_m, double visibility_m);

/// Adds homogeneous haze to an image: blends each pixel with the color of the horizon according to its distance along
/// the ray. Pixels of the sky are not changed.
/// @param rays   all_rays() of a distorted pinhole camera; not read for other lenses.
/// @param depth  as ImageChannel::depth of the same view; one depth per pixel, for any number of samples.
/// @param image  CV_8UC1 or CV_8UC3, RGB.
void add_haze(const scenes::Sky& sky, const vision::camera::Camera& camera, std::span<const Eigen::Vector3d> rays,
              const cv::Mat1f& depth, cv::Mat& image);

}  // namespace hedgehop::sim
