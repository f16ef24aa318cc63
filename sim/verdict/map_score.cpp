#include "sim/verdict/map_score.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "sim/verdict/assignment.h"
#include "sim/verdict/map_alignment.h"

namespace hedgehop::sim {
namespace {

constexpr double kConvergedPercent = 3.0, kUnmatchedPercent = 100.0, kCompleteShare = 0.9;

/// Updates the time since which a condition holds; NaN while it does not.
void update_since(double& since_s, bool holds, double t_s) {
  if (!holds) {
    since_s = NAN;
  } else if (std::isnan(since_s)) {
    since_s = t_s;
  }
}

}  // namespace

MapScore::MapScore(std::vector<Eigen::Vector3d> corners_W, const Eigen::Vector3d& p_start_W, double tolerance_m)
    : corners_W_(std::move(corners_W)),
      tolerance_m_(tolerance_m),
      seen_s_(corners_W_.size(), 0.0),
      is_found_(corners_W_.size(), false) {
  for (const Eigen::Vector3d& p_W : corners_W_) distances_m_.push_back((p_W - p_start_W).norm());
}

double MapScore::error_percent(size_t corner, const Eigen::Vector3d& p_W) const {
  return 100.0 * (p_W - corners_W_[corner]).cwiseAbs().mean() / distances_m_[corner];
}

void MapScore::add(double t_s, std::span<const Eigen::Vector3d> map_W, const std::vector<bool>& in_sight) {
  had_points_ = had_points_ || !map_W.empty();
  map_W_.assign(map_W.begin(), map_W.end());
  const std::vector<std::optional<Eigen::Index>> matches = match_points(corners_W_, map_W, tolerance_m_);
  double sum_percent = 0.0, found = 0.0;
  seen_count_ = 0;
  is_true_.assign(map_W.size(), false);
  for (size_t corner = 0; corner < corners_W_.size(); ++corner) {
    double percent = kUnmatchedPercent;
    is_found_[corner] = matches[corner].has_value();
    if (is_found_[corner]) {
      const auto point = static_cast<size_t>(*matches[corner]);
      is_true_[point] = true;
      percent = error_percent(corner, map_W[point]);
    }
    if (in_sight[corner]) seen_s_[corner] += t_s - last_t_s_;
    if (!counts(corner)) continue;
    ++seen_count_;
    sum_percent += percent;
    found += is_found_[corner] ? 1.0 : 0.0;
  }
  last_t_s_ = t_s;
  error_percent_ = seen_count_ > 0 ? sum_percent / seen_count_ : kUnmatchedPercent;
  recall_ = seen_count_ > 0 ? found / seen_count_ : 0.0;
  count_false(map_W);
  update_since(converged_s_, error_percent_ <= kConvergedPercent, t_s);
  update_since(complete_s_, recall_ >= kCompleteShare && precision_ >= kCompleteShare, t_s);
}

void MapScore::count_false(std::span<const Eigen::Vector3d> map_W) {
  false_count_ = false_on_ground_ = 0;
  for (size_t i = 0; i < map_W.size(); ++i) {
    if (is_true_[i]) continue;
    ++false_count_;
    false_on_ground_ += std::abs(map_W[i].z()) <= tolerance_m_ ? 1 : 0;
  }
  const auto points = static_cast<double>(map_W.size());
  precision_ = map_W.empty() ? 0.0 : (points - false_count_) / points;
}

std::vector<RecordedCorner> MapScore::corners() const {
  std::vector<RecordedCorner> corners;
  for (size_t i = 0; i < corners_W_.size(); ++i) {
    corners.push_back({corners_W_[i], counts(i), is_found_[i]});
  }
  return corners;
}

void MapScore::complete(MapRecord& map) const {
  for (size_t i = 0; i < map.points.size(); ++i) map.points[i].is_true = is_true_[i];
  if (!map.empty()) map.corners = corners();
}

std::vector<MetricValue> MapScore::metrics() const {
  if (!had_points_) return {};
  std::vector<MetricValue> metrics{{"corners_seen", static_cast<double>(seen_count_), ""},
                                   {"corners_found", recall_, ""},
                                   {"map_precision", precision_, ""},
                                   {"map_tolerance_m", tolerance_m_, "m"},
                                   {"map_complete_s", complete_s_, "s"},
                                   {"map_error_percent", error_percent_, "%"},
                                   {"converged_s", converged_s_, "s"},
                                   {"false_landmarks", static_cast<double>(false_count_), ""},
                                   {"false_on_ground", static_cast<double>(false_on_ground_), ""}};
  std::ranges::move(aligned_metrics(), std::back_inserter(metrics));
  return metrics;
}

std::vector<MetricValue> MapScore::aligned_metrics() const {
  double recall = NAN, precision = NAN, shift_m = NAN;
  if (const auto X = align_map(corners_W_, map_W_, tolerance_m_)) {
    const auto points = static_cast<double>(map_W_.size());
    std::vector<Eigen::Vector3d> aligned_W;
    shift_m = 0.0;
    for (const Eigen::Vector3d& p_W : map_W_) {
      aligned_W.emplace_back(*X * p_W);
      shift_m += (aligned_W.back() - p_W).norm() / points;
    }
    const auto matches = match_points(corners_W_, aligned_W, tolerance_m_);
    double matched = 0.0, found = 0.0;
    for (size_t corner = 0; corner < matches.size(); ++corner) {
      if (!matches[corner]) continue;
      matched += 1.0;
      found += counts(corner) ? 1.0 : 0.0;
    }
    recall = seen_count_ > 0 ? found / seen_count_ : 0.0;
    precision = matched / points;
  }
  return {
      {"aligned_corners_found", recall, ""}, {"aligned_map_precision", precision, ""}, {"map_shift_m", shift_m, "m"}};
}

namespace {

bool in_image(const vision::camera::Camera& camera, const Eigen::Isometry3d& X_WC, const Eigen::Vector3d& p_W) {
  const auto pixel = camera.project(X_WC.inverse() * p_W);
  return pixel && pixel->x() >= 0.0 && pixel->y() >= 0.0 && pixel->x() <= camera.width_px - 1 &&
         pixel->y() <= camera.height_px - 1;
}

bool is_unobstructed(const CollisionWorld& world, const Eigen::Vector3d& p_WC, const Eigen::Vector3d& p_W, double t_s) {
  constexpr double kOwnSurfaceM = 0.1;  // the ray may meet the surface of the corner slightly before it
  const Eigen::Vector3d ray_W = p_W - p_WC;
  const double distance_m = ray_W.norm();
  if (distance_m <= kOwnSurfaceM) return true;
  return world.distance_along(p_WC, ray_W / distance_m, distance_m, t_s) >= distance_m - kOwnSurfaceM;
}

}  // namespace

std::vector<bool> corners_in_sight(std::span<const Eigen::Vector3d> corners_W, const vision::camera::Camera& camera,
                                   const Eigen::Isometry3d& X_WC, const CollisionWorld* world, double t_s) {
  std::vector<bool> seen;
  for (const Eigen::Vector3d& p_W : corners_W) {
    seen.push_back(in_image(camera, X_WC, p_W) && (!world || is_unobstructed(*world, X_WC.translation(), p_W, t_s)));
  }
  return seen;
}

}  // namespace hedgehop::sim
