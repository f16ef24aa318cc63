#include "sim/render/texture_pyramid.h"

#include <opencv2/imgproc.hpp>

namespace hedgehop::sim {

TexturePyramid texture_pyramid(const cv::Mat& picture) {
  TexturePyramid pyramid;
  cv::Mat exact, smaller, color, grey;
  picture.convertTo(exact, CV_32F);
  for (;;) {
    exact.convertTo(color, CV_8U);
    cv::cvtColor(color, color, cv::COLOR_RGB2RGBA);
    const float third = 1.0f / 3.0f;
    cv::transform(exact, grey, cv::Matx13f(third, third, third));
    grey.convertTo(grey, CV_8U);
    pyramid.color.push_back(color.clone());
    pyramid.grey.push_back(grey.clone());
    if (exact.cols == 1) return pyramid;
    cv::resize(exact, smaller, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::swap(exact, smaller);
  }
}

}  // namespace hedgehop::sim
