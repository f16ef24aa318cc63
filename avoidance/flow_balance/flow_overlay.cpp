#include "avoidance/flow_balance/flow_overlay.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/flow/flow_field.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

constexpr double kFlowScale = 6.0;  // drawn px per px of flow
constexpr int kGapPx = 4;

void draw_caption(const FlowTile& tile, cv::Mat& image) {
  const double size = std::clamp(image.cols / 800.0, 0.3, 0.6);
  const int height = static_cast<int>(24 * size) + 8;
  image.rowRange(0, std::min(height, image.rows)).setTo(cv::Scalar(20, 24, 28));
  cv::putText(image, tile.role + "  " + tile.caption, {4, height - 8}, cv::FONT_HERSHEY_SIMPLEX, size,
              cv::Scalar(235, 235, 235), 1, cv::LINE_AA);
}

void draw_compass(std::span<const CompassArrow> arrows, double full_scale_mps, cv::Mat& image) {
  const cv::Point middle(image.cols / 2, image.rows / 2);
  const int radius = std::max(12, std::min(image.cols, image.rows) / 14);
  cv::circle(image, middle, radius, cv::Scalar(20, 24, 28), cv::FILLED, cv::LINE_AA);
  cv::circle(image, middle, radius, cv::Scalar(235, 235, 235), 1, cv::LINE_AA);
  for (const CompassArrow& arrow : arrows) {
    const Eigen::Vector2d tip = arrow.v_H * (radius / full_scale_mps);
    const cv::Point to(middle.x + static_cast<int>(std::lround(tip.y())),
                       middle.y - static_cast<int>(std::lround(tip.x())));
    cv::arrowedLine(image, middle, to, arrow.rgb, 2, cv::LINE_AA, 0, 0.25);
  }
}

}  // namespace

cv::Mat flow_overlay(std::span<const FlowTile> tiles, std::span<const CompassArrow> arrows, double full_scale_mps) {
  if (tiles.empty()) return {};
  int width = 0, height = 0;
  for (const FlowTile& tile : tiles) {
    width = std::max(width, tile.grey.cols);
    height = std::max(height, tile.grey.rows);
  }
  const int columns = tiles.size() > 1 ? 2 : 1, rows = static_cast<int>(tiles.size() + 1) / columns;
  cv::Mat image(rows * (height + kGapPx) - kGapPx, columns * (width + kGapPx) - kGapPx, CV_8UC3,
                cv::Scalar(20, 24, 28));
  for (size_t i = 0; i < tiles.size(); ++i) {
    const FlowTile& tile = tiles[i];
    if (tile.grey.empty()) continue;
    const int row = static_cast<int>(i) / columns, col = static_cast<int>(i) % columns;
    cv::Mat place = image({col * (width + kGapPx), row * (height + kGapPx), tile.grey.cols, tile.grey.rows});
    cv::cvtColor(tile.grey, place, cv::COLOR_GRAY2RGB);
    vision::flow::draw_flow(*tile.field, kFlowScale, place);
    draw_caption(tile, place);
  }
  draw_compass(arrows, full_scale_mps, image);
  return image;
}

}  // namespace hedgehop::avoidance::flow_balance
