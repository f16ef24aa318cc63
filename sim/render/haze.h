#pragma once

#include <opencv2/core.hpp>

#include "scenes/scene.h"
#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// Share of what lies at a distance that still reaches the eye, exp(-d ln 20 / visibility) by Koschmieder's law, [WMO8]
/// ch. 9: 1 at 0 m, 5 % at the visibility; 0 at infinity.
double transmittance(double distance_m, double visibility_m);

/// Turns each pixel towards the horizon's color, by its distance along the ray, as evenly thick air does. The sky is
/// left as it is.
/// @param depth  as Channel::depth of the same view; one depth a pixel, however many samples the image has.
/// @param image  CV_8UC1 or CV_8UC3, RGB.
void veil(const scenes::Sky& sky, const vision::camera::Camera& camera, const cv::Mat1f& depth, cv::Mat& image);

}  // namespace hedgehop::sim
