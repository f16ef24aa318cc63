#include "sim/loop/cameras.h"

#include <fmt/format.h>

#include <stdexcept>

#include "sim/loop/random_stream.h"

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

Cameras::Cameras(const RigConfig& rig, const Ticks& ticks, const scenes::Scene& scene, const DrawingConfig& drawing,
                 uint64_t seed)
    : renderer_(scene, Culling::frustum_and_horizon,
                drawing.context == DrawingConfig::Context::egl ? ContextKind::egl : ContextKind::osmesa) {
  for (const CameraConfig& camera : rig.cameras) {
    channels_.push_back(to_render_channel(camera.channel));
    periods_.push_back(ticks.period(camera.rate_hz));
    period_ns_.push_back(ticks.t_ns(periods_.back()));
    mounted_.push_back({camera.role, camera.model(), camera.X_BC(), camera.rate_hz});
    imperfections_.emplace_back(camera.imperfections, 1.0 / camera.rate_hz, stream_seed(seed, "camera." + camera.role));
    shutters_.emplace_back(camera.imperfections);
    frames_.push_back({camera.role, /*t_ns=*/-1, {}});
  }
  exposed_ns_.assign(frames_.size(), -1);
  snapshot_ = frames_;
}

size_t Cameras::index(std::string_view role) const {
  for (size_t i = 0; i < mounted_.size(); ++i) {
    if (mounted_[i].role == role) return i;
  }
  throw std::out_of_range(fmt::format("the rig has no camera '{}'", role));
}

const avoidance::CameraFrame* Cameras::expose(size_t camera, int64_t t_ns, const BodyMotion& body) {
  avoidance::CameraFrame& frame = frames_[camera];
  if (exposed_ns_[camera] != t_ns) {
    exposed_ns_[camera] = t_ns;
    const int64_t number = picture_number(camera, t_ns);
    const Imperfections::Fate fate = imperfections_[camera].fate(number);
    if (fate == Imperfections::Fate::dropped) return nullptr;
    const bool frozen = fate == Imperfections::Fate::frozen && !frame.image.empty();
    if (!frozen) {
      draw(camera, channels_[camera], body, frame.image);
      imperfections_[camera].spoil(number, frame.image);
      if (fate == Imperfections::Fate::black) blacken(frame.image);
    }
    frame.t_ns = t_ns;
  }
  return frame.t_ns == t_ns ? &frame : nullptr;
}

std::span<const avoidance::CameraFrame> Cameras::snapshot(int64_t t_ns, const Eigen::Isometry3d& X_WB) {
  for (size_t i = 0; i < count(); ++i) {
    renderer_.draw({mounted_[i].model.pinhole(), X_WB * mounted_[i].X_BC, channels_[i]}, snapshot_[i].image);
    snapshot_[i].t_ns = t_ns;
  }
  return snapshot_;
}

cv::Mat Cameras::picture(size_t camera, Channel channel, int64_t t_ns, const BodyMotion& body) {
  cv::Mat image;
  draw(camera, channel, body, image);
  if (channel == Channel::grey || channel == Channel::color) {
    imperfections_[camera].spoil(picture_number(camera, t_ns), image);
  }
  return image;
}

void Cameras::draw(size_t camera, Channel channel, const BodyMotion& body, cv::Mat& out) {
  const avoidance::MountedCamera& mounted = mounted_[camera];
  const auto draw_rows = [&](const Eigen::Isometry3d& X_WB, double, const cv::Range& rows, cv::Mat& picture) {
    const bool whole = rows.size() == mounted.model.height_px;
    renderer_.draw({(whole ? mounted.model : cut(mounted.model, rows)).pinhole(), X_WB * mounted.X_BC, channel},
                   picture);
  };
  shutters_[camera].expose(body, mounted.model.height_px, draw_rows, out);
}

}  // namespace hedgehop::sim
