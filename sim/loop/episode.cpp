#include "sim/loop/episode.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <iterator>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <utility>

#include "scenes/generators.h"
#include "sim/collision/proximity.h"
#include "sim/loop/aircraft.h"
#include "sim/loop/assessment.h"
#include "sim/loop/cameras.h"
#include "sim/loop/corner_sight.h"
#include "sim/loop/flight_log.h"
#include "sim/loop/map_log.h"
#include "sim/loop/map_score.h"
#include "sim/loop/plugin_module.h"
#include "sim/loop/random_stream.h"
#include "sim/loop/route.h"
#include "sim/loop/setpoints.h"
#include "sim/loop/stage_timer.h"
#include "sim/loop/velocimeter.h"

namespace hedgehop::sim {
namespace {

/// Solids farther from the hull than this count as absent, m: no clearance beyond it is of interest.
constexpr double kSearchRadius_m = 50.0;

/// A decision on its way to the autopilot.
struct PendingCommand {
  int64_t tick = 0;
  avoidance::Command command;
};

class Episode {
 public:
  Episode(const Scenario& scenario, FlightWatcher* watcher);
  Flight fly();
  cv::Mat picture(size_t camera, Channel channel, double t_s);
  const Cameras& cameras() const { return cameras_; }

 private:
  void begin();
  void act();  ///< all of a tick but the motion to the next

  // What happens on a tick, in this order.
  void measure_proximity();
  void sense();
  void look();
  void hand_over_sensors();
  void decide();
  void judge_map();
  void steer();
  void show();
  bool ended();
  void move();

  void end(Outcome outcome, std::string cause = {});
  std::optional<double> goal_distance_m() const;
  Eigen::Isometry3d X_WC(size_t camera) const;  ///< true

  const Scenario& scenario_;
  FlightWatcher* watcher_;
  const Ticks ticks_;
  const scenes::Scene scene_;
  const std::vector<dynamics::HullPart> hull_;
  Aircraft aircraft_;
  CollisionWorld collision_;
  Cameras cameras_;
  std::optional<Velocimeter> velocimeter_;
  std::unique_ptr<avoidance::Module> module_;
  std::vector<size_t> module_cameras_;
  Route route_;
  int64_t control_period_ = 0, decision_period_ = 0, latency_ = 0, picture_period_ = 0;

  int64_t tick_ = 0;
  Proximity proximity_;
  std::vector<avoidance::CameraFrame> seen_;  ///< what the module is shown this tick
  std::deque<PendingCommand> pending_;
  dynamics::Setpoint setpoint_;
  FlightLog log_;
  MapLog map_log_;
  std::optional<MapScore> map_score_;        ///< where the scene's corners are known
  std::optional<ProjectedCorners> corners_;  ///< for a module that asks for the true ones
  StageTimer physics_, render_, velocimetry_, decision_;
  std::optional<Outcome> outcome_;
  std::string cause_;
};

Episode::Episode(const Scenario& scenario, FlightWatcher* watcher)
    : scenario_(scenario),
      watcher_(watcher),
      ticks_(scenario.physics_rate_hz),
      scene_(build_part("scene",
                        [&] { return scenes::make_scene(scenario.scene, stream_seed(scenario.seed, kSceneStream)); })),
      hull_(dynamics::hull(scenario.vehicle)),
      aircraft_(scenario, ticks_),
      collision_(scene_, hull_),
      cameras_(scenario.rig, ticks_, scene_, scenario.drawing, scenario.seed),
      module_(make_module(scenario.avoidance)),
      route_(scenario),
      control_period_(ticks_.period(static_cast<double>(scenario.control_rate_hz))),
      log_(scene_, aircraft_.vehicle()) {
  if (scenario.velocimeter.enabled) {
    velocimeter_.emplace(cameras_.index(scenario.velocimeter.camera), cameras_);
  }
  int64_t slowest = 0;
  const auto* highrise = std::get_if<scenes::HighriseConfig>(&scenario.scene);
  for (const avoidance::CameraNeed& need : module_->needs().cameras) {
    module_cameras_.push_back(cameras_.index(need.role));
    slowest = std::max(slowest, cameras_.period_ticks(module_cameras_.back()));
    if (need.true_corners) {
      if (!highrise) throw InputError("avoidance: true corners are known of scene 'highrise' alone");
      corners_.emplace(scenes::highrise_corners(*highrise), stream_seed(scenario.seed, "corners"));
    }
  }
  // A module without cameras decides as often as the rig's fastest camera, so that a control compares like with like.
  decision_period_ = cameras_.count() > 0 ? cameras_.period_ticks(0) : control_period_;
  for (size_t i = 1; i < cameras_.count(); ++i) decision_period_ = std::min(decision_period_, cameras_.period_ticks(i));
  latency_ =
      scenario.command_latency_s ? ticks_.ticks(*scenario.command_latency_s) : std::max(slowest, decision_period_);
  if (watcher_ && watcher_->picture_rate_hz() > 0.0) picture_period_ = ticks_.period(watcher_->picture_rate_hz());
}

void Episode::begin() {
  aircraft_.reset(collision_);
  setpoint_ = dynamics::PositionSetpoint{aircraft_.body().p_WB, route_.goal().heading_rad};
  const dynamics::AutopilotConfig& limits = scenario_.avionics.autopilot;
  module_->reset({{cameras_.mounted().begin(), cameras_.mounted().end()},
                  {limits.speed_limit_mps, limits.acceleration_limit_mps2, dynamics::radius_m(hull_)},
                  stream_seed(scenario_.seed, "module")});
  log_.set_signals(module_->signals());
  if (const auto* highrise = std::get_if<scenes::HighriseConfig>(&scenario_.scene);
      highrise && !module_cameras_.empty()) {
    map_score_.emplace(scenes::highrise_corners(*highrise), aircraft_.body().p_WB);
  }
}

void Episode::act() {
  measure_proximity();
  sense();
  look();
  hand_over_sensors();
  decide();
  if (tick_ % control_period_ == 0) steer();
  show();
}

cv::Mat Episode::picture(size_t camera, Channel channel, double t_s) {
  begin();
  const auto fly_on = [&](int64_t last) -> Cameras::Instant {
    for (; tick_ < last; ++tick_) {
      act();
      if (ended()) {
        throw InputError(fmt::format("--time {}: the flight ends at {:.3f} s ({}{}{})", t_s, ticks_.t_s(tick_),
                                     to_string(*outcome_), cause_.empty() ? "" : ": ", cause_));
      }
      move();
    }
    return {ticks_.t_ns(tick_), aircraft_.motion()};
  };
  const Cameras::Instant now = fly_on(ticks_.ticks(t_s));
  const bool leads_on = channel == Channel::flow;
  return cameras_.picture(camera, channel, now, leads_on ? fly_on(tick_ + cameras_.period_ticks(camera)) : now);
}

Flight Episode::fly() {
  const StageTimer::Clock::time_point start = StageTimer::Clock::now();
  begin();
  for (;; ++tick_) {
    act();
    if (ended()) break;
    move();
  }
  const double wall_s = std::chrono::duration<double>(StageTimer::Clock::now() - start).count();

  Flight flight = log_.take(ticks_.t_s(tick_));
  FlightResult& result = flight.result;
  result.outcome = *outcome_;
  result.cause = cause_;
  result.goal_distance_m = goal_distance_m();
  result.decision_ms = decision_.summary();
  result.render_ms = render_.summary();
  result.velocimeter_ms = velocimetry_.summary();
  result.physics_ms = physics_.summary();
  result.wall_s = wall_s;
  result.realtime_factor = result.flight_time_s / wall_s;
  for (const avoidance::Metric& metric : module_->metrics()) {
    result.metrics.push_back({metric.name, metric.value, metric.unit});
  }
  if (map_score_) std::ranges::move(map_score_->metrics(), std::back_inserter(result.metrics));
  flight.map = map_log_.take(map_score_ ? &*map_score_ : nullptr);
  assess(scenario_, scene_, hull_, flight);
  return flight;
}

void Episode::measure_proximity() {
  proximity_ = collision_.query(aircraft_.X_WB(), kSearchRadius_m, ticks_.t_s(tick_));
  log_.add(ticks_.t_s(tick_), aircraft_.body().p_WB, proximity_);
}

void Episode::sense() { aircraft_.sense(tick_, collision_); }

/// Exposes the cameras that are due and needed, all from this tick's state, and feeds the velocimeter.
void Episode::look() {
  seen_.clear();
  const int64_t t_ns = ticks_.t_ns(tick_);
  std::optional<StageTimer::Lap> lap;
  const auto expose = [&](size_t camera) -> const avoidance::CameraFrame* {
    if (!lap) lap.emplace(render_);
    return cameras_.expose(camera, t_ns, aircraft_.motion());
  };
  for (const size_t camera : module_cameras_) {
    if (!cameras_.due(camera, tick_)) continue;
    const avoidance::CameraFrame* const frame = expose(camera);
    if (!frame) continue;
    seen_.push_back(*frame);
    if (corners_) seen_.back().corners_px = corners_->project(cameras_.mounted(camera).model, X_WC(camera));
  }
  if (velocimeter_ && cameras_.due(velocimeter_->camera(), tick_)) {
    const avoidance::CameraFrame* const frame = expose(velocimeter_->camera());
    lap.reset();
    const StageTimer::Lap flow_lap = velocimetry_.lap();
    if (frame) velocimeter_->update(*frame, aircraft_.avionics());
  }
}

/// Shows the watcher what all sensors say, if it wants that.
void Episode::hand_over_sensors() {
  if (!watcher_ || !watcher_->wants_sensors()) return;
  std::vector<avoidance::CameraFrame> frames;
  for (size_t camera = 0; camera < cameras_.count(); ++camera) {
    if (!cameras_.due(camera, tick_)) continue;
    if (const auto* const frame = cameras_.expose(camera, ticks_.t_ns(tick_), aircraft_.motion())) {
      frames.push_back(*frame);
    }
  }
  const dynamics::Avionics& avionics = aircraft_.avionics();
  if (frames.empty() && !avionics.imu()) return;
  const auto depth = [this](std::string_view role) {
    const Cameras::Instant now{ticks_.t_ns(tick_), aircraft_.motion()};
    return cameras_.picture(cameras_.index(role), Channel::depth, now, now);
  };
  watcher_->on_sensors({ticks_.t_ns(tick_), aircraft_.body(), avionics.imu(), avionics.imu_bias(), frames, depth});
}

void Episode::decide() {
  const bool due = module_cameras_.empty() ? tick_ % decision_period_ == 0 : !seen_.empty();
  if (!due) return;
  route_.update(aircraft_.navigation().p_WB_est);
  const avoidance::Observation observation{ticks_.t_ns(tick_), seen_, to_navigation_state(aircraft_.avionics()),
                                           route_.goal()};
  try {
    const StageTimer::Lap lap = decision_.lap();
    const avoidance::Decision decision = module_->update(observation);
    pending_.push_back({tick_ + latency_, decision.command});
    log_.add(ticks_.t_s(tick_), decision);
    judge_map();
  } catch (const std::exception& error) {
    end(Outcome::fault, fmt::format("the module failed at {:.3f} s: {}", ticks_.t_s(tick_), error.what()));
  }
}

/// Keeps the module's chart and compares it with the scene, by what its first camera can see of it.
void Episode::judge_map() {
  const double t_s = ticks_.t_s(tick_);
  avoidance::Chart chart = module_->chart();
  if (map_score_) {
    std::vector<Eigen::Vector3d> points_W;
    for (const avoidance::ChartPoint& point : chart.points) points_W.push_back(point.p_W);
    const size_t camera = module_cameras_.front();
    map_score_->add(t_s, points_W,
                    corners_in_sight(map_score_->corners_W(), cameras_.mounted(camera).model, X_WC(camera),
                                     corners_ ? nullptr : &collision_, t_s));
  }
  map_log_.add(t_s, std::move(chart));
}

Eigen::Isometry3d Episode::X_WC(size_t camera) const { return aircraft_.X_WB() * cameras_.mounted(camera).X_BC; }

/// Lets commands whose latency is over take effect and runs the autopilot.
void Episode::steer() {
  while (!pending_.empty() && pending_.front().tick <= tick_) {
    setpoint_ = to_setpoint(pending_.front().command);
    pending_.pop_front();
  }
  aircraft_.steer(setpoint_, static_cast<double>(control_period_) * ticks_.dt_s());
  log_.add(ticks_.t_s(tick_), aircraft_, setpoint_, proximity_);
}

/// Shows the watcher what it asked for.
void Episode::show() {
  if (!watcher_) return;
  if (picture_period_ > 0 && tick_ % picture_period_ == 0) {
    const cv::Mat annotated = module_->annotate();
    const int64_t t_ns = ticks_.t_ns(tick_);
    if (!annotated.empty()) {
      watcher_->on_pictures(t_ns, {}, annotated);
    } else {
      watcher_->on_pictures(t_ns, cameras_.snapshot(t_ns, aircraft_.X_WB()), annotated);
    }
  }
  if (tick_ % ticks_.ticks(1.0) == 0) {
    watcher_->on_progress(ticks_.t_s(tick_), scenario_.duration_s, goal_distance_m().value_or(std::nan("")));
  }
}

bool Episode::ended() {
  const dynamics::RigidBodyState& body = aircraft_.body();
  if (!body.p_WB.allFinite() || !body.v_WB_B.allFinite() || !body.q_WB.coeffs().allFinite()) {
    end(Outcome::fault, fmt::format("the vehicle's state stopped being finite at {:.3f} s", ticks_.t_s(tick_)));
  } else if (proximity_.collided) {
    const bool ground = proximity_.ground_clearance_m <= 0.0;
    const std::string what =
        ground || !proximity_.nearest_solid ? "the ground" : scenes::solid_at(scene_, *proximity_.nearest_solid).name;
    end(Outcome::collided, fmt::format("hit {} at {:.3f} s", what, ticks_.t_s(tick_)));
  } else if (scenario_.goal && route_.on_last() && *goal_distance_m() <= scenario_.goal->radius_m) {
    end(Outcome::reached);
  } else if (tick_ >= ticks_.ticks(scenario_.duration_s)) {
    end(Outcome::timeout);
  }
  return outcome_.has_value();
}

void Episode::move() {
  const StageTimer::Lap lap = physics_.lap();
  aircraft_.move();
}

void Episode::end(Outcome outcome, std::string cause) {
  if (outcome_) return;  // the first cause stands
  outcome_ = outcome;
  cause_ = std::move(cause);
}

std::optional<double> Episode::goal_distance_m() const {
  if (!scenario_.goal) return std::nullopt;
  return (aircraft_.body().p_WB - scenario_.goal->p_WG()).head<2>().norm();
}

}  // namespace

Flight fly(const Scenario& scenario, FlightWatcher* watcher) {
  cv::setNumThreads(1);  // episodes are the unit of parallelism
  return Episode(scenario, watcher).fly();
}

cv::Mat picture_at(const Scenario& scenario, std::string_view role, Channel channel, double t_s) {
  cv::setNumThreads(1);
  if (!scenario.rig.find(role)) {
    std::string roles;
    for (const CameraConfig& camera : scenario.rig.cameras) roles += (roles.empty() ? "" : ", ") + camera.role;
    throw InputError(fmt::format("the rig has no camera '{}'; its cameras: {}", role, roles));
  }
  Episode episode(scenario, nullptr);
  return episode.picture(episode.cameras().index(role), channel, t_s);
}

}  // namespace hedgehop::sim
