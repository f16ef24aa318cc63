#include "sim/export/true_images.h"

#include <fmt/format.h>

#include "sim/record/image_file.h"

namespace hedgehop::sim {
cv::Mat kitti_flow(const cv::Mat& flow_px) {
  constexpr double kUnitsPerPixel = 64.0, kZero = 32768.0, kEnd = 65536.0;
  cv::Mat coded(flow_px.size(), CV_16UC3, cv::Scalar::all(0));
  for (int v = 0; v < flow_px.rows; ++v) {
    const float* flow = flow_px.ptr<float>(v);
    uint16_t* out = coded.ptr<uint16_t>(v);
    for (int u = 0; u < flow_px.cols; ++u, flow += 2, out += 3) {
      const double right = kUnitsPerPixel * flow[0] + kZero + 0.5, down = kUnitsPerPixel * flow[1] + kZero + 0.5;
      const bool fits = right >= 0.0 && right < kEnd && down >= 0.0 && down < kEnd;  // false for NaN
      if (!fits) continue;
      out[0] = static_cast<uint16_t>(right);
      out[1] = static_cast<uint16_t>(down);
      out[2] = 1;
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
  tick.start_flow(role);
  last = stem;
  return images;
}

}  // namespace hedgehop::sim
