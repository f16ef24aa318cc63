#include "sim/render/texture_pyramid.h"

#include <opencv2/imgproc.hpp>

namespace hedgehop::sim {

std::vector<cv::Mat> texture_pyramid(const cv::Mat& picture) {
  const float third = 1.0f / 3.0f;
  const cv::Matx<float, 4, 3> channels_and_mean(1, 0, 0, 0, 1, 0, 0, 0, 1, third, third, third);
  std::vector<cv::Mat> levels;
  cv::Mat exact, smaller;
  picture.convertTo(exact, CV_32F);
  cv::transform(exact, exact, channels_and_mean);
  for (;;) {
    exact.convertTo(levels.emplace_back(), CV_8U);
    if (exact.cols == 1) return levels;
    cv::resize(exact, smaller, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::swap(exact, smaller);
  }
}

}  // namespace hedgehop::sim
