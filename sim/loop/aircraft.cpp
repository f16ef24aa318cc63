#include "sim/loop/aircraft.h"

#include <numbers>
#include <utility>
#include <variant>

#include "dynamics/rigid_body.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

// A vehicle beyond these bounds misses the stand, or breaks it.
constexpr double kStandRadiusM = 1.0, kMaxTouchdownSpeedMps = 1.5, kMaxTouchdownTiltRad = std::numbers::pi / 9.0;

}  // namespace

Aircraft::Aircraft(const Scenario& scenario, const Ticks& ticks, AircraftParts parts)
    : scenario_(scenario),
      ticks_(ticks),
      vehicle_(std::move(parts.vehicle)),
      wind_(std::move(parts.wind)),
      avionics_(std::move(parts.avionics)) {}

void Aircraft::reset(const CollisionWorld& world) {
  const Eigen::Vector3d p_WB = scenario_.start.draw_p_WB(stream_seed(scenario_.world(), "start"));
  wind_W_ = wind_.sample(-p_WB.z(), Eigen::Vector3d::Zero(), ticks_.dt_s());
  build_part("vehicle", [&] { vehicle_.reset(p_WB, scenario_.start.heading_rad, wind_W_); });
  avionics_.reset(truth(world, 0));
}

void Aircraft::reset_on_stand(const CollisionWorld& world) {
  Eigen::Vector3d p_WB = scenario_.start.draw_p_WB(stream_seed(scenario_.world(), "start"));
  if (const std::optional<double> stand_m = stand_altitude_m(scenario_)) p_WB.z() = -*stand_m;
  wind_.delay_gust();
  wind_W_ = wind_.sample(-p_WB.z(), Eigen::Vector3d::Zero(), ticks_.dt_s());
  vehicle_.reset_on_stand(p_WB, scenario_.start.heading_rad, wind_W_);
  p_stand_W_ = p_WB;
  on_stand_ = true;
  avionics_.reset(truth(world, 0));
}

void Aircraft::follow(const Steering& steering, double dt_s) {
  if (const auto* const setpoint = std::get_if<dynamics::control::Setpoint>(&steering)) {
    actuators_ = avionics_.control(*setpoint, dt_s);
    return;
  }
  const auto& direct = std::get<DirectCommand>(steering);
  if (const auto* const rates = std::get_if<dynamics::control::RateSetpoint>(&direct)) {
    actuators_ = avionics_.control(*rates, dt_s);
  } else {
    avionics_.release();
    actuators_ = std::get<dynamics::multicopter::PerRotor>(direct);
  }
}

void Aircraft::move(int64_t tick) {
  if (!scenario_.failures.empty()) {
    actuator_faults(scenario_.failures, ticks_.t_ns(tick), faults_);
    vehicle_.set_faults(faults_);
  }
  wind_W_ = wind_.sample(-body().p_WB.z(), body().q_WB * body().v_WB_B, ticks_.dt_s());
  if (on_stand_) {
    const bool lifts = vehicle_.step_on_stand(actuators_, wind_W_, ticks_.dt_s());
    on_stand_ = !(lifts && engine_on_);
  } else {
    vehicle_.step(actuators_, wind_W_, ticks_.dt_s());
    on_stand_ = touches_stand();
    if (on_stand_) set_down();
  }
}

bool Aircraft::touches_stand() const {
  if (!p_stand_W_ || body().p_WB.z() < p_stand_W_->z()) return false;
  const Eigen::Vector3d from_stand_W = body().p_WB - *p_stand_W_;
  return from_stand_W.head<2>().norm() <= kStandRadiusM && body().v_WB_B.norm() <= kMaxTouchdownSpeedMps &&
         dynamics::tilt_rad(dynamics::to_roll_pitch_heading(body().q_WB)) <= kMaxTouchdownTiltRad;
}

void Aircraft::set_down() {
  dynamics::RigidBodyState rest;
  rest.p_WB = {body().p_WB.x(), body().p_WB.y(), p_stand_W_->z()};
  rest.q_WB = dynamics::from_roll_pitch_heading(0.0, 0.0, dynamics::to_roll_pitch_heading(body().q_WB).z());
  vehicle_.set_body(rest, wind_W_);
}

Eigen::Vector3d Aircraft::specific_force_B() const {
  if (!on_stand_) return vehicle_.specific_force_B();
  return body().q_WB.conjugate() * Eigen::Vector3d(0.0, 0.0, -dynamics::kGravityMps2);
}

dynamics::sensors::BeamDistance Aircraft::beam_distance(const CollisionWorld& world, int64_t tick) {
  surroundings_ = {&world, ticks_.t_s(tick)};
  return [this](const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W, double reach_m) {
    return surroundings_.world->distance_along(p_W, direction_W, reach_m, surroundings_.t_s);
  };
}

dynamics::SensedTruth Aircraft::truth(const CollisionWorld& world, int64_t tick) {
  surroundings_ = {&world, ticks_.t_s(tick)};
  // They capture a single pointer each: a std::function would allocate for more.
  const auto height_at_offset = [this](double north_m, double east_m) {
    return surroundings_.world->height_above_surface(body().p_WB + Eigen::Vector3d(north_m, east_m, 0.0),
                                                     surroundings_.t_s);
  };
  return {body(), specific_force_B(), height_at_offset(0.0, 0.0), height_at_offset, beam_distance(world, tick)};
}

Eigen::Isometry3d Aircraft::X_WB() const {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  X_WB.linear() = body().q_WB.toRotationMatrix();
  X_WB.translation() = body().p_WB;
  return X_WB;
}

BodyMotion Aircraft::motion() const {
  return {.X_WB = X_WB(), .v_WB_W = body().q_WB * body().v_WB_B, .w_WB_B = body().w_WB_B};
}

}  // namespace hedgehop::sim
