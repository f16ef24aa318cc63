#include "avoidance/stereo_corridor/target_overlay.h"

#include <array>
#include <opencv2/imgproc.hpp>

#include "avoidance/stereo/depth_overlay.h"

namespace hedgehop::avoidance::stereo_corridor {
namespace {

const cv::Scalar kFree(90, 230, 110), kDangerous(255, 70, 60), kRegion(255, 255, 255);

cv::Mat depth_panel(const cv::Mat& disparity16, const vision::stereo::StereoGeometry& geometry, double far_m) {
  cv::Mat depth_m;
  vision::stereo::to_depth(disparity16, geometry, depth_m);
  return stereo::depth_overlay(depth_m, far_m);
}

/// Returns the block of the pyramid around its center pixel. The column is a multiple of the block size plus half the
/// size, and the size is a power of two. Therefore the lowest bit of the column is half the size.
cv::Rect block_of(const cv::Point& center) {
  const int half = center.x & -center.x;
  return {center.x - half, center.y - half, 2 * half, 2 * half};
}

/// Colors an area transparently, except for its edge, so that neighbors can be distinguished.
void tint(cv::Mat& panel, const cv::Rect& area, const cv::Scalar& color) {
  const cv::Rect inner = cv::Rect(area.x + 1, area.y + 1, area.width - 2, area.height - 2) & cv::Rect({}, panel.size());
  if (inner.empty()) return;
  cv::Mat part = panel(inner);
  cv::addWeighted(part, 0.5, cv::Mat(part.size(), part.type(), color), 0.5, 0.0, part);
}

}  // namespace

cv::Mat draw(const TargetImage& shown, const vision::stereo::DepthPyramid& pyramid,
             const vision::stereo::StereoGeometry& geometry, double far_m) {
  cv::Mat left;
  cv::cvtColor(shown.grey, left, cv::COLOR_GRAY2RGB);
  const cv::Mat filtered = depth_panel(pyramid.level(0)(cv::Rect({}, pyramid.image())), geometry, far_m);
  std::array<cv::Mat, 6> panels = {
      left.clone(), depth_panel(shown.matched16, geometry, far_m), filtered, filtered.clone(), left.clone(), left};
  for (const TargetImage::Candidate& candidate : shown.candidates) {
    cv::rectangle(panels[3], block_of(candidate.pixel), kRegion);
    tint(panels[4], block_of(candidate.pixel), candidate.free ? kFree : kDangerous);
  }
  if (shown.target) {
    cv::circle(panels[5], *shown.target, shown.target_radius_px, kFree, 2, cv::LINE_AA);
    cv::drawMarker(panels[5], *shown.target, kFree);
  }
  const std::array<std::string, 6> captions = {"left image",        "depth, red near",
                                               "depth, filtered",   "no near objects here",
                                               "free or dangerous", "chosen: " + shown.chosen_by};
  for (size_t i = 0; i < panels.size(); ++i) stereo::caption(panels[i], captions[i]);
  cv::Mat upper, lower, all;
  cv::hconcat(panels.data(), 3, upper);
  cv::hconcat(panels.data() + 3, 3, lower);
  cv::vconcat(upper, lower, all);
  return all;
}

}  // namespace hedgehop::avoidance::stereo_corridor
