#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "dynamics/air/wind.h"
#include "dynamics/avionics.h"
#include "dynamics/vehicle.h"
#include "sim/collision/proximity.h"
#include "sim/loop/shutter.h"
#include "sim/loop/ticks.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// The vehicle in its air, with its avionics: what flies, whoever tells it where.
class Aircraft {
 public:
  /// Throws InputError or std::invalid_argument on a vehicle, wind or avionics that cannot be.
  Aircraft(const Scenario& scenario, const Ticks& ticks);

  /// Puts it into its drawn start, in a trimmed hover. Throws InputError where it cannot hover.
  void reset(const CollisionWorld& world);
  /// Reads the sensors that are due on this tick.
  void sense(int64_t tick, const CollisionWorld& world) { avionics_.sense(ticks_.t_ns(tick), truth(world, tick)); }
  /// Runs the autopilot. @param dt_s  until the next call.
  void steer(const dynamics::control::Setpoint& setpoint, double dt_s) {
    actuators_ = avionics_.control(setpoint, dt_s);
  }
  /// Moves on by one tick.
  void move();

  Eigen::Isometry3d X_WB() const;
  BodyMotion motion() const;
  const dynamics::RigidBodyState& body() const { return vehicle_.body(); }
  const dynamics::Vehicle& vehicle() const { return vehicle_; }
  const dynamics::control::NavigationEstimate& navigation() const { return avionics_.navigation(); }
  const dynamics::Avionics& avionics() const { return avionics_; }
  dynamics::Avionics& avionics() { return avionics_; }
  const Eigen::Vector3d& wind_W() const { return wind_W_; }

 private:
  /// What the sensors may look at; good until the next call.
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
  dynamics::Controls actuators_ = dynamics::Controls::Zero();
};

}  // namespace hedgehop::sim
