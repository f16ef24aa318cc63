#include "sim/mavlink/sector_source.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "vision/stereo/disparity.h"

namespace hedgehop::sim::mavlink {
namespace {

using avoidance::CameraNeed;
using avoidance::MountedCamera;
using avoidance::stereo::DisparitySource;

int reduction_of(const MountedCamera& camera) {
  return std::max(1, camera.model.width_px / SectorSource::kStereoWidthPx);
}

/// Returns the camera whose images are those of a pinhole, reduced by a factor.
MountedCamera reduced(MountedCamera camera, int factor) {
  vision::camera::PinholeCamera lens = camera.model.pinhole();
  lens.width_px /= factor;
  lens.height_px /= factor;
  lens.focal_x_px /= factor;
  lens.focal_y_px /= factor;
  lens.center_u_px = (lens.center_u_px + 0.5) / factor - 0.5;
  lens.center_v_px = (lens.center_v_px + 0.5) / factor - 0.5;
  camera.model = lens;
  return camera;
}

bool is_parallel_pair(const MountedCamera& left, const MountedCamera& right) {
  constexpr double kParallelRad = 1e-6;  // the side cameras of other rigs are called left and right, too
  const Eigen::Isometry3d X_CCr = left.X_BC.inverse() * right.X_BC;
  return left.model.is_undistorted_pinhole() && right.model.is_undistorted_pinhole() &&
         Eigen::AngleAxisd(X_CCr.linear()).angle() < kParallelRad;
}

}  // namespace

SectorSource::SectorSource(const MountedCamera& depth, const SectorLimits& limits)
    : role_(depth.role), to_sectors_(depth.model, depth.X_BC, limits) {}

SectorSource::SectorSource(const std::string& pair, const MountedCamera& left, const MountedCamera& right,
                           const vision::stereo::StereoMatcherConfig& config, const SectorLimits& limits)
    : role_(left.role),
      right_role_(right.role),
      reduction_(reduction_of(left)),
      to_sectors_(reduced(left, reduction_).model, left.X_BC, limits) {
  avoidance::Setup setup;
  setup.cameras = {reduced(left, reduction_), reduced(right, reduction_)};
  stereo_.emplace(DisparitySource::From::stereo, DisparitySource::Grey::unused, config, setup, pair);
}

void SectorSource::update(int64_t t_ns, const avoidance::Observation& observation) {
  constexpr int64_t kJitterNs = 1'000'000;
  if (seen_ns_ && t_ns - *seen_ns_ < kPeriodNs - kJitterNs) return;
  const avoidance::CameraFrame* const frame = find_frame(observation.frames, role_);
  if (!frame) return;
  const cv::Mat* const depth_m = stereo_ ? depth_of_pair(observation) : &frame->image;
  if (!depth_m) return;
  sectors_ = to_sectors_.sectors(*depth_m, observation.navigation.q_WB_est);
  seen_ns_ = t_ns;
}

const ObstacleSectors* SectorSource::sectors(int64_t t_ns) const {
  constexpr int64_t kLastNs = 500'000'000;
  return seen_ns_ && t_ns - *seen_ns_ <= kLastNs ? &sectors_ : nullptr;
}

/// Returns the depth of the reduced left image; null without a new pair.
const cv::Mat* SectorSource::depth_of_pair(const avoidance::Observation& observation) {
  // As in avoidance/local_map: segments of fewer pixels are mismatches.
  constexpr int kSpeckDifference16 = 32, kSpeckPixels = 100;
  const avoidance::CameraFrame *left = find_frame(observation.frames, role_),
                               *right = find_frame(observation.frames, right_role_);
  if (!left || !right) return nullptr;
  std::array frames = {*left, *right};
  for (avoidance::CameraFrame& frame : frames) {
    cv::Mat small;
    cv::resize(frame.image, small, frame.image.size() / reduction_, 0.0, 0.0, cv::INTER_AREA);
    frame.image = small;
  }
  if (!stereo_->update(frames)) return nullptr;
  vision::stereo::remove_specks(stereo_->disparity16(), kSpeckDifference16, kSpeckPixels / (reduction_ * reduction_));
  vision::stereo::to_depth(stereo_->disparity16(), stereo_->geometry(), depth_m_);
  return &depth_m_;
}

std::vector<SectorSource> sector_sources(const PerceptionConfig& config, const avoidance::Needs& needs,
                                         const avoidance::Setup& setup, const SectorLimits& limits) {
  std::vector<SectorSource> sources;
  const std::string left_end = DisparitySource::kLeft, right_end = DisparitySource::kRight;
  const auto has_grey = [&](const std::string& role) {
    return std::ranges::any_of(needs.cameras, [&](const CameraNeed& need) {
      return need.role == role && need.channel == CameraNeed::Channel::grey;
    });
  };
  for (const CameraNeed& need : needs.cameras) {
    if (need.channel == CameraNeed::Channel::depth) sources.emplace_back(required_camera(setup, need.role), limits);
    if (!has_grey(need.role) || !need.role.ends_with(left_end)) continue;
    const std::string prefix = need.role.substr(0, need.role.size() - left_end.size());
    const std::string right_role = prefix + right_end;
    if ((!prefix.empty() && !prefix.ends_with("_")) || !has_grey(right_role)) continue;
    const MountedCamera &left = required_camera(setup, need.role), &right = required_camera(setup, right_role);
    if (!is_parallel_pair(left, right)) continue;
    sources.emplace_back(prefix.substr(0, prefix.empty() ? 0 : prefix.size() - 1), left, right, config.stereo, limits);
  }
  return sources;
}

}  // namespace hedgehop::sim::mavlink
