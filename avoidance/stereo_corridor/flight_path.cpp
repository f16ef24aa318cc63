#include "avoidance/stereo_corridor/flight_path.h"

#include <algorithm>

namespace hedgehop::avoidance::stereo_corridor {

Eigen::Vector3d FlightPath::ahead_W(const Eigen::Vector3d& p_WB, const Eigen::Vector3d& p_WG) {
  if (!leg_) leg_ = {p_WB, p_WG};
  if (leg_->to_W != p_WG) leg_ = {leg_->to_W, p_WG};
  const Eigen::Vector3d whole_W = leg_->to_W - leg_->from_W;
  const double length_m = whole_W.head<2>().norm();
  constexpr double kNoDirectionM = 1e-6;
  if (length_m < kNoDirectionM) return p_WG;
  const Eigen::Vector2d along_W = whole_W.head<2>() / length_m;
  const double ahead_m = (p_WB - leg_->from_W).head<2>().dot(along_W) + CorridorSearch::kLookAheadM;
  const double share = std::clamp(ahead_m / length_m, 0.0, 1.0);
  Eigen::Vector3d ahead_W = leg_->from_W + share * whole_W;
  ahead_W.head<2>() = leg_->from_W.head<2>() + ahead_m * along_W;
  return ahead_W;
}

std::optional<Target> keep_path(CorridorSearch& search, const Eigen::Vector3d& path_C,
                                const std::optional<cv::Point>& followed) {
  return search.pixel_of(path_C) ? search.join(path_C, followed) : search.anywhere(path_C);
}

}  // namespace hedgehop::avoidance::stereo_corridor
