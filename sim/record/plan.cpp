#include "sim/record/plan.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace hedgehop::sim {
namespace {

Footprint footprint(const scenes::Solid& solid) {
  std::vector<cv::Point2f> corners;
  Eigen::AlignedBox<double, 1> altitude_m;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    const Eigen::Vector3d p_W = solid.X_WS * solid.half_extents_m.cwiseProduct(sign);
    corners.emplace_back(static_cast<float>(p_W.x()), static_cast<float>(p_W.y()));
    altitude_m.extend(Eigen::Matrix<double, 1, 1>(-p_W.z()));
  }
  std::vector<cv::Point2f> outline;
  cv::convexHull(corners, outline);

  Footprint result{.name = solid.name, .bottom_m = altitude_m.min()[0], .top_m = altitude_m.max()[0]};
  for (const cv::Point2f& p : outline) result.corners_NE_m.emplace_back(p.x, p.y);
  return result;
}

}  // namespace

std::vector<Footprint> footprints(const std::vector<scenes::Solid>& solids) {
  std::vector<Footprint> result;
  result.reserve(solids.size());
  std::ranges::transform(solids, std::back_inserter(result), footprint);
  return result;
}

Level level(const Footprint& footprint, double lowest_m, double highest_m, double margin_m) {
  if (footprint.top_m < lowest_m - margin_m) return Level::below;
  if (footprint.bottom_m > highest_m + margin_m) return Level::above;
  return Level::beside;
}

}  // namespace hedgehop::sim
