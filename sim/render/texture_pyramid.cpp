#include "sim/render/texture_pyramid.h"

#include <opencv2/imgproc.hpp>

namespace hedgehop::sim {

std::vector<cv::Mat> texture_pyramid(const cv::Mat& image) {
  std::vector<cv::Mat> levels;
  cv::Mat exact, smaller, rounded;
  image.convertTo(exact, CV_32F);
  for (;;) {
    exact.convertTo(rounded, CV_8U);
    cv::cvtColor(rounded, levels.emplace_back(), cv::COLOR_RGB2RGBA);
    if (exact.cols == 1) return levels;
    cv::resize(exact, smaller, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::swap(exact, smaller);
  }
}

}  // namespace hedgehop::sim
