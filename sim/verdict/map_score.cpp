#include "sim/verdict/map_score.h"

#include <algorithm>
#include <utility>

namespace hedgehop::sim {
namespace {

constexpr double kConvergedPercent = 3.0, kNothingPercent = 100.0, kCountsS = 10.0;

}  // namespace

MapScore::MapScore(std::vector<Eigen::Vector3d> corners_W, const Eigen::Vector3d& p_start_W)
    : corners_W_(std::move(corners_W)), seen_s_(corners_W_.size(), 0.0), is_found_(corners_W_.size(), false) {
  for (const Eigen::Vector3d& p_W : corners_W_) distances_m_.push_back((p_W - p_start_W).norm());
}

double MapScore::error_percent(size_t corner, const Eigen::Vector3d& p_W) const {
  return 100.0 * (p_W - corners_W_[corner]).cwiseAbs().mean() / distances_m_[corner];
}

void MapScore::add(double t_s, std::span<const Eigen::Vector3d> map_W, const std::vector<bool>& in_sight) {
  ever_ = ever_ || !map_W.empty();
  double sum = 0.0, found = 0.0;
  seen_count_ = 0;
  is_true_.assign(map_W.size(), false);
  for (size_t corner = 0; corner < corners_W_.size(); ++corner) {
    double least = kNothingPercent;
    for (size_t i = 0; i < map_W.size(); ++i) {
      const double percent = error_percent(corner, map_W[i]);
      least = std::min(least, percent);
      if (percent <= kConvergedPercent) is_true_[i] = true;
    }
    is_found_[corner] = least <= kConvergedPercent;
    if (in_sight[corner]) seen_s_[corner] += t_s - last_t_s_;
    if (seen_s_[corner] < kCountsS) continue;
    ++seen_count_;
    sum += least;
    found += least <= kConvergedPercent;
  }
  last_t_s_ = t_s;
  const double count = std::max(1, seen_count_);
  error_percent_ = seen_count_ > 0 ? sum / count : kNothingPercent;
  found_ = found / count;
  if (error_percent_ > kConvergedPercent) {
    converged_s_ = NAN;
  } else if (std::isnan(converged_s_)) {
    converged_s_ = t_s;
  }

  const double height_m = 0.01 * kConvergedPercent * *std::ranges::min_element(distances_m_);
  false_count_ = false_on_ground_ = 0;
  for (size_t i = 0; i < map_W.size(); ++i) {
    if (is_true_[i]) continue;
    ++false_count_;
    false_on_ground_ += std::abs(map_W[i].z()) <= height_m;
  }
  false_share_ = map_W.empty() ? 0.0 : false_count_ / static_cast<double>(map_W.size());
}

std::vector<RecordedCorner> MapScore::corners() const {
  std::vector<RecordedCorner> corners;
  for (size_t i = 0; i < corners_W_.size(); ++i) {
    corners.push_back({corners_W_[i], seen_s_[i] >= kCountsS, is_found_[i]});
  }
  return corners;
}

void MapScore::complete(MapRecord& map) const {
  for (size_t i = 0; i < map.points.size(); ++i) map.points[i].is_true = is_true_[i];
  if (!map.empty()) map.corners = corners();
}

std::vector<MetricValue> MapScore::metrics() const {
  if (!ever_) return {};
  return {{"map_error_percent", error_percent_, "%"},
          {"converged_s", converged_s_, "s"},
          {"corners_seen", static_cast<double>(seen_count_), ""},
          {"corners_found", found_, ""},
          {"false_landmarks", static_cast<double>(false_count_), ""},
          {"false_on_ground", static_cast<double>(false_on_ground_), ""},
          {"false_share", false_share_, ""}};
}

}  // namespace hedgehop::sim
