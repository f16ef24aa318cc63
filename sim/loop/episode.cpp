#include "sim/loop/episode.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "sim/loop/module_pilot.h"
#include "sim/scenario/validate.h"

namespace hedgehop::sim {
Episode::Episode(const Scenario& scenario, FlightEnvironment& environment, FlightParts parts, FlightWatcher* watcher,
                 MapObserver* map_observer, OutsideAutopilot* outside)
    : scenario_(scenario),
      ticks_(scenario.physics_rate_hz.value()),
      environment_(environment),
      aircraft_(scenario, ticks_, std::move(parts.aircraft)),
      cameras_(scenario.rig, ticks_, *environment.scene, environment.renderer, scenario.seed, scenario.failures),
      pilot_(scenario, ticks_, cameras_, std::move(parts.module),
             watcher ? watcher->module_folder() : std::filesystem::path()),
      watcher_dispatch_(watcher, ticks_, cameras_, aircraft_),
      map_observer_(map_observer),
      outside_(outside),
      control_period_(ticks_.period(static_cast<double>(scenario.control_rate_hz))),
      log_(*environment.scene, aircraft_.vehicle()) {
  if (scenario.velocimeter.enabled) {
    velocimeter_.emplace(cameras_.index(scenario.velocimeter.camera), cameras_);
  }
  if (outside_) {
    take_off();
  } else {
    aircraft_.reset(environment_.collision);
  }
  const double heading_rad = pilot_.route().goal().heading_rad;
  pilot_.reset(environment_.hull, dynamics::control::PositionSetpoint{aircraft_.body().p_WB, heading_rad});
  if (std::string fault = signal_fault(pilot_.module().signals()); !fault.empty()) {
    throw InputError(FieldError{"avoidance", std::move(fault)});
  }
  log_.set_signals(pilot_.module().signals());
  p_WB_start_ = aircraft_.body().p_WB;
  watcher_dispatch_.send_start(log_.tables(), *environment_.scene);
  begin_tick();
}

void Episode::tick(const CallerCommand* command) {
  if (over()) throw std::logic_error("the flight is over");
  if (command || decides()) overridden_ = command != nullptr;
  complete_tick(command);
  if (over()) return;
  move();
  ++tick_;
  begin_tick();
}

void Episode::begin_tick() {
  observation_.reset();
  decision_made_.reset();
  if (std::optional<Ending> fault = fault_of_state()) return end(*std::move(fault));
  measure_proximity();
  expose_cameras();
  read_sensors();
  watcher_dispatch_.send_sensors(tick_, motion());
  if (pilot_.decides(tick_)) observation_ = pilot_.observe(tick_, to_navigation_state(aircraft_.avionics()));
  const std::optional<Ending> reason = over() ? end_ : ending();
  if (!reason) return;
  complete_tick(nullptr);
  end(*reason);
}

void Episode::complete_tick(const CallerCommand* command) {
  if (command) {
    override_decision(*command);
  } else if (decides() && !overridden_) {
    decide();
  }
  if (tick_ % control_period_ == 0) run_autopilot();
  watcher_dispatch_.send_images(
      tick_, [this] { return annotate(); }, log_.status(), proximity_.obstacle_clearance_m, scenario_.duration_s,
      goal_distance_m());
}

Flight Episode::flight() const {
  Flight flight = log_.flight(ticks_.t_s(tick_));
  FlightResult& result = flight.result;
  result.outcome = end_ ? end_->outcome : Outcome::timeout;
  result.cause = end_ ? end_->cause : "";
  result.truth_used = pilot_.truth_used();
  for (const FailureConfig& failure : scenario_.failures) result.failures.push_back(to_text(failure));
  result.goal_distance_m = goal_distance_m();
  result.physics_rate_hz = *scenario_.physics_rate_hz;
  if (outside_) result.link = outside_->figures();
  result.decision_ms = decision_.summary();
  result.render_ms = render_.summary();
  result.velocimeter_ms = velocimetry_.summary();
  result.physics_ms = physics_.summary();
  try {
    for (const avoidance::Metric& metric : pilot_.module().metrics()) {
      result.metrics.push_back({std::string(kModulePrefix) + metric.name, metric.value, metric.unit,
                                metric.is_wall_time ? FigureKind::wall_time : FigureKind::module});
    }
  } catch (const std::exception& error) {  // the flight is valid, but its module is not reliable
    if (result.outcome != Outcome::fault)
      result.cause = fmt::format("the module failed after its flight: {}", error.what());
    result.outcome = Outcome::fault;
  }
  flight.command_latency_s = pilot_.command_latency_s();
  flight.map = map_log_.record();
  flight.scene = environment_.scene;
  return flight;
}

avoidance::Observation Episode::observation() const {
  if (observation_) return *observation_;
  return {ticks_.t_ns(tick_), {}, to_navigation_state(aircraft_.avionics()), pilot_.route().goal()};
}

void Episode::measure_proximity() {
  proximity_ = environment_.collision.query(aircraft_.X_WB(), kMaxClearanceM, ticks_.t_s(tick_));
  log_.add(ticks_.t_s(tick_), aircraft_.body().p_WB, proximity_);
}

BodyMotion Episode::motion() const {
  BodyMotion motion = aircraft_.motion();
  motion.clearance_m =
      std::clamp(std::min(proximity_.obstacle_clearance_m, proximity_.ground_clearance_m), 0.0, kMaxClearanceM);
  return motion;
}

/// Exposes the cameras that are due and needed, all from the state of this tick.
void Episode::expose_cameras() {
  const bool measures = velocimeter_ && cameras_.due(velocimeter_->camera(), tick_);
  std::optional<StageTimer::Lap> lap;
  if (measures || pilot_.exposes(tick_)) lap.emplace(render_);
  pilot_.expose(tick_, motion());
  ground_ = measures ? cameras_.expose(velocimeter_->camera(), ticks_.t_ns(tick_), motion()) : nullptr;
}

/// Reads all sensors that are due, including the velocimeter.
void Episode::read_sensors() {
  dynamics::VelocitySensor flow_velocity;
  if (ground_) {
    flow_velocity = [this](const dynamics::control::NavigationEstimate& navigation) {
      const StageTimer::Lap lap = velocimetry_.lap();
      return velocimeter_->measure(*ground_, navigation);
    };
  }
  aircraft_.sense(tick_, environment_.collision, flow_velocity);
}

void Episode::decide() {
  call_module([this] {
    const StageTimer::Lap lap = decision_.lap();
    avoidance::Decision decision = pilot_.decide(tick_, *observation_);
    log_.add(ticks_.t_s(tick_), decision);
    if (outside_) decision_made_ = std::move(decision);
  });
  if (!over()) {
    watcher_dispatch_.send_decision(log_.tables(), [this] { return annotate(); });
    observe_map();
  }
}

/// Returns the module's image for videos and logs; empty if it has none or fails, because watchers cannot change a
/// flight.
cv::Mat Episode::annotate() const {
  constexpr int kMaxSidePx = 8192;
  try {
    cv::Mat image = pilot_.module().annotate();
    const bool is_image = image.dims == 2 && image.type() == CV_8UC3 && std::max(image.rows, image.cols) <= kMaxSidePx;
    return is_image ? image : cv::Mat();
  } catch (const std::exception&) {
    return {};
  }
}

void Episode::call_module(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& error) {
    end({Outcome::fault, fmt::format("the module failed at {:.3f} s: {}", ticks_.t_s(tick_), error.what())});
  }
}

void Episode::override_decision(const CallerCommand& command) {
  if (const auto* const direct = std::get_if<DirectCommand>(&command)) {
    pilot_.override_decision(tick_, *direct);
    log_.add_direct_command(ticks_.t_s(tick_));
  } else {
    const std::vector<double> no_signals(pilot_.module().signals().size(), std::nan(""));
    const avoidance::Command given = pilot_.override_decision(tick_, std::get<avoidance::Command>(command));
    log_.add(ticks_.t_s(tick_), {given, std::string(kCommanded), no_signals});
  }
  watcher_dispatch_.send_decision(log_.tables(), [this] { return annotate(); });
}

/// Records the module's map and passes it with the ground truth to the map observer.
void Episode::observe_map() {
  const double t_s = ticks_.t_s(tick_);
  avoidance::Map map;
  call_module([&] { map = pilot_.module().map(); });
  if (over()) return;
  if (const std::optional<size_t> camera = pilot_.first_camera(); camera && map_observer_) {
    map_observer_->on_map({t_s, map, cameras_.truly_mounted(*camera), aircraft_.X_WB(), p_WB_start_,
                           *environment_.scene, environment_.collision, pilot_.sees_through_walls()});
  }
  map_log_.add(t_s, std::move(map));
}

void Episode::run_autopilot() {
  const Steering& steering = pilot_.steering(tick_);
  if (!outside_) aircraft_.follow(steering, static_cast<double>(control_period_) * ticks_.dt_s());
  log_.add(ticks_.t_s(tick_), aircraft_, steering, proximity_);
  watcher_dispatch_.send_row(log_.tables());
}

/// Returns the end of the flight by a state that cannot be measured or seen, if any.
std::optional<Episode::Ending> Episode::fault_of_state() const {
  const dynamics::RigidBodyState& body = aircraft_.body();
  if (body.p_WB.allFinite() && body.v_WB_B.allFinite() && body.q_WB.coeffs().allFinite() && body.w_WB_B.allFinite())
    return std::nullopt;
  return Ending{Outcome::fault, fmt::format("the vehicle's state stopped being finite at {:.3f} s", ticks_.t_s(tick_))};
}

/// Returns the end of the flight by a collision, if any.
std::optional<Episode::Ending> Episode::collision() const {
  if (!collides()) return std::nullopt;
  const bool ground = proximity_.ground_clearance_m <= 0.0;
  const std::string what = ground || !proximity_.nearest_solid
                               ? "the ground"
                               : scenes::solid_at(*environment_.scene, *proximity_.nearest_solid).name;
  return Ending{Outcome::collided, fmt::format("hit {} at {:.3f} s", what, ticks_.t_s(tick_))};
}

bool Episode::collides() const {
  if (scenario_.collision_of == CollisionOf::hull) return proximity_.collided;
  return environment_.collision.height_above_surface(aircraft_.body().p_WB, ticks_.t_s(tick_)) <= 0.0;
}

/// Returns the end of the flight on this tick, if any.
std::optional<Episode::Ending> Episode::ending() const {
  if (std::optional<Ending> reason = collision()) return reason;
  if (scenario_.goal && pilot_.route().on_last() && scenario_.goal->holds(aircraft_.body().p_WB)) {
    return Ending{Outcome::reached, {}};
  }
  if (tick_ >= ticks_.ticks(scenario_.duration_s)) return Ending{Outcome::timeout, {}};
  return std::nullopt;
}

void Episode::move() {
  if (outside_) {
    move_outside();
    return;
  }
  const StageTimer::Lap lap = physics_.lap();
  aircraft_.move(tick_);
}

/// Keeps the first cause.
void Episode::end(Ending reason) {
  if (!end_) end_ = std::move(reason);
}

std::optional<double> Episode::goal_distance_m() const {
  if (!scenario_.goal) return std::nullopt;
  return (aircraft_.body().p_WB - scenario_.goal->p_WG()).head<2>().norm();
}

}  // namespace hedgehop::sim
