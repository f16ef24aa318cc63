#include "avoidance/local_map/local_map_overlay.h"

#include <opencv2/imgproc.hpp>

#include "avoidance/stereo/depth_overlay.h"

namespace hedgehop::avoidance::local_map {

cv::Mat draw(const ShownPlan& shown) {
  constexpr int kCellPx = 3;
  const LevelSlice& slice = shown.slice;
  const int n = slice.side();
  cv::Mat image(n, n, CV_8UC3);
  for (int row = 0; row < n; ++row) {
    for (int col = 0; col < n; ++col) {
      const LevelSlice::State state = slice.at(row, col);
      const cv::Vec3b color = state == LevelSlice::State::free      ? cv::Vec3b(235, 240, 235)
                              : state == LevelSlice::State::unknown ? cv::Vec3b(150, 150, 160)
                                                                    : cv::Vec3b(60, 30, 30);
      image.at<cv::Vec3b>(n - 1 - row, col) = color;
    }
  }
  cv::resize(image, image, {}, kCellPx, kCellPx, cv::INTER_NEAREST);
  const Eigen::Vector2d corner_W = slice.center(0, 0) - Eigen::Vector2d::Constant(0.5 * slice.cell_m());
  const auto pixel = [&](const Eigen::Vector2d& p_W) {
    const Eigen::Vector2d cells = (p_W - corner_W) / slice.cell_m();
    return cv::Point(static_cast<int>(kCellPx * cells.y()), static_cast<int>(kCellPx * (n - cells.x())));
  };
  for (size_t i = 1; i < shown.route_W.size(); ++i) {
    cv::line(image, pixel(shown.route_W[i - 1]), pixel(shown.route_W[i]), {90, 120, 220}, 1);
  }
  for (size_t i = 1; i < shown.path.size(); ++i) {
    cv::line(image, pixel(shown.path[i - 1].p_W), pixel(shown.path[i].p_W), {20, 160, 60}, 2);
  }
  const auto px = [&](double m) { return static_cast<int>(kCellPx * m / slice.cell_m()); };
  cv::circle(image, pixel(shown.path.front().p_W), px(shown.hull_m), {20, 160, 60}, 1);
  for (const MovingObstacle& obstacle : shown.moving_obstacles) {
    const cv::Scalar orange(240, 140, 20);
    cv::circle(image, pixel(obstacle.p_W), px(obstacle.radius_m), orange, 1);
    for (size_t i = 0; i < obstacle.surface_W.size(); ++i) {
      const Eigen::Vector2d& next_W = obstacle.surface_W[(i + 1) % obstacle.surface_W.size()];
      cv::line(image, pixel(obstacle.surface_W[i]), pixel(next_W), orange, 1);
    }
    cv::line(image, pixel(obstacle.p_W), pixel(obstacle.p_W + obstacle.v_W), orange, 1);
  }
  if (shown.look_W) cv::circle(image, pixel(*shown.look_W), 4, {230, 60, 40}, 2);
  stereo::caption(image, shown.status);
  return image;
}

}  // namespace hedgehop::avoidance::local_map
