#include "vision/landmarks/landmark_filter.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/fields/bounds.h"
#include "vision/landmarks/landmark_matching.h"
#include "vision/landmarks/published_filter.h"

namespace hedgehop::vision::landmarks {
namespace {

void check(const LandmarkMapConfig& c) {
  fields::require_bounds(c, "map");
  const auto need = [](bool holds, const char* message) {
    if (!holds) throw std::invalid_argument(std::string("landmark map: ") + message);
  };
  need(c.start.ground_sigma > 0.0, "ground_sigma must be above 0");
  need(c.start.nearest_m > 0.0 && c.start.beyond_horizon_m > 0.0, "nearest and beyond_horizon must be above 0 m");
  need(c.gate > 0.0, "gate must be above 0");
  need(c.misses >= 1, "misses must be at least 1");
}

/// Returns a pose with its uncertainty increased for correlated errors, so that all images within the correlation time
/// count as one measurement. The integral of an exponential correlation is twice its time constant.
CameraPose as_one_of_correlated(const CameraPose& pose, double correlation_s, double dt_s) {
  if (!(dt_s > 0.0)) return pose;
  const double times = std::sqrt(std::max(1.0, 2.0 * correlation_s / dt_s));
  return {pose.X_WC_est, times * pose.position_sigma_m, times * pose.attitude_sigma_rad};
}

/// Matches the confirmed landmarks first and the others with the remaining bearings. The Z value decreases with the
/// landmark's variance. A new landmark close to a confirmed one would otherwise take its bearings, until the confirmed
/// one is deleted as missed.
std::vector<std::optional<size_t>> match_confirmed_first(std::span<const std::optional<PredictedBearing>> predicted,
                                                         const std::vector<bool>& confirmed,
                                                         std::span<const Eigen::Vector2d> bearings, double gate) {
  std::vector<std::optional<PredictedBearing>> first(predicted.begin(), predicted.end()), then = first;
  for (size_t k = 0; k < predicted.size(); ++k) (confirmed[k] ? then : first)[k].reset();
  std::vector<std::optional<size_t>> landmark_of = match_landmarks(first, bearings, gate);
  std::vector<size_t> left;
  std::vector<Eigen::Vector2d> bearings_left;
  for (size_t i = 0; i < bearings.size(); ++i) {
    if (landmark_of[i]) continue;
    left.push_back(i);
    bearings_left.push_back(bearings[i]);
  }
  const auto of_left = match_landmarks(then, bearings_left, gate);
  for (size_t j = 0; j < left.size(); ++j) landmark_of[left[j]] = of_left[j];
  return landmark_of;
}

double max_variance(const Eigen::Matrix3d& P) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(P, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace

LandmarkMap::LandmarkMap(const LandmarkMapConfig& config, const camera::PinholeCamera& camera)
    : config_(config), camera_(camera), bearing_sigma_(config.pixel_sigma_px / camera.focal_x_px) {
  check(config);
}

std::vector<int64_t> LandmarkMap::update(std::span<const Eigen::Vector2d> corners_px, const CameraPose& pose,
                                         double dt_s) {
  std::vector<Eigen::Vector2d> bearings;
  for (const Eigen::Vector2d& corner : corners_px) bearings.push_back(camera_.ray_at_unit_depth(corner).head<2>());
  if (config_.algorithm == MapAlgorithm::modified) return update_as_modified(bearings, pose, dt_s);
  return update_as_published({bearing_sigma_, config_.drift_m_rt_s, config_.gate, config_.misses}, bearings, pose, dt_s,
                             landmarks_, next_id_);
}

std::vector<int64_t> LandmarkMap::update_as_modified(std::span<const Eigen::Vector2d> bearings, const CameraPose& pose,
                                                     double dt_s) {
  for (MappedLandmark& mapped : landmarks_) mapped.landmark = predicted(mapped.landmark, config_.drift_m_rt_s, dt_s);
  const Predictions at_estimate = predict(pose);
  const CameraPose better_pose =
      corrected(pose, common_error(at_estimate, bearings, error_covariance(pose), bearing_sigma_));
  const Predictions at_better = predict(as_one_of_correlated(better_pose, config_.correlation_s, dt_s));
  Predictions to_match = at_better;
  for (auto& one : to_match) {
    if (one) one = with_known_pose(*one, bearing_sigma_);
  }
  std::vector<bool> known;
  for (const MappedLandmark& mapped : landmarks_) known.push_back(confirmed(mapped));
  const auto landmark_of = match_confirmed_first(to_match, known, bearings, config_.gate);

  std::vector<bool> seen(landmarks_.size(), false);
  std::vector<int64_t> ids;
  for (size_t i = 0; i < bearings.size(); ++i) {
    if (const auto k = landmark_of[i]) {
      MappedLandmark& mapped = landmarks_[*k];
      if (at_estimate[*k]) {
        // Linearized at the corrected pose. At the estimated pose the Jacobian would share the pose error with the
        // residual, and flights over distances shorter than that error would seem to measure depth.
        PredictedBearing prediction = *at_better[*k];
        prediction.bearing = at_estimate[*k]->bearing;
        mapped.landmark = updated(mapped.landmark, prediction, bearings[i]);
      }
      ++mapped.matches;
      seen[*k] = true;
      ids.push_back(mapped.id);
    } else {
      landmarks_.push_back({next_id_++, first_seen(bearings[i], pose, bearing_sigma_, config_.start), 1, 0});
      seen.push_back(true);
      ids.push_back(landmarks_.back().id);
    }
  }
  drop_missed(pose, seen);
  return ids;
}

void LandmarkMap::refine(std::span<const AdjustedLandmark> adjusted) {
  for (const AdjustedLandmark& one : adjusted) {
    const auto mapped = std::ranges::find(landmarks_, one.id, &MappedLandmark::id);
    if (mapped == landmarks_.end()) continue;
    if (one.is_duplicate) {
      landmarks_.erase(mapped);
      continue;
    }
    mapped->landmark.coordinates = LandmarkCoordinates::cartesian;
    mapped->landmark.x = one.p_W;
    mapped->landmark.P = one.covariance_W;
    mapped->rejected = !one.is_point;
  }
}

/// Returns whether a landmark is kept although it is missed, because it is probably occluded: it was matched in at
/// least half of the images between its first and last match, and its position is well known.
bool LandmarkMap::is_persistent(const MappedLandmark& mapped) const {
  constexpr double kKnownSigmaM = 1.0;
  return confirmed(mapped) && mapped.matches >= mapped.passed_over &&
         max_variance(covariance_W(mapped.landmark)) <= kKnownSigmaM * kKnownSigmaM;
}

LandmarkMap::Predictions LandmarkMap::predict(const CameraPose& pose) const {
  Predictions predictions;
  for (const MappedLandmark& mapped : landmarks_) {
    predictions.push_back(predict_bearing(mapped.landmark, pose, bearing_sigma_));
  }
  return predictions;
}

/// Counts the images with a landmark in view but not matched, and deletes landmarks with too many of them.
void LandmarkMap::drop_missed(const CameraPose& pose, const std::vector<bool>& seen) {
  constexpr double kSureOfViewSigmas = 3.0;
  const Eigen::Isometry3d X_CW = pose.X_WC_est.inverse();
  const auto in_view = [&](const Landmark& landmark) {
    const auto pixel = camera_.project(X_CW * position_W(landmark));
    const auto bearing = predict_bearing(landmark, pose, bearing_sigma_);
    if (!pixel || !bearing) return false;
    const double margin_px = kSureOfViewSigmas * camera_.focal_x_px * std::sqrt(bearing->covariance.trace());
    return pixel->x() > margin_px && pixel->y() > margin_px && pixel->x() < camera_.width_px - 1 - margin_px &&
           pixel->y() < camera_.height_px - 1 - margin_px;
  };
  std::vector<MappedLandmark> kept;
  for (size_t k = 0; k < landmarks_.size(); ++k) {
    MappedLandmark& mapped = landmarks_[k];
    const bool missed = !seen[k] && in_view(mapped.landmark);
    if (seen[k]) mapped.passed_over += std::exchange(mapped.misses, 0);
    mapped.misses += missed;
    const int max_misses = confirmed(mapped) ? config_.misses : config_.unconfirmed_misses;
    if (mapped.misses < max_misses || is_persistent(mapped)) kept.push_back(mapped);
  }
  landmarks_ = std::move(kept);
}

}  // namespace hedgehop::vision::landmarks
