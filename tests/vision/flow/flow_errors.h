#pragma once

#include <algorithm>
#include <cmath>

#include "tests/vision/flow/textured_image.h"
#include "vision/flow/flow_field.h"

/// Errors of a flow field relative to the truth.
namespace hedgehop::vision {

inline constexpr int kSize = 400;

struct Errors {
  double rms_px = 0.0, largest_px = 0.0;
  int valid = 0;
};

template <class TrueFlow>
Errors errors(const flow::FlowField& field, TrueFlow true_flow) {
  Errors e;
  for (const flow::FlowVector& vector : field.vectors) {
    if (!vector.valid) continue;
    const double error = (vector.flow_px - true_flow(vector.center_px)).norm();
    e.rms_px += error * error;
    e.largest_px = std::max(e.largest_px, error);
    ++e.valid;
  }
  e.rms_px = std::sqrt(e.rms_px / std::max(e.valid, 1));
  return e;
}

inline cv::Mat shifted(const WaveTexture& texture, const Eigen::Vector2d& shift_px, int width = kSize,
                       int height = kSize) {
  return draw_image(width, height,
                    [&](double u, double v) { return texture.grey(u - shift_px.x(), v - shift_px.y()); });
}

inline double largest(const flow::FlowField& field) {
  double length = 0.0;
  for (const flow::FlowVector& vector : field.vectors) length = std::max(length, vector.flow_px.norm());
  return length;
}

}  // namespace hedgehop::vision
