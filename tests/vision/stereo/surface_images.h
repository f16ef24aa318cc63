#pragma once

#include <opencv2/imgproc.hpp>

namespace hedgehop::vision::stereo {

/// Returns a smooth random texture with a mean of 130 grey levels, CV_32FC1.
/// @param blur_px  standard deviation of the blur. @param texture  standard deviation of the texture, grey levels.
inline cv::Mat textured_surface(uint64_t seed, cv::Size size, double blur_px, double texture) {
  cv::Mat surface(size, CV_32FC1);
  cv::RNG(seed).fill(surface, cv::RNG::NORMAL, 0.0, 1.0);
  cv::GaussianBlur(surface, surface, {}, blur_px);
  cv::Scalar mean, deviation;
  cv::meanStdDev(surface, mean, deviation);
  return surface * (texture / deviation[0]) + 130.0;
}

/// Returns noise with a standard deviation of 2 grey levels, CV_32FC1.
inline cv::Mat camera_noise(uint64_t seed, cv::Size size) {
  cv::Mat noise(size, CV_32FC1);
  cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0.0, 2.0);
  return noise;
}

}  // namespace hedgehop::vision::stereo
