#include "sim/loop/watcher_dispatch.h"

#include <cmath>
#include <stdexcept>
#include <vector>

namespace hedgehop::sim {

WatcherDispatch::WatcherDispatch(FlightWatcher* watcher, const Ticks& ticks, Cameras& cameras, const Aircraft& aircraft)
    : watcher_(watcher), ticks_(ticks), cameras_(cameras), aircraft_(aircraft) {
  flow_starts_.resize(cameras_.count());
  if (watcher_ && watcher_->image_rate_hz() > 0.0) image_period_ = ticks_.period(watcher_->image_rate_hz());
}

void WatcherDispatch::send_start(const Flight& tables, const scenes::Scene& scene) {
  if (watcher_) watcher_->on_start({tables.signals, tables.control_names, scene});
}

void WatcherDispatch::send_row(const Flight& tables) {
  if (watcher_) watcher_->on_row(tables.trajectory.back());
}

void WatcherDispatch::send_decision(const Flight& tables, const std::function<cv::Mat()>& annotate) {
  if (watcher_) watcher_->on_decision(tables.decisions.back(), annotate);
}

void WatcherDispatch::send_sensors(int64_t tick, const BodyMotion& body) {
  if (!watcher_ || !watcher_->wants_sensors()) return;
  const Cameras::Instant now{ticks_.t_ns(tick), body};
  std::vector<avoidance::CameraFrame> frames;
  for (size_t camera = 0; camera < cameras_.count(); ++camera) {
    if (!cameras_.due(camera, tick)) continue;
    if (const auto* const frame = cameras_.expose(camera, ticks_.t_ns(tick), body)) frames.push_back(*frame);
  }
  const dynamics::Avionics& avionics = aircraft_.avionics();
  if (frames.empty() && !avionics.imu() && !avionics.gps()) return;
  const auto image_of = [&](ImageChannel channel) {
    return [&, channel](std::string_view role) { return cameras_.image(cameras_.index(role), channel, now, now); };
  };
  const auto moving = [&](std::string_view role) { return cameras_.moving(cameras_.index(role), now); };
  const auto flow_to_here = [&](std::string_view role) {
    const size_t camera = cameras_.index(role);
    if (!flow_starts_[camera]) throw std::logic_error("the optic flow has no start");
    return cameras_.image(camera, ImageChannel::flow, *flow_starts_[camera], now);
  };
  const auto start_flow = [&](std::string_view role) { flow_starts_[cameras_.index(role)] = now; };
  watcher_->on_sensors({now.t_ns, aircraft_.body(), avionics.imu(), avionics.imu_bias(), avionics.gps(),
                        avionics.navigation(), frames, image_of(ImageChannel::depth), image_of(ImageChannel::labels),
                        image_of(ImageChannel::semantic), moving, flow_to_here, start_flow});
}

void WatcherDispatch::send_images(int64_t tick, const std::function<cv::Mat()>& annotate, std::string_view status,
                                  double obstacle_clearance_m, double duration_s,
                                  std::optional<double> goal_distance_m) {
  if (!watcher_) return;
  if (image_period_ > 0 && tick % image_period_ == 0) {
    ShownInstant shown{.t_ns = ticks_.t_ns(tick),
                       .annotated = annotate(),
                       .frames = {},
                       .status = status,
                       .obstacle_clearance_m = obstacle_clearance_m};
    if (shown.annotated.empty()) shown.frames = cameras_.snapshot(shown.t_ns, aircraft_.X_WB());
    watcher_->on_images(shown);
  }
  if (tick % ticks_.ticks(1.0) == 0) {
    watcher_->on_progress(ticks_.t_s(tick), duration_s, goal_distance_m.value_or(std::nan("")));
  }
}

}  // namespace hedgehop::sim
