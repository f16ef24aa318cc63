#include "vision/flow/flow_field.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace hedgehop::vision::flow {

int FlowField::valid_count() const {
  return static_cast<int>(std::count_if(vectors.begin(), vectors.end(), [](const FlowVector& v) { return v.valid; }));
}

double FlowField::valid_share() const {
  return vectors.empty() ? 0.0 : valid_count() / static_cast<double>(vectors.size());
}

void draw_flow(const FlowField& field, double scale, cv::Mat& rgb) {
  const cv::Scalar yellow(255, 220, 40), red(220, 50, 40);
  constexpr int kFractionBits = 4;  // positions to 1/16 px
  const auto fixed = [](const Eigen::Vector2d& p) {
    return cv::Point(static_cast<int>(std::lround(p.x() * (1 << kFractionBits))),
                     static_cast<int>(std::lround(p.y() * (1 << kFractionBits))));
  };
  for (const FlowVector& vector : field.vectors) {
    const cv::Point from = fixed(vector.center_px);
    if (vector.valid) {
      cv::line(rgb, from, fixed(vector.center_px + scale * vector.flow_px), yellow, 1, cv::LINE_AA, kFractionBits);
    }
    cv::circle(rgb, from, 1 << kFractionBits, vector.valid ? yellow : red, cv::FILLED, cv::LINE_AA, kFractionBits);
  }
}

}  // namespace hedgehop::vision::flow
