#include "sim/loop/episode.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <iterator>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <utility>

#include "scenes/generators.h"
#include "sim/collision/proximity.h"
#include "sim/fields/bounds.h"
#include "sim/loop/aircraft.h"
#include "sim/loop/cameras.h"
#include "sim/loop/flight_log.h"
#include "sim/loop/map_log.h"
#include "sim/loop/module_pilot.h"
#include "sim/loop/onlooker.h"
#include "sim/loop/random_stream.h"
#include "sim/loop/setpoints.h"
#include "sim/loop/stage_timer.h"
#include "sim/loop/velocimeter.h"
#include "sim/verdict/assessment.h"
#include "sim/verdict/corner_sight.h"
#include "sim/verdict/map_score.h"

namespace hedgehop::sim {
namespace {

/// Solids farther from the hull than this count as absent, m: no clearance beyond it is of interest.
constexpr double kSearchRadiusM = 50.0;

/// Throws InputError naming the key when a scenario that no file was read for has a value out of its bounds.
const Scenario& within_bounds(const Scenario& scenario) {
  build_part("scenario", [&] { return &fields::require_bounds(scenario); });
  return scenario;
}

class Episode {
 public:
  Episode(const Scenario& scenario, FlightWatcher* watcher);
  Flight fly();
  cv::Mat image(size_t camera, Channel channel, double t_s);
  const Cameras& cameras() const { return cameras_; }

 private:
  void begin();
  void act();  ///< all of a tick but the motion to the next

  // What happens on a tick, in this order.
  void measure_proximity();
  void look();
  void decide();
  void judge_map();
  void steer();
  bool ended();
  void move();

  void end(Outcome outcome, std::string cause = {});
  std::optional<double> goal_distance_m() const;

  const Scenario& scenario_;
  const Ticks ticks_;
  const scenes::Scene scene_;
  const std::vector<dynamics::HullPart> hull_;
  Aircraft aircraft_;
  CollisionWorld collision_;
  Cameras cameras_;
  std::optional<Velocimeter> velocimeter_;
  ModulePilot pilot_;
  Onlooker onlooker_;
  const int64_t control_period_;

  int64_t tick_ = 0;
  Proximity proximity_;
  FlightLog log_;
  MapLog map_log_;
  std::optional<MapScore> map_score_;  ///< where the scene's corners are known
  StageTimer physics_, render_, velocimetry_, decision_;
  std::optional<Outcome> outcome_;
  std::string cause_;
};

Episode::Episode(const Scenario& scenario, FlightWatcher* watcher)
    : scenario_(within_bounds(scenario)),
      ticks_(scenario.physics_rate_hz),
      scene_(build_part("scene",
                        [&] { return scenes::make_scene(scenario.scene, stream_seed(scenario.seed, kSceneStream)); })),
      hull_(dynamics::hull(scenario.vehicle)),
      aircraft_(scenario, ticks_),
      collision_(scene_, hull_),
      cameras_(scenario.rig, ticks_, scene_, scenario.drawing, scenario.seed),
      pilot_(scenario, ticks_, cameras_),
      onlooker_(watcher, ticks_, cameras_, aircraft_),
      control_period_(ticks_.period(static_cast<double>(scenario.control_rate_hz))),
      log_(scene_, aircraft_.vehicle()) {
  if (scenario.velocimeter.enabled) {
    velocimeter_.emplace(cameras_.index(scenario.velocimeter.camera), cameras_);
  }
}

void Episode::begin() {
  aircraft_.reset(collision_);
  const double heading_rad = pilot_.route().goal().heading_rad;
  pilot_.reset(dynamics::radius_m(hull_), dynamics::control::PositionSetpoint{aircraft_.body().p_WB, heading_rad});
  log_.set_signals(pilot_.module().signals());
  if (!scene_.corners_W.empty() && pilot_.first_camera()) {
    map_score_.emplace(scene_.corners_W, aircraft_.body().p_WB);
  }
}

void Episode::act() {
  measure_proximity();
  aircraft_.sense(tick_, collision_);
  look();
  onlooker_.hand_over_sensors(tick_);
  if (pilot_.decides(tick_)) decide();
  if (tick_ % control_period_ == 0) steer();
  onlooker_.show(tick_, pilot_.module(), scenario_.duration_s, goal_distance_m());
}

cv::Mat Episode::image(size_t camera, Channel channel, double t_s) {
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
  return cameras_.image(camera, channel, now, leads_on ? fly_on(tick_ + cameras_.period_ticks(camera)) : now);
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
  result.truth_used = pilot_.truth_used();
  result.goal_distance_m = goal_distance_m();
  result.decision_ms = decision_.summary();
  result.render_ms = render_.summary();
  result.velocimeter_ms = velocimetry_.summary();
  result.physics_ms = physics_.summary();
  result.wall_s = wall_s;
  result.realtime_factor = result.flight_time_s / wall_s;
  for (const avoidance::Metric& metric : pilot_.module().metrics()) {
    result.metrics.push_back({metric.name, metric.value, metric.unit});
  }
  if (map_score_) std::ranges::move(map_score_->metrics(), std::back_inserter(result.metrics));
  flight.map = map_log_.take(map_score_ ? &*map_score_ : nullptr);
  assess(scenario_, scene_, hull_, flight);
  return flight;
}

void Episode::measure_proximity() {
  proximity_ = collision_.query(aircraft_.X_WB(), kSearchRadiusM, ticks_.t_s(tick_));
  log_.add(ticks_.t_s(tick_), aircraft_.body().p_WB, proximity_);
}

/// Exposes the cameras that are due and needed, all from this tick's state, and feeds the velocimeter.
void Episode::look() {
  const bool measures = velocimeter_ && cameras_.due(velocimeter_->camera(), tick_);
  const avoidance::CameraFrame* ground = nullptr;
  {
    std::optional<StageTimer::Lap> lap;
    if (measures || pilot_.looks(tick_)) lap.emplace(render_);
    pilot_.look(tick_, aircraft_.motion());
    if (measures) ground = cameras_.expose(velocimeter_->camera(), ticks_.t_ns(tick_), aircraft_.motion());
  }
  if (measures) {
    const StageTimer::Lap lap = velocimetry_.lap();
    if (ground) velocimeter_->update(*ground, aircraft_.avionics());
  }
}

void Episode::decide() {
  try {
    const StageTimer::Lap lap = decision_.lap();
    log_.add(ticks_.t_s(tick_), pilot_.decide(tick_, to_navigation_state(aircraft_.avionics())));
  } catch (const std::exception& error) {
    end(Outcome::fault, fmt::format("the module failed at {:.3f} s: {}", ticks_.t_s(tick_), error.what()));
    return;
  }
  judge_map();
}

/// Keeps the module's map and compares it with the scene, by what its first camera can see of it.
void Episode::judge_map() {
  const double t_s = ticks_.t_s(tick_);
  avoidance::Map map = pilot_.module().map();
  if (map_score_) {
    const avoidance::MountedCamera& camera = cameras_.mounted(*pilot_.first_camera());
    std::vector<Eigen::Vector3d> points_W;
    for (const avoidance::MapPoint& point : map.points) points_W.push_back(point.p_W);
    map_score_->add(t_s, points_W,
                    corners_in_sight(map_score_->corners_W(), camera.model, aircraft_.X_WB() * camera.X_BC,
                                     pilot_.sees_through_walls() ? nullptr : &collision_, t_s));
  }
  map_log_.add(t_s, std::move(map));
}

/// Runs the autopilot.
void Episode::steer() {
  const dynamics::control::Setpoint& setpoint = pilot_.setpoint(tick_);
  aircraft_.steer(setpoint, static_cast<double>(control_period_) * ticks_.dt_s());
  log_.add(ticks_.t_s(tick_), aircraft_, setpoint, proximity_);
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
  } else if (scenario_.goal && pilot_.route().on_last() && *goal_distance_m() <= scenario_.goal->radius_m) {
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

cv::Mat image_at(const Scenario& scenario, std::string_view role, Channel channel, double t_s) {
  cv::setNumThreads(1);
  if (!scenario.rig.find(role)) {
    std::string roles;
    for (const CameraConfig& camera : scenario.rig.cameras) roles += (roles.empty() ? "" : ", ") + camera.role;
    throw InputError(fmt::format("the rig has no camera '{}'; its cameras: {}", role, roles));
  }
  Episode episode(scenario, nullptr);
  return episode.image(episode.cameras().index(role), channel, t_s);
}

}  // namespace hedgehop::sim
