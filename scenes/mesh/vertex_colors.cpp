#include "scenes/mesh/vertex_colors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace hedgehop::scenes::mesh {

namespace {

constexpr int kBlockPx = 2;  // a block of texels for each triangle

cv::Vec3b level(const Eigen::Vector3f& color) {
  cv::Vec3b result;
  for (int k = 0; k < 3; ++k) {
    const float value = color[k] > 0.0f ? std::min(color[k], 1.0f) : 0.0f;  // 0 also for NaN
    result[k] = static_cast<uint8_t>(std::lround(255.0f * value));
  }
  return result;
}

}  // namespace

Triangles colored(const Triangles& triangles, std::span<const Eigen::Vector3f> colors, Scene& scene) {
  const int size_px = scene.textures.size_px(), across = size_px / kBlockPx;
  const size_t per_image = static_cast<size_t>(across) * static_cast<size_t>(across);
  Triangles result;
  result.is_two_sided = triangles.is_two_sided;
  cv::Mat image;
  uint32_t texture = 0;
  for (size_t f = 0; f < triangles.faces.size(); ++f) {
    const auto place = static_cast<int>(f % per_image);
    if (place == 0) {
      image = cv::Mat::zeros(size_px, size_px, CV_8UC3);
      texture = scene.textures.add([image] { return image; });  // shares the pixels that follow
    }
    const int row = place / across * kBlockPx, column = place % across * kBlockPx;
    const auto& [a, b, c] = triangles.faces[f];
    // With the fourth texel in the plane of the others, bilinear interpolation is that of the triangle.
    image.at<cv::Vec3b>(row, column) = level(colors[a]);
    image.at<cv::Vec3b>(row, column + 1) = level(colors[b]);
    image.at<cv::Vec3b>(row + 1, column) = level(colors[c]);
    image.at<cv::Vec3b>(row + 1, column + 1) = level(colors[b] + colors[c] - colors[a]);
    const auto first = static_cast<uint32_t>(result.vertices.size());
    for (const uint32_t corner : triangles.faces[f]) {
      Vertex& vertex = result.vertices.emplace_back(triangles.vertices[corner]);
      vertex.texture = texture;
      const auto texel = [&](int index) { return (static_cast<float>(index) + 0.5f) / static_cast<float>(size_px); };
      const bool is_b = result.vertices.size() == first + 2, is_c = result.vertices.size() == first + 3;
      vertex.uv = {texel(column + (is_b ? 1 : 0)), texel(row + (is_c ? 1 : 0))};
    }
    result.faces.push_back({first, first + 1, first + 2});
  }
  return result;
}

}  // namespace hedgehop::scenes::mesh
