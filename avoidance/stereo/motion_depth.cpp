#include "avoidance/stereo/motion_depth.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace hedgehop::avoidance::stereo {
namespace {

constexpr double kShortestM = 0.1;       // minimum baseline; the motion is less accurate than a tenth of it
constexpr double kShareOfNearest = 0.3;  // of the depth of the nearest surface; the plane sweep reaches 1.6 baselines
constexpr double kNearestShare = 0.02;   // share of the pixels that may be nearer
constexpr double kOldestS = 2.0;         // age of a key image: the error of the motion grows with time
constexpr double kVelocitySigmaMps = 0.02;  // of an estimate from a downward camera, steady over a baseline
constexpr double kTurnSigmaRadps = 1e-3;    // of the gyros less their estimated bias
constexpr double kMaxGrowth = 1.1;          // of the wanted baseline from image to image

}  // namespace

MotionDepth::MotionDepth(const MountedCamera& camera)
    : X_BC_(camera.X_BC), sweep_(camera.model.pinhole(), {}), wanted_m_(kShortestM) {}

void MotionDepth::move(const NavigationState& navigation, double t_s) {
  const Eigen::Vector3d v_WB_Wg = navigation.q_WB_gyro * navigation.v_WB_B_est;
  if (moved_s_) p_WgB_ += 0.5 * (t_s - *moved_s_) * (v_WB_Wg_ + v_WB_Wg);
  v_WB_Wg_ = v_WB_Wg;
  moved_s_ = t_s;
}

/// Returns the image whose distance is nearest to the wanted baseline; null if all are too near.
const MotionDepth::KeyImage* MotionDepth::choose_key(const Eigen::Isometry3d& X_WgC) const {
  const auto away_m = [&](const KeyImage& key) { return (key.X_WgC.translation() - X_WgC.translation()).norm(); };
  const KeyImage* best = nullptr;
  for (const KeyImage& key : keys_) {
    if (away_m(key) < kShortestM) continue;
    if (!best || std::abs(away_m(key) - wanted_m_) <= std::abs(away_m(*best) - wanted_m_)) best = &key;
  }
  return best;
}

void MotionDepth::adapt_baseline(const cv::Mat& per_m) {
  std::vector<float> matched;
  for (int v = 0; v < per_m.rows; ++v) {
    const auto* const row = per_m.ptr<float>(v);
    std::copy_if(row, row + per_m.cols, std::back_inserter(matched), [](float each) { return !std::isnan(each); });
  }
  if (matched.empty()) return;
  const auto nearest =
      matched.begin() + static_cast<std::ptrdiff_t>((1.0 - kNearestShare) * static_cast<double>(matched.size() - 1));
  std::nth_element(matched.begin(), nearest, matched.end());
  const double to_nearest_m = kShareOfNearest / std::max<double>(*nearest, 1e-3);
  wanted_m_ = std::clamp(std::min(to_nearest_m, kMaxGrowth * wanted_m_), kShortestM, kLongestM);
}

vision::motion::InverseDepth MotionDepth::update(const cv::Mat& grey, const NavigationState& navigation, double t_s) {
  move(navigation, t_s);
  while (!keys_.empty() && keys_.front().t_s < t_s - kOldestS) keys_.pop_front();
  const Eigen::Isometry3d X_WgC = Eigen::Translation3d(p_WgB_) * navigation.q_WB_gyro * X_BC_;
  const cv::Mat smooth = vision::motion::PlaneSweep::smooth(grey);
  const KeyImage* const key = choose_key(X_WgC);
  vision::motion::InverseDepth depth;
  if (key) {
    const Eigen::Isometry3d X_CCk = X_WgC.inverse() * key->X_WgC;
    const double apart_s = t_s - key->t_s;
    depth = sweep_.match(smooth, key->smooth,
                         {X_CCk.linear(), X_CCk.translation(), kVelocitySigmaMps * apart_s, kTurnSigmaRadps * apart_s});
    adapt_baseline(depth.per_m);
    baseline_m_ = X_CCk.translation().norm();
  } else {
    depth = sweep_.none();
    baseline_m_ = 0.0;
  }
  keys_.push_back({smooth, X_WgC, t_s});
  return depth;
}

}  // namespace hedgehop::avoidance::stereo
