#include "avoidance/stereo/disparity_source.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace hedgehop::avoidance::stereo {
namespace {

constexpr bool kPinhole = true;
constexpr float kMaxSigmaPerM = 0.1F;  // of depth from motion, 1/m; free space then ends nearer than 5 m

std::string role_of(const std::string& pair, const char* role) { return pair.empty() ? role : pair + "_" + role; }

void require_one_rate(const MountedCamera& a, const MountedCamera& b) {
  if (a.rate_hz == b.rate_hz) return;
  throw std::invalid_argument("cameras '" + a.role + "' and '" + b.role + "' need one rate");
}

bool is_parallel(const Eigen::Isometry3d& X_CCr) {
  constexpr double kNoTurn = 1e-9;
  return (X_CCr.linear() - Eigen::Matrix3d::Identity()).norm() < kNoTurn;
}

constexpr double kNoOffsetM = 1e-6;

vision::stereo::StereoGeometry geometry_of_pair(const MountedCamera& left, const MountedCamera& right) {
  const vision::camera::PinholeCamera a = left.model.pinhole();
  const Eigen::Isometry3d X_CCr = left.X_BC.inverse() * right.X_BC;
  const bool beside = X_CCr.translation().tail<2>().norm() < kNoOffsetM && X_CCr.translation().x() > 0.0;
  if (!(left.model == right.model) || !is_parallel(X_CCr) || !beside || a.focal_x_px != a.focal_y_px) {
    throw std::invalid_argument("cameras '" + left.role + "' and '" + right.role +
                                "' must be equal pinholes with square pixels, parallel, the second to the right of the "
                                "first");
  }
  require_one_rate(left, right);
  return {a.focal_x_px, a.center_u_px, a.center_v_px, X_CCr.translation().x()};
}

void require_one_view(const MountedCamera& grey, const MountedCamera& depth) {
  const Eigen::Isometry3d X_CCd = grey.X_BC.inverse() * depth.X_BC;
  if (!(grey.model == depth.model) || !is_parallel(X_CCd) || X_CCd.translation().norm() > kNoOffsetM) {
    throw std::invalid_argument("cameras '" + grey.role + "' and '" + depth.role + "' must have one lens and one pose");
  }
  require_one_rate(grey, depth);
}

}  // namespace

Needs DisparitySource::needs(From from, Grey grey, const std::string& pair) {
  using Channel = CameraNeed::Channel;
  const CameraNeed left{role_of(pair, kLeft), Channel::grey, kPinhole};
  const CameraNeed depth{role_of(pair, kDepth), Channel::depth, kPinhole};
  if (from == From::motion) return {{{role_of(pair, kFront), Channel::grey, kPinhole}}};
  if (from == From::stereo) return {{left, {role_of(pair, kRight), Channel::grey, kPinhole}}};
  if (grey == Grey::unused) return {{depth}};
  return {{left, depth}};
}

DisparitySource::DisparitySource(From from, Grey grey, const vision::stereo::StereoMatcherConfig& config,
                                 const Setup& setup, const std::string& pair)
    : from_(from),
      grey_use_(grey),
      left_(role_of(pair, kLeft)),
      right_(role_of(pair, kRight)),
      depth_(role_of(pair, kDepth)),
      front_(role_of(pair, kFront)),
      matcher_(config) {
  const MountedCamera& camera = required_camera(setup, from == From::stereo   ? left_
                                                       : from == From::motion ? front_
                                                                              : depth_);
  if (from == From::stereo) {
    geometry_ = geometry_of_pair(camera, required_camera(setup, right_));
  } else {
    if (from == From::motion) motion_.emplace(camera);
    const vision::camera::PinholeCamera lens = camera.model.pinhole();
    geometry_ = {lens.focal_x_px, lens.center_u_px, lens.center_v_px, kBaselineM};
    if (from == From::camera && grey == Grey::needed) require_one_view(required_camera(setup, left_), camera);
  }
  X_BC_ = camera.X_BC;
  image_ = {camera.model.width_px, camera.model.height_px};
}

bool DisparitySource::update(std::span<const CameraFrame> frames, const NavigationState& navigation) {
  if (from_ == From::motion) return compare(frames, navigation);
  return from_ == From::stereo ? match(frames) : convert(frames);
}

bool DisparitySource::match(std::span<const CameraFrame> frames) {
  const CameraFrame *left = find_frame(frames, left_), *right = find_frame(frames, right_);
  if (!left || !right || left->t_ns != right->t_ns || left->t_ns <= t_ns_) return false;
  t_ns_ = left->t_ns;
  left->image.copyTo(grey_);
  right->image.copyTo(right_grey_);
  matcher_.match(left->image, right->image, disparity16_);
  return true;
}

bool DisparitySource::convert(std::span<const CameraFrame> frames) {
  const CameraFrame *depth = find_frame(frames, depth_), *left = find_frame(frames, left_);
  if (!depth || depth->t_ns <= t_ns_) return false;
  if (grey_use_ == Grey::needed) {
    if (!left || left->t_ns != depth->t_ns) return false;
    left->image.copyTo(grey_);
  }
  t_ns_ = depth->t_ns;
  depth->image.copyTo(depth_m_);
  cv::Mat disparity;
  cv::divide(geometry_.disparity16(1.0), depth_m_, disparity);         // 0 if the depth is infinite
  disparity.setTo(vision::stereo::kNoDisparity, ~(disparity >= 0.0));  // NaN compares false
  disparity.convertTo(disparity16_, CV_16S);
  return true;
}

bool DisparitySource::compare(std::span<const CameraFrame> frames, const NavigationState& navigation) {
  const CameraFrame* front = find_frame(frames, front_);
  if (!front || front->t_ns <= t_ns_) return false;
  t_ns_ = front->t_ns;
  front->image.copyTo(grey_);
  const vision::motion::InverseDepth depth = motion_->update(front->image, navigation, 1e-9 * t_ns_);
  // Each pixel of the reduced depth covers four of the image.
  disparity16_.create(image_, CV_16SC1);
  sigma16_.create(image_, CV_16SC1);
  constexpr int kReduction = vision::motion::PlaneSweep::kReduction;
  const auto units = static_cast<float>(geometry_.disparity16(1.0));
  for (int v = 0; v < image_.height; ++v) {
    const auto* const per_m = depth.per_m.ptr<float>(v / kReduction);
    const auto* const sigma_per_m = depth.sigma_per_m.ptr<float>(v / kReduction);
    for (int u = 0; u < image_.width; ++u) {
      const float sigma = sigma_per_m[u / kReduction];
      const bool known = sigma <= kMaxSigmaPerM;
      disparity16_.at<int16_t>(v, u) =
          known ? static_cast<int16_t>(std::lround(units * per_m[u / kReduction])) : vision::stereo::kNoDisparity;
      sigma16_.at<int16_t>(v, u) = known ? static_cast<int16_t>(std::ceil(units * sigma)) : int16_t{0};
    }
  }
  return true;
}

}  // namespace hedgehop::avoidance::stereo
