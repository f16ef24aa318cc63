#include "sim/loop/map_score.h"

#include <algorithm>

namespace hedgehop::sim {
namespace {

constexpr double kConverged_percent = 3.0, kNothing_percent = 100.0;

}  // namespace

MapScore::MapScore(std::vector<Eigen::Vector3d> corners_W, const Eigen::Vector3d& p_start_W) {
  for (const Eigen::Vector3d& p_W : corners_W) corners_.push_back({p_W, (p_W - p_start_W).norm()});
}

double MapScore::error_percent(const Corner& corner, const Eigen::Vector3d& p_W) const {
  return 100.0 * (p_W - corner.p_W).cwiseAbs().mean() / corner.distance_m;
}

void MapScore::add(double t_s, std::span<const Eigen::Vector3d> map_W) {
  ever_ = ever_ || !map_W.empty();
  double sum = 0.0, found = 0.0;
  for (const Corner& corner : corners_) {
    double least = kNothing_percent;
    for (const Eigen::Vector3d& p_W : map_W) least = std::min(least, error_percent(corner, p_W));
    sum += least;
    found += least <= kConverged_percent;
  }
  const double count = static_cast<double>(corners_.size());
  error_percent_ = sum / count;
  found_ = found / count;
  if (error_percent_ > kConverged_percent) {
    converged_s_ = NAN;
  } else if (std::isnan(converged_s_)) {
    converged_s_ = t_s;
  }
  false_count_ = static_cast<int>(std::ranges::count_if(map_W, [&](const Eigen::Vector3d& p_W) {
    return std::ranges::none_of(corners_,
                                [&](const Corner& corner) { return error_percent(corner, p_W) <= kConverged_percent; });
  }));
  false_share_ = map_W.empty() ? 0.0 : false_count_ / static_cast<double>(map_W.size());
}

std::vector<MetricValue> MapScore::metrics() const {
  if (!ever_) return {};
  return {{"map_error_percent", error_percent_, "%"},
          {"converged_s", converged_s_, "s"},
          {"corners_found", found_, ""},
          {"false_landmarks", static_cast<double>(false_count_), ""},
          {"false_share", false_share_, ""}};
}

}  // namespace hedgehop::sim
