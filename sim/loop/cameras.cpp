#include "sim/loop/cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

#include "scenes/worlds/map.h"
#include "sim/fields/quantities.h"
#include "sim/libm/random.h"
#include "sim/scenario/rig.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {
namespace {

ImageChannel to_render_channel(CameraConfig::Channel channel) {
  switch (channel) {
    case CameraConfig::Channel::grey:
      return ImageChannel::grey;
    case CameraConfig::Channel::color:
      return ImageChannel::color;
    case CameraConfig::Channel::depth:
      return ImageChannel::depth;
    case CameraConfig::Channel::corners:
      return ImageChannel::grey;
  }
  throw std::logic_error("unknown channel");
}

/// @param path  of the camera in the scenario.
std::optional<CornerDetector> detector_of(const CameraConfig& camera, const scenes::Scene& scene, uint64_t seed,
                                          const std::string& path) {
  if (camera.channel != CameraConfig::Channel::corners) return std::nullopt;
  if (scene.corners_W.empty()) {
    throw InputError(
        FieldError{path + ".channel", fmt::format("camera '{}' delivers corners, but scene '{}' has no known "
                                                  "corners; valid: scene 'highrise'",
                                                  camera.role, scene.name)});
  }
  return CornerDetector(scene.corners_W, camera.corner_noise_px, stream_seed(seed, "corners." + camera.role));
}

}  // namespace

Cameras::Cameras(const RigConfig& rig, const Ticks& ticks, const scenes::Scene& scene, Renderer& renderer,
                 uint64_t seed, std::span<const FailureConfig> failures)
    : ticks_(ticks),
      renderer_(renderer),
      movers_are_spread_(scene.name == scenes::worlds::MapConfig::kName),  // other scenes keep the images of 0.2
      first_mover_label_(scenes::first_mover_label(scene)),
      failures_(failures.begin(), failures.end()) {
  for (const scenes::Mover& mover : scene.movers) movers_.push_back({mover.motion, scenes::reach_m(mover)});
  for (size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraConfig& camera = rig.cameras[i];
    const std::string path = fmt::format("rig.cameras.{}", i);
    build_part(path + ".samples", [&] { renderer_.require_samples(camera.samples); });
    channels_.push_back(to_render_channel(camera.channel));
    detectors_.push_back(detector_of(camera, scene, seed, path));
    samples_.push_back(camera.samples);
    periods_.push_back(ticks.period(camera.rate_hz));
    mounted_.push_back({camera.role, camera.model(), camera.X_BC(), camera.rate_hz});
    truly_mounted_.push_back(mounted_.back());
    truly_mounted_.back().X_BC = true_X_BC(camera, mounted_.back().model, seed);
    const ImperfectionsConfig imperfections = camera.imperfections.value_or(ImperfectionsConfig{});
    const bool disparity = imperfections.disparity_noise_px > 0.0;
    imperfections_.emplace_back(imperfections, 1.0 / camera.rate_hz, stream_seed(seed, "camera." + camera.role),
                                disparity ? mounted_.back().model.pinhole().focal_x_px : 0.0);
    shutters_.emplace_back(imperfections);
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
    const Imperfections::FrameFault fault = frame_fault(camera, t_ns);
    if (fault == Imperfections::FrameFault::dropped) return nullptr;
    const bool frozen = fault == Imperfections::FrameFault::frozen && frame.t_ns >= 0;
    if (!frozen) sense(camera, {t_ns, body}, fault == Imperfections::FrameFault::black, frame.image);
    frame.t_ns = t_ns;
  }
  return frame.t_ns == t_ns ? &frame : nullptr;
}

Imperfections::FrameFault Cameras::frame_fault(size_t camera, int64_t t_ns) const {
  using FrameFault = Imperfections::FrameFault;
  if (!failures_.empty()) {
    if (const FailureConfig* failure = failure_of(failures_, "camera." + mounted_[camera].role, t_ns)) {
      if (failure->mode == FailureConfig::Mode::off) return FrameFault::dropped;
      return failure->mode == FailureConfig::Mode::stuck ? FrameFault::frozen : FrameFault::black;
    }
  }
  return imperfections_[camera].frame_fault(image_number(camera, t_ns));
}

std::span<const avoidance::CameraFrame> Cameras::snapshot(int64_t t_ns, const Eigen::Isometry3d& X_WB) {
  for (size_t i = 0; i < count(); ++i) {
    const double t_s = seconds(t_ns);
    renderer_.draw({mounted_[i].model, X_WB * truly_mounted_[i].X_BC, channels_[i], t_s, {}, samples_[i]},
                   snapshot_[i].image);
    snapshot_[i].t_ns = t_ns;
  }
  return snapshot_;
}

/// A frame of this instant. @param dead  whether the sensor is dead.
void Cameras::sense(size_t camera, const Instant& now, bool dead, cv::Mat& out) {
  if (std::optional<CornerDetector>& detector = detectors_[camera]) {
    const avoidance::MountedCamera& mounted = truly_mounted_[camera];
    out = detector->detect(mounted.model, now.body.X_WB * mounted.X_BC);
    if (dead) out = CornerDetector::nothing();
    return;
  }
  draw(camera, channels_[camera], now, now, out);
  imperfections_[camera].expose(out);
  imperfections_[camera].apply(image_number(camera, now.t_ns), out);
  if (dead) blank(out);
}

cv::Mat Cameras::image(size_t camera, ImageChannel channel, const Instant& now, const Instant& next) const {
  cv::Mat image;
  draw(camera, channel, now, next, image);
  if (channel == ImageChannel::grey || channel == ImageChannel::color) {
    imperfections_[camera].apply(image_number(camera, now.t_ns), image);
  }
  return image;
}

cv::Mat Cameras::moving(size_t camera, const Instant& now) const {
  return image(camera, ImageChannel::labels, now, now) >= first_mover_label_;
}

/// Returns a bound on the image speed from the camera's rotation and from objects that pass at the minimum distance;
/// movers of a map pass at their own distance. It holds at the optical axis; off the axis of a pinhole, rotations are
/// faster.
double Cameras::image_speed_pxps(size_t camera, const Instant& now) const {
  const avoidance::MountedCamera& mounted = truly_mounted_[camera];
  const BodyMotion& body = now.body;
  double mover_mps = 0.0;
  for (const auto& [motion, reach_m] : movers_) {
    mover_mps = std::max(mover_mps, scenes::max_speed_mps(motion, reach_m, seconds(now.t_ns)));
  }
  const Eigen::Vector3d v_WC_W = body.v_WB_W + body.X_WB.linear() * body.w_WB_B.cross(mounted.X_BC.translation());
  const auto turn_radps = [](double passing_mps, double distance_m) {
    return passing_mps > 0.0 ? passing_mps / distance_m : 0.0;  // infinite if the clearance is unknown
  };
  double passing_radps = turn_radps(v_WC_W.norm() + mover_mps, body.clearance_m);
  if (movers_are_spread_) {
    const Eigen::Vector3d p_WC = body.X_WB * mounted.X_BC.translation();
    passing_radps = turn_radps(v_WC_W.norm(), body.clearance_m);
    for (const auto& [motion, reach_m] : movers_) {
      const double t_s = seconds(now.t_ns), distance_m = (scenes::p_WM(motion, t_s) - p_WC).norm() - reach_m;
      const double speed_mps = v_WC_W.norm() + scenes::max_speed_mps(motion, reach_m, t_s);
      passing_radps = std::max(passing_radps, turn_radps(speed_mps, std::max(distance_m, body.clearance_m)));
    }
  }
  return (body.w_WB_B.norm() + passing_radps) / pixel_angle_rad(mounted.model);
}

void Cameras::draw(size_t camera, ImageChannel channel, const Instant& now, const Instant& next, cv::Mat& out) const {
  const avoidance::MountedCamera& mounted = truly_mounted_[camera];
  const auto draw_rows = [&](const Eigen::Isometry3d& X_WB, double dt_s, const cv::Range& rows, cv::Mat& image) {
    const bool whole = rows.size() == mounted.model.height_px;
    const double t_s = std::max(0.0, seconds(now.t_ns) + dt_s);
    // The exposure of the next image has the same offset to its instant.
    const CameraView::Next seen_next{next.body.X_WB_after(dt_s) * mounted.X_BC,
                                     std::max(0.0, seconds(next.t_ns) + dt_s)};
    renderer_.draw({whole ? mounted.model : cut(mounted.model, rows), X_WB * mounted.X_BC, channel, t_s, seen_next,
                    samples_[camera]},
                   image);
  };
  const bool blurs = channel == ImageChannel::grey ||
                     channel == ImageChannel::color;  // ground truth is that of the middle of the exposure
  shutters_[camera].expose(now.body, blurs ? image_speed_pxps(camera, now) : 0.0, mounted.model.height_px,
                           std::ref(draw_rows), out);
}

CornerDetector::CornerDetector(std::vector<Eigen::Vector3d> corners_W, double noise_px, uint64_t seed)
    : corners_W_(std::move(corners_W)), noise_px_(noise_px), noise_(seed) {}

cv::Mat CornerDetector::detect(const vision::camera::Camera& camera, const Eigen::Isometry3d& X_WC) {
  cv::Mat detected = nothing();
  for (const Eigen::Vector3d& p_W : corners_W_) {
    const auto pixel = camera.project(X_WC.inverse() * p_W);
    const bool in_image = pixel && pixel->x() >= 0.0 && pixel->y() >= 0.0 && pixel->x() <= camera.width_px - 1 &&
                          pixel->y() <= camera.height_px - 1;
    if (!in_image) continue;
    const double right_px = noise_px_ * noise_.normal(), down_px = noise_px_ * noise_.normal();
    detected.push_back(cv::Vec2d(pixel->x() + right_px, pixel->y() + down_px));
  }
  return detected;
}

}  // namespace hedgehop::sim
