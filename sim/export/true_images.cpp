#include "sim/export/true_images.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/record/image_file.h"

namespace hedgehop::sim {
cv::Mat kitti_flow(const cv::Mat& flow_px) {
  constexpr float kUnitsPerPixel = 64.0f, kZero = 32768.0f;
  cv::Mat coded(flow_px.size(), CV_16UC3, cv::Scalar::all(0));
  for (int v = 0; v < flow_px.rows; ++v) {
    for (int u = 0; u < flow_px.cols; ++u) {
      const auto& flow = flow_px.at<cv::Vec2f>(v, u);
      const float right = std::round(kUnitsPerPixel * flow[0] + kZero),
                  down = std::round(kUnitsPerPixel * flow[1] + kZero);
      const bool fits = right >= 0.0f && right <= 65535.0f && down >= 0.0f && down <= 65535.0f;  // false for NaN
      if (fits) coded.at<cv::Vec3w>(v, u) = {static_cast<uint16_t>(right), static_cast<uint16_t>(down), 1};
    }
  }
  return coded;
}

std::vector<ImageFile> TrueImages::images(size_t camera, const std::string& role, const SensorTick& tick,
                                          const std::string& stem) {
  const std::filesystem::path folder = std::filesystem::path("truth") / fmt::format("cam{}", camera);
  const auto file = [&](const char* kind, const std::string& name) { return folder / kind / (name + ".png"); };
  std::vector<ImageFile> images{{file("labels", stem), labels_16bit(tick.labels(role))},
                                {file("semantic", stem), labels_16bit(tick.semantic(role))},
                                {file("moving", stem), tick.moving(role)}};
  const cv::Mat depth_m = tick.depth(role);
  if (depth_ == DepthFormat::float_m) {
    images.push_back({folder / "depth" / (stem + ".tiff"), depth_m});
  } else {
    images.push_back({file("depth", stem), depth_mm(depth_m)});
  }
  std::string& last = last_stem_[camera];
  if (!last.empty()) images.push_back({file("flow", last), kitti_flow(tick.flow_to_here(role))});
  last = stem;
  return images;
}

}  // namespace hedgehop::sim
