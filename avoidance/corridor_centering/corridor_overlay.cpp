#include "avoidance/corridor_centering/corridor_overlay.h"

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "avoidance/stereo/depth_overlay.h"

namespace hedgehop::avoidance::corridor_centering {
namespace {

using vision::corridor::RejectionReason;

const cv::Scalar kGreen(90, 230, 110), kRed(240, 80, 60), kFloor(90, 140, 255), kYellow(255, 220, 40);
constexpr int kFractionBits = 4;  // positions to 1/16 px

cv::Point fixed(double u, double v) {
  return {static_cast<int>(std::lround(u * (1 << kFractionBits))),
          static_cast<int>(std::lround(v * (1 << kFractionBits)))};
}

cv::Scalar color_of(RejectionReason rejection) {
  if (rejection == RejectionReason::none) return kGreen;
  return rejection == RejectionReason::floor ? kFloor : kRed;
}

cv::Mat fisheye(const CorridorSight& sight, const CorridorView* view) {
  cv::Mat wanted = sight.regions()[vision::corridor::kLeft] | sight.regions()[vision::corridor::kRight],
          dim = 0.55 * sight.image();
  sight.image().copyTo(dim, wanted);
  cv::Mat image;
  cv::cvtColor(dim, image, cv::COLOR_GRAY2RGB);
  for (size_t k = 0; k < sight.regions().size(); ++k) {
    std::vector<std::vector<cv::Point>> outline;
    cv::findContours(sight.regions()[k].clone(), outline, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    cv::drawContours(image, outline, -1, k == vision::corridor::kAhead ? cv::Scalar(150, 150, 150) : kYellow, 1);
  }
  if (!view) return image;
  constexpr double kLonger = 2.0;
  for (const vision::corridor::WallPoint& point : view->points) {
    const Eigen::Vector2d from = point.pair.before_px, to = from + kLonger * (point.pair.after_px - from);
    cv::line(image, fixed(from.x(), from.y()), fixed(to.x(), to.y()), color_of(point.rejection), 1, cv::LINE_AA,
             kFractionBits);
  }
  return image;
}

/// Forward is up, right is right.
class Map {
 public:
  explicit Map(int side_px) : image_(side_px, side_px, CV_8UC3, cv::Scalar(28, 30, 34)) {
    for (int meter = -4; meter <= 4; ++meter) {
      line({-kHalfM, meter}, {kHalfM, meter}, cv::Scalar(48, 52, 58), 1);
      line({meter, -kHalfM}, {meter, kHalfM}, cv::Scalar(48, 52, 58), 1);
    }
  }
  void dot(const Eigen::Vector2d& p_H, const cv::Scalar& color) {
    const cv::Point at = place(p_H);
    cv::circle(image_, at, 2 << kFractionBits, color, cv::FILLED, cv::LINE_AA, kFractionBits);
  }
  void line(const Eigen::Vector2d& a_H, const Eigen::Vector2d& b_H, const cv::Scalar& color, int width_px) {
    cv::line(image_, place(a_H), place(b_H), color, width_px, cv::LINE_AA, kFractionBits);
  }
  void circle(double radius_m, const cv::Scalar& color) {
    cv::circle(image_, place({0, 0}), static_cast<int>(radius_m * scale() * (1 << kFractionBits)), color, 2,
               cv::LINE_AA, kFractionBits);
  }
  cv::Mat& image() { return image_; }

 private:
  static constexpr double kHalfM = 4.0;
  double scale() const { return image_.rows / (2.0 * kHalfM); }
  cv::Point place(const Eigen::Vector2d& p_H) const {
    return fixed(scale() * (kHalfM + p_H.y()), scale() * (kHalfM - p_H.x()));
  }
  cv::Mat image_;
};

cv::Mat map_from_above(const CorridorScene& scene, int side_px) {
  Map map(side_px);
  if (scene.view) {
    for (const vision::corridor::WallPoint& point : scene.view->points) {
      if (point.rejection == RejectionReason::none) map.dot(point.p_CP_H.head<2>(), kGreen);
    }
    constexpr double kBackM = -1.0, kFrontM = 3.0;
    const auto wall = [&](double direction_rad, double y_m, const cv::Scalar& color, double from_m, double to_m) {
      const Eigen::Rotation2Dd turn(direction_rad);
      if (std::isfinite(y_m))
        map.line(turn * Eigen::Vector2d(from_m, y_m), turn * Eigen::Vector2d(to_m, y_m), color, 2);
    };
    wall(scene.view->direction_rad, -scene.view->left.distance_m, kYellow, kBackM, kFrontM);
    wall(scene.view->direction_rad, scene.view->right.distance_m, kYellow, kBackM, kFrontM);
    wall(0.0, -scene.gap.left_m, cv::Scalar(240, 150, 60), 0.0, 0.5 * kFrontM);
    wall(0.0, scene.gap.right_m, cv::Scalar(240, 150, 60), 0.0, 0.5 * kFrontM);
  }
  map.circle(scene.radius_m, cv::Scalar::all(230));
  if (scene.course_rad) {
    map.line({0, 0}, 1.5 * Eigen::Vector2d(std::cos(*scene.course_rad), std::sin(*scene.course_rad)),
             cv::Scalar::all(255), 2);
  }
  stereo::caption(map.image(), "medians yellow, gap orange, 1 m grid");
  return map.image();
}

}  // namespace

cv::Mat corridor_overlay(const CorridorSight& sight, const CorridorScene& scene) {
  cv::Mat image = fisheye(sight, scene.view), both;
  stereo::caption(image, scene.caption + "  red: wrong, blue: floor");
  cv::hconcat(image, map_from_above(scene, image.rows), both);
  return both;
}

}  // namespace hedgehop::avoidance::corridor_centering
