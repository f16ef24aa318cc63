#include "sim/loop/cameras.h"

#include <fmt/format.h>

#include <stdexcept>

namespace hedgehop::sim {
namespace {

Channel to_render_channel(CameraConfig::Channel channel) {
  switch (channel) {
    case CameraConfig::Channel::grey:
      return Channel::grey;
    case CameraConfig::Channel::color:
      return Channel::color;
    case CameraConfig::Channel::depth:
      return Channel::depth;
  }
  throw std::logic_error("unknown channel");
}

}  // namespace

Cameras::Cameras(const RigConfig& rig, const Ticks& ticks, const scenes::Scene& scene, const DrawingConfig& drawing)
    : renderer_(scene, Culling::frustum_and_horizon,
                drawing.context == DrawingConfig::Context::egl ? ContextKind::egl : ContextKind::osmesa) {
  for (const CameraConfig& camera : rig.cameras) {
    channels_.push_back(to_render_channel(camera.channel));
    periods_.push_back(ticks.period(camera.rate_hz));
    mounted_.push_back({camera.role, camera.model(), camera.X_BC(), camera.rate_hz});
    frames_.push_back({camera.role, /*t_ns=*/-1, {}});
  }
  snapshot_ = frames_;
}

size_t Cameras::index(std::string_view role) const {
  for (size_t i = 0; i < mounted_.size(); ++i) {
    if (mounted_[i].role == role) return i;
  }
  throw std::out_of_range(fmt::format("the rig has no camera '{}'", role));
}

const avoidance::CameraFrame& Cameras::expose(size_t camera, int64_t t_ns, const Eigen::Isometry3d& X_WB) {
  if (frames_[camera].t_ns != t_ns) draw(camera, t_ns, X_WB, frames_[camera]);
  return frames_[camera];
}

std::span<const avoidance::CameraFrame> Cameras::snapshot(int64_t t_ns, const Eigen::Isometry3d& X_WB) {
  for (size_t i = 0; i < count(); ++i) draw(i, t_ns, X_WB, snapshot_[i]);
  return snapshot_;
}

cv::Mat Cameras::picture(size_t camera, Channel channel, const Instant& now, const Instant& next) {
  cv::Mat image;
  const avoidance::MountedCamera& mounted = mounted_[camera];
  renderer_.draw({mounted.model, now.X_WB * mounted.X_BC, channel, now.t_s, {next.X_WB * mounted.X_BC, next.t_s}},
                 image);
  return image;
}

void Cameras::draw(size_t camera, int64_t t_ns, const Eigen::Isometry3d& X_WB, avoidance::CameraFrame& frame) {
  const double t_s = 1e-9 * static_cast<double>(t_ns);
  renderer_.draw({mounted_[camera].model, X_WB * mounted_[camera].X_BC, channels_[camera], t_s}, frame.image);
  frame.t_ns = t_ns;
}

}  // namespace hedgehop::sim
