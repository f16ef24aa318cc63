#include "avoidance/landmark_map/plan_overlay.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace hedgehop::avoidance::landmark_map {
namespace {

const cv::Scalar kGreen(90, 230, 110), kRed(240, 80, 60), kGrey(150, 150, 150), kYellow(255, 220, 40);

}  // namespace

void draw_plan(const PlanView& view, cv::Mat& image) {
  constexpr int kSidePx = 200, kMarginPx = 6;
  constexpr double kAroundM = 12.0;
  if (image.cols < 2 * kSidePx || image.rows < kSidePx + 2 * kMarginPx) return;
  cv::Mat plan = image(cv::Rect(image.cols - kSidePx - kMarginPx, image.rows - kSidePx - kMarginPx, kSidePx, kSidePx));
  plan *= 0.25;

  const Eigen::Vector2d middle = 0.5 * (view.from_NE + view.to_NE);
  const double half_m = 0.5 * (view.to_NE - view.from_NE).cwiseAbs().maxCoeff() + kAroundM;
  const auto at = [&](const Eigen::Vector2d& p_NE) {
    const Eigen::Vector2d off = (p_NE - middle) * (0.5 * kSidePx / half_m);
    const auto pixel = [&](double px) {
      return static_cast<int>(std::lround(0.5 * kSidePx + std::clamp(px, -1.0 * kSidePx, 1.0 * kSidePx)));
    };
    return cv::Point(pixel(off.y()), pixel(-off.x()));
  };

  cv::line(plan, at(view.from_NE), at(view.to_NE), kGrey, 1, cv::LINE_AA);
  for (const PlanHull& hull : view.hulls) {
    for (size_t k = 0; k < hull.size(); ++k) {
      cv::line(plan, at(hull[k]), at(hull[(k + 1) % hull.size()]), kRed, 1, cv::LINE_AA);
    }
  }
  for (const Eigen::Vector2d& landmark : view.landmarks_NE) cv::circle(plan, at(landmark), 1, kGreen, cv::FILLED);
  Eigen::Vector2d from = view.at_NE;
  for (const Eigen::Vector2d& turn : view.path_NE) {
    cv::line(plan, at(from), at(turn), kYellow, 1, cv::LINE_AA);
    from = turn;
  }
  cv::circle(plan, at(view.at_NE), 3, kYellow, cv::FILLED, cv::LINE_AA);
}

}  // namespace hedgehop::avoidance::landmark_map
