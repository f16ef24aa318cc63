#pragma once

#include "sim/loop/aircraft.h"

namespace hedgehop::sim {

/// An aircraft with its autopilot and all of its sensors that flies to and fro between walls in moderate turbulence,
/// 500 physics steps per second and an autopilot step every fifth of them.
class OutdoorFlight {
 public:
  static constexpr double kWallNorthM = 40.0;  ///< of the near side of the wall to the north

  explicit OutdoorFlight(const dynamics::VehicleConfig& vehicle)
      : scenario_(in_turbulence(vehicle)),
        ticks_(*scenario_.physics_rate_hz),
        world_(between_walls(), dynamics::hull(vehicle)),
        aircraft_(scenario_, ticks_, build_aircraft(scenario_)) {
    aircraft_.reset(world_);
  }
  OutdoorFlight(const OutdoorFlight&) = delete;  // the aircraft refers to the scenario
  OutdoorFlight& operator=(const OutdoorFlight&) = delete;

  void fly(double duration_s) {
    constexpr int64_t kTicksPerControl = 5;
    const double control_dt_s = kTicksPerControl * ticks_.dt_s();
    for (const int64_t last = tick_ + ticks_.ticks(duration_s); tick_ < last; ++tick_) {
      aircraft_.sense(tick_, world_);
      if (tick_ % kTicksPerControl == 0) {
        const bool out = tick_ / ticks_.ticks(10.0) % 2 == 0;
        aircraft_.follow(dynamics::control::VelocitySetpoint{{out ? 3.0 : -3.0, 1.0}, 12.0, 0.5}, control_dt_s);
      }
      aircraft_.move(tick_);
    }
  }
  const Aircraft& aircraft() const { return aircraft_; }

 private:
  static Scenario in_turbulence(const dynamics::VehicleConfig& vehicle) {
    Scenario scenario;
    scenario.physics_rate_hz = 500;
    scenario.vehicle = vehicle;
    scenario.avionics.barometer.enabled = scenario.avionics.range_finder.ranger.enabled = true;
    scenario.wind = {.speed_mps = 5.0, .from_rad = 1.0, .roughness_m = 0.046, .turbulence_w20_mps = 15.4};
    return scenario;
  }
  static scenes::Scene between_walls() {
    scenes::Scene scene;
    for (const double north_m : {-kWallNorthM - 1.0, kWallNorthM + 1.0}) {
      scenes::Solid wall;
      wall.X_WS = Eigen::Translation3d(north_m, 0.0, -20.0);
      wall.half_extents_m = {1.0, 500.0, 20.0};
      scene.solids.push_back(wall);
    }
    return scene;
  }

  const Scenario scenario_;
  const Ticks ticks_;
  CollisionWorld world_;
  Aircraft aircraft_;
  int64_t tick_ = 0;
};

}  // namespace hedgehop::sim
