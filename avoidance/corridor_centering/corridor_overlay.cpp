#include "avoidance/corridor_picture.h"

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "avoidance/depth_picture.h"

namespace hedgehop::avoidance {
namespace {

using vision::Verdict;

const cv::Scalar kGreen(90, 230, 110), kRed(240, 80, 60), kFloor(90, 140, 255), kYellow(255, 220, 40);
constexpr int kFractionBits = 4;  // positions to 1/16 px

cv::Point fixed(double u, double v) {
  return {static_cast<int>(std::lround(u * (1 << kFractionBits))),
          static_cast<int>(std::lround(v * (1 << kFractionBits)))};
}

cv::Scalar color_of(Verdict verdict) {
  if (verdict == Verdict::good) return kGreen;
  return verdict == Verdict::floor ? kFloor : kRed;
}

cv::Mat fisheye(const CorridorSight& sight, const CorridorView* view) {
  cv::Mat wanted = sight.regions()[vision::kLeft] | sight.regions()[vision::kRight], dim = 0.55 * sight.picture();
  sight.picture().copyTo(dim, wanted);
  cv::Mat picture;
  cv::cvtColor(dim, picture, cv::COLOR_GRAY2RGB);
  for (size_t k = 0; k < sight.regions().size(); ++k) {
    std::vector<std::vector<cv::Point>> outline;
    cv::findContours(sight.regions()[k].clone(), outline, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    cv::drawContours(picture, outline, -1, k == vision::kAhead ? cv::Scalar(150, 150, 150) : kYellow, 1);
  }
  if (!view) return picture;
  constexpr double kLonger = 2.0;
  for (const vision::WallPoint& point : view->points) {
    const Eigen::Vector2d from = point.pair.before_px, to = from + kLonger * (point.pair.after_px - from);
    cv::line(picture, fixed(from.x(), from.y()), fixed(to.x(), to.y()), color_of(point.verdict), 1, cv::LINE_AA,
             kFractionBits);
  }
  return picture;
}

/// Forward is up, right is right.
class Map {
 public:
  explicit Map(int side_px) : picture_(side_px, side_px, CV_8UC3, cv::Scalar(28, 30, 34)) {
    for (int metre = -4; metre <= 4; ++metre) {
      line({-kHalf_m, metre}, {kHalf_m, metre}, cv::Scalar(48, 52, 58), 1);
      line({metre, -kHalf_m}, {metre, kHalf_m}, cv::Scalar(48, 52, 58), 1);
    }
  }
  void dot(const Eigen::Vector2d& p_H, const cv::Scalar& color) {
    const cv::Point at = place(p_H);
    cv::circle(picture_, at, 2 << kFractionBits, color, cv::FILLED, cv::LINE_AA, kFractionBits);
  }
  void line(const Eigen::Vector2d& a_H, const Eigen::Vector2d& b_H, const cv::Scalar& color, int width_px) {
    cv::line(picture_, place(a_H), place(b_H), color, width_px, cv::LINE_AA, kFractionBits);
  }
  void circle(double radius_m, const cv::Scalar& color) {
    cv::circle(picture_, place({0, 0}), static_cast<int>(radius_m * scale() * (1 << kFractionBits)), color, 2,
               cv::LINE_AA, kFractionBits);
  }
  cv::Mat& picture() { return picture_; }

 private:
  static constexpr double kHalf_m = 4.0;
  double scale() const { return picture_.rows / (2.0 * kHalf_m); }
  cv::Point place(const Eigen::Vector2d& p_H) const {
    return fixed(scale() * (kHalf_m + p_H.y()), scale() * (kHalf_m - p_H.x()));
  }
  cv::Mat picture_;
};

cv::Mat map_from_above(const CorridorScene& scene, int side_px) {
  Map map(side_px);
  if (scene.view) {
    for (const vision::WallPoint& point : scene.view->points) {
      if (point.verdict == Verdict::good) map.dot(point.p_CP_H.head<2>(), kGreen);
    }
    constexpr double kBack_m = -1.0, kFront_m = 3.0;
    const auto wall = [&](double direction_rad, double y_m, const cv::Scalar& color, double from_m, double to_m) {
      const Eigen::Rotation2Dd turn(direction_rad);
      if (std::isfinite(y_m))
        map.line(turn * Eigen::Vector2d(from_m, y_m), turn * Eigen::Vector2d(to_m, y_m), color, 2);
    };
    wall(scene.view->direction_rad, -scene.view->left.distance_m, kYellow, kBack_m, kFront_m);
    wall(scene.view->direction_rad, scene.view->right.distance_m, kYellow, kBack_m, kFront_m);
    wall(0.0, -scene.gap.left_m, cv::Scalar(240, 150, 60), 0.0, 0.5 * kFront_m);
    wall(0.0, scene.gap.right_m, cv::Scalar(240, 150, 60), 0.0, 0.5 * kFront_m);
  }
  map.circle(scene.radius_m, cv::Scalar::all(230));
  if (scene.course_rad) {
    map.line({0, 0}, 1.5 * Eigen::Vector2d(std::cos(*scene.course_rad), std::sin(*scene.course_rad)),
             cv::Scalar::all(255), 2);
  }
  caption(map.picture(), "medians yellow, gap orange, 1 m grid");
  return map.picture();
}

}  // namespace

cv::Mat corridor_picture(const CorridorSight& sight, const CorridorScene& scene) {
  cv::Mat picture = fisheye(sight, scene.view), both;
  caption(picture, scene.caption + "  red: wrong, blue: floor");
  cv::hconcat(picture, map_from_above(scene, picture.rows), both);
  return both;
}

}  // namespace hedgehop::avoidance
