#include "vision/landmarks/landmark_bundle.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>
#include <utility>

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr size_t kMinKeyframes = 6;         // of a landmark in the adjustment
constexpr size_t kMaxLandmarks = 80;        // bounds the cost of one adjustment; those in the most keyframes are kept
constexpr int kIterations = 5;              // of one adjustment, which begins at the result of the last one
constexpr double kMaxResidualSigmas = 3.0;  // root mean square over both axes, of a point
// Difference between the estimates from two parts of the flight. Errors of successive images are alike, so true corners
// differ by up to 13.
constexpr double kMaxPartsSigmas = 15.0;

/// A point estimated from a part of its bearings, with known poses.
struct PartEstimate {
  Vector3d p_W = Vector3d::Zero();
  Matrix3d information = Matrix3d::Zero();
};

}  // namespace

LandmarkBundle::LandmarkBundle(const Isometry3d& X_BC, const BundleNoise& noise, double correlation_s)
    : X_BC_(X_BC), noise_(noise), correlation_s_(correlation_s) {}

void LandmarkBundle::add(const NavigationSample& navigation, double dt_s, std::span<const Eigen::Vector2d> bearings,
                         std::span<const int64_t> ids) {
  const bool first = keyframes_.empty();
  if (!first) step_W_ += 0.5 * dt_s * (last_.v_W + navigation.v_W);
  since_keyframe_s_ += dt_s;
  last_ = navigation;
  constexpr double kRoundingS = 1e-6;
  if (!first && since_keyframe_s_ < kKeyframeS - kRoundingS) return;

  Keyframe key;
  key.frame.X_WB = key.frame.X_WB_nav = navigation.X_WB;
  if (!first) {
    key.frame.step_W = step_W_;
    key.frame.turn_B = last_key_.R_gyro.transpose() * navigation.R_gyro;
    key.frame.dt_s = since_keyframe_s_;
    const Isometry3d& before = keyframes_.back().frame.X_WB;
    key.frame.X_WB.translation() = before.translation() + step_W_;
    key.frame.X_WB.linear() = before.linear() * key.frame.turn_B;
  }
  for (size_t i = 0; i < ids.size(); ++i) key.seen.push_back({ids[i], bearings[i]});
  keyframes_.push_back(std::move(key));
  if (keyframes_.size() > kMaxKeyframes) halve();
  last_key_ = navigation;
  step_W_.setZero();
  since_keyframe_s_ = 0.0;
  ++since_adjusted_;
}

/// Drops every second keyframe and joins the displacements and rotations.
void LandmarkBundle::halve() {
  std::vector<Keyframe> kept = {std::move(keyframes_.front())};
  for (size_t k = 2; k < keyframes_.size(); k += 2) {
    const BundleFrame& dropped = keyframes_[k - 1].frame;
    Keyframe key = std::move(keyframes_[k]);
    key.frame.step_W += dropped.step_W;
    key.frame.turn_B = (dropped.turn_B * key.frame.turn_B).eval();
    key.frame.dt_s += dropped.dt_s;
    kept.push_back(std::move(key));
  }
  keyframes_ = std::move(kept);
}

/// Prepares the frames and points of an adjustment.
void LandmarkBundle::select(std::span<const MappedLandmark> landmarks) {
  struct Candidate {
    int64_t id = 0;
    Vector3d p_W = Vector3d::Zero();
    size_t keyframes = 0;
  };
  std::vector<Candidate> candidates;
  for (const MappedLandmark& mapped : landmarks) {
    Candidate candidate{mapped.id, position_W(mapped.landmark), 0};
    bool in_front = true;
    for (const Keyframe& key : keyframes_) {
      if (std::ranges::find(key.seen, mapped.id, &Seen::id) == key.seen.end()) continue;
      ++candidate.keyframes;
      in_front = in_front && project_point(candidate.p_W, key.frame.X_WB, X_BC_).depth_m > kMinBundleDepthM;
    }
    if (candidate.keyframes >= kMinKeyframes && in_front) candidates.push_back(candidate);
  }
  if (candidates.size() > kMaxLandmarks) {
    std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::keyframes);
    candidates.resize(kMaxLandmarks);
    std::ranges::sort(candidates, {}, &Candidate::id);
  }
  frames_.clear();
  points_W_.clear();
  ids_.clear();
  for (const Candidate& candidate : candidates) {
    points_W_.push_back(candidate.p_W);
    ids_.push_back(candidate.id);
  }
  for (const Keyframe& key : keyframes_) {
    frames_.push_back(key.frame);
    for (const Seen& seen : key.seen) {
      const auto id = std::ranges::lower_bound(ids_, seen.id);
      if (id == ids_.end() || *id != seen.id) continue;
      frames_.back().bearings.push_back({static_cast<size_t>(id - ids_.begin()), seen.bearing});
    }
  }
}

std::vector<AdjustedLandmark> LandmarkBundle::adjust(std::span<const MappedLandmark> landmarks) {
  since_adjusted_ = 0;
  select(landmarks);
  if (points_W_.empty()) return {};
  BundleNoise noise = noise_;
  const double span_s = keyframes_.back().frame.dt_s;
  if (span_s > 0.0) {
    const double times = std::sqrt(std::max(1.0, 2.0 * correlation_s_ / span_s));
    noise.position_m *= times;
    noise.attitude_rad *= times;
  }
  const BundleResult result = adjust_bundle(frames_, points_W_, X_BC_, noise, kIterations);
  for (size_t k = 0; k < frames_.size(); ++k) keyframes_[k].frame.X_WB = frames_[k].X_WB;
  std::vector<AdjustedLandmark> adjusted;
  for (size_t i = 0; i < points_W_.size(); ++i) {
    adjusted.push_back({ids_[i], points_W_[i], result.covariances_W[i], is_consistent(i)});
  }
  merge(adjusted);
  return adjusted;
}

/// Returns whether the residuals of a point are small, and whether the first and the second half of its bearings
/// place it alike. If one edge hides the end of another, the apparent corner moves along an edge with the camera.
bool LandmarkBundle::is_consistent(size_t point) const {
  struct Term {
    Matrix3d information;
    Vector3d right;
  };
  std::vector<Term> terms;
  double squares = 0.0;
  const double weight = 1.0 / (noise_.bearing * noise_.bearing);
  for (const BundleFrame& frame : frames_) {
    for (const BundleBearing& seen : frame.bearings) {
      if (seen.point != point) continue;
      const BundleProjection at = project_point(points_W_[point], frame.X_WB, X_BC_);
      const Eigen::Vector2d residual = seen.bearing - at.bearing;
      squares += weight * residual.squaredNorm();
      terms.push_back({weight * at.d_point.transpose() * at.d_point, weight * at.d_point.transpose() * residual});
    }
  }
  const auto count = static_cast<double>(terms.size());
  if (squares > kMaxResidualSigmas * kMaxResidualSigmas * count) return false;
  // One step of least squares from the common estimate, for each half.
  const auto part = [&](size_t from, size_t to) {
    PartEstimate estimate;
    Vector3d right = Vector3d::Zero();
    for (size_t k = from; k < to; ++k) {
      estimate.information += terms[k].information;
      right += terms[k].right;
    }
    estimate.p_W = estimate.information.inverse() * right;
    return estimate;
  };
  const size_t middle = terms.size() / 2;
  const PartEstimate first = part(0, middle), second = part(middle, terms.size());
  const Matrix3d covariance = first.information.inverse() + second.information.inverse();
  const Vector3d difference_W = second.p_W - first.p_W;
  const double sigmas2 = difference_W.dot(covariance.inverse() * difference_W);
  return sigmas2 <= kMaxPartsSigmas * kMaxPartsSigmas;
}

bool LandmarkBundle::in_one_image(int64_t a, int64_t b) const {
  return std::ranges::any_of(keyframes_, [&](const Keyframe& key) {
    return std::ranges::find(key.seen, a, &Seen::id) != key.seen.end() &&
           std::ranges::find(key.seen, b, &Seen::id) != key.seen.end();
  });
}

/// Joins landmarks that are at one place but never in one image: one corner that was lost and found again.
void LandmarkBundle::merge(std::vector<AdjustedLandmark>& adjusted) {
  constexpr double kSameM = 0.5;
  for (size_t j = 1; j < adjusted.size(); ++j) {
    for (size_t i = 0; i < j && !adjusted[j].is_duplicate; ++i) {
      if (adjusted[i].is_duplicate || (adjusted[i].p_W - adjusted[j].p_W).norm() > kSameM) continue;
      if (in_one_image(adjusted[i].id, adjusted[j].id)) continue;
      adjusted[j].is_duplicate = true;
      for (Keyframe& key : keyframes_) {
        for (Seen& seen : key.seen) {
          if (seen.id == adjusted[j].id) seen.id = adjusted[i].id;
        }
      }
    }
  }
}

}  // namespace hedgehop::vision::landmarks
