#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/collision/proximity.h"
#include "sim/loop/outside_autopilot.h"
#include "sim/loop/shutter.h"
#include "sim/loop/steering.h"
#include "sim/loop/ticks.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {

/// The vehicle with its wind and avionics.
class Aircraft {
 public:
  /// @param scenario  outlives the aircraft. @param parts  of the scenario.
  Aircraft(const Scenario& scenario, const Ticks& ticks, AircraftParts parts);

  /// Sets a trimmed hover at the drawn start. Throws InputError if the vehicle cannot hover.
  void reset(const CollisionWorld& world);
  /// Puts the vehicle of a linked flight at rest on its stand. Its flight starts with begin_linked_flight().
  void reset_on_stand(const CollisionWorld& world);
  /// Starts the sensors and the gust of a linked flight at its start.
  void begin_linked_flight(const CollisionWorld& world) {
    avionics_.reset(truth(world, 0));
    wind_.start_gust();
  }
  /// Reads the sensors that are due on this tick. @param flow_velocity  the velocimeter, if it has an image.
  void sense(int64_t tick, const CollisionWorld& world, const dynamics::VelocitySensor& flow_velocity = {}) {
    avionics_.sense(ticks_.t_ns(tick), truth(world, tick), flow_velocity);
  }
  /// Sets the actuator commands that follow a setpoint or a valid direct command. @param dt_s  until the next call.
  void follow(const Steering& steering, double dt_s);
  /// Replaces the actuator commands of the autopilot.
  void command_actuators(const OutsideCommand& command) {
    actuators_ = command.actuators;
    engine_on_ = command.engine_on;
    vehicle_.set_engine(engine_on_);
  }
  /// Advances by one tick. @param tick  before the step.
  void move(int64_t tick);
  /// Whether the stand of a linked flight holds the vehicle: until its thrust exceeds its weight, and after a landing.
  bool on_stand() const { return on_stand_; }
  /// Specific force at the mass center, including that of the stand, m/s^2.
  Eigen::Vector3d specific_force_B() const;
  /// Returns the true distance along beams; valid until the next call of sense() or this function.
  dynamics::sensors::BeamDistance beam_distance(const CollisionWorld& world, int64_t tick);

  Eigen::Isometry3d X_WB() const;
  /// Returns the motion without a clearance.
  BodyMotion motion() const;
  const dynamics::RigidBodyState& body() const { return vehicle_.body(); }
  const dynamics::Vehicle& vehicle() const { return vehicle_; }
  const dynamics::control::NavigationEstimate& navigation() const { return avionics_.navigation(); }
  const dynamics::Avionics& avionics() const { return avionics_; }
  const Eigen::Vector3d& wind_W() const { return wind_W_; }

 private:
  bool touches_stand() const;
  /// Levels the vehicle at rest on the stand.
  void set_down();
  /// Returns the true values that the sensors measure; valid until the next call.
  dynamics::SensedTruth truth(const CollisionWorld& world, int64_t tick);

  const Scenario& scenario_;
  const Ticks ticks_;
  dynamics::Vehicle vehicle_;
  dynamics::air::Wind wind_;
  dynamics::Avionics avionics_;
  Eigen::Vector3d wind_W_ = Eigen::Vector3d::Zero();
  struct Surroundings {
    const CollisionWorld* world = nullptr;
    double t_s = 0.0;
  } surroundings_;
  std::vector<dynamics::ActuatorFault> faults_;  ///< of this tick
  dynamics::ActuatorCommand actuators_ = dynamics::Controls(dynamics::Controls::Zero());
  std::optional<Eigen::Vector3d> p_stand_W_;  ///< of the body's origin at rest
  bool on_stand_ = false, engine_on_ = true;
};

}  // namespace hedgehop::sim
