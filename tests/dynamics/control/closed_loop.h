#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "dynamics/air/wind.h"
#include "dynamics/avionics.h"
#include "dynamics/vehicle.h"
#include "sim/libm/random.h"

/// Closed loop of a vehicle with its avionics, or with its autopilot and true navigation, for tests.
namespace hedgehop::dynamics {

/// Seed of a named stream of these tests. Their tolerances hold for the streams of this function, which is therefore
/// not stream_seed().
inline uint64_t seed_of(uint64_t seed, std::string_view name) {
  uint64_t hash = 0xcbf29ce484222325u ^ (seed * kSplitMixIncrement);
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

struct Loop {
  AvionicsConfig avionics;
  VehicleConfig vehicle;
  std::optional<VehicleConfig> designed_for;  ///< vehicle that the autopilot is designed for
  std::function<Eigen::Vector3d(double t_s)> wind_W = [](double) { return Eigen::Vector3d(Eigen::Vector3d::Zero()); };
  std::optional<air::WindConfig> weather;  ///< instead of wind_W
  std::function<double(const Eigen::Vector3d& p_WB)> surface_m = [](const Eigen::Vector3d&) { return 0.0; };
  bool perfect = false;     ///< whether the autopilot gets the true state
  double flow_sigma = 0.1;  ///< of the simulated velocity of the downward camera, 50 Hz, m/s; 0 for none
  double heading_rad = 0.0;
  uint64_t seed = 1;
  double physics_rate_hz = 500.0;
};

struct Sample {
  double t_s = 0.0;
  RigidBodyState body;
  control::NavigationEstimate estimate;
  Controls controls;

  Eigen::Vector3d v_WB_W() const { return body.q_WB * body.v_WB_B; }
  Eigen::Vector3d v_WB_W_est() const { return estimate.q_WB_est * estimate.v_WB_B_est; }
  Eigen::Vector3d rpy() const { return to_roll_pitch_heading(body.q_WB); }
  /// Returns the small rotation about B's axes from the estimate to the truth.
  Eigen::Vector3d attitude_error() const {
    const Eigen::AngleAxisd error(estimate.q_WB_est.conjugate() * body.q_WB);
    return wrap_angle(error.angle()) * error.axis();
  }
};

/// Flies from a trimmed hover 10 m above W's origin and returns a sample per control tick (100 Hz).
inline std::vector<Sample> fly(const Loop& loop, double duration_s,
                               const std::function<control::Setpoint(double t_s)>& setpoint) {
  const double dt = 1.0 / loop.physics_rate_hz;
  const auto seed = [&](std::string_view name) { return seed_of(loop.seed, name); };
  Vehicle vehicle(loop.vehicle);
  Avionics avionics(loop.avionics, loop.designed_for.value_or(loop.vehicle), dt, seed);
  control::Autopilot autopilot(loop.avionics.autopilot, loop.designed_for.value_or(loop.vehicle));
  air::Wind weather(loop.weather.value_or(air::WindConfig{}), seed("wind"));
  RandomStream flow(seed("flow"));

  const auto wind_W = [&](double t_s) {
    const RigidBodyState& b = vehicle.body();
    return loop.weather ? weather.sample(-b.p_WB.z(), b.q_WB * b.v_WB_B, dt) : loop.wind_W(t_s);
  };
  vehicle.reset({0.0, 0.0, -10.0}, loop.heading_rad, loop.weather ? weather.steady_W(10.0) : loop.wind_W(0.0));
  const auto truth = [&] {
    const RigidBodyState& b = vehicle.body();
    return SensedTruth{b, vehicle.specific_force_B(), -b.p_WB.z() - loop.surface_m(b.p_WB)};
  };
  avionics.reset(truth());
  const auto known = [&] {
    control::NavigationEstimate e = avionics.navigation();
    if (loop.perfect) {
      const RigidBodyState& b = vehicle.body();
      e.p_WB_est = b.p_WB, e.q_WB_est = b.q_WB, e.v_WB_B_est = b.v_WB_B, e.w_WB_B_est = b.w_WB_B;
    }
    return e;
  };
  autopilot.reset(known());

  constexpr double kControlDt = 0.01;
  const int64_t per_control = std::llround(kControlDt / dt), per_flow = 2 * per_control;
  std::vector<Sample> samples;
  Controls controls;
  for (int64_t tick = 0; tick < std::llround(duration_s / dt); ++tick) {
    const double t_s = static_cast<double>(tick) * dt;
    VelocitySensor flow_velocity;
    if (loop.flow_sigma > 0.0 && tick % per_flow == 0) {
      flow_velocity = [&](const control::NavigationEstimate&) {
        const double forward = flow.normal(), right = flow.normal();
        return VelocityReading{vehicle.body().v_WB_B.head<2>() + loop.flow_sigma * Eigen::Vector2d(forward, right),
                               loop.flow_sigma};
      };
    }
    avionics.sense(std::llround(t_s * 1e9), truth(), flow_velocity);
    if (tick % per_control == 0) {
      controls = loop.perfect ? autopilot.control(setpoint(t_s), known(), kControlDt)
                              : avionics.control(setpoint(t_s), kControlDt);
      samples.push_back({t_s, vehicle.body(), known(), controls});
    }
    vehicle.step(controls, wind_W(t_s), dt);
  }
  return samples;
}

/// Time after which the initial errors have decayed.
inline constexpr double kSettledS = 2.0;

/// A square of velocities, a new side every 3 s, so that the aircraft accelerates all the time.
inline control::Setpoint square(double t_s) {
  constexpr double kSigns[4][2] = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}};
  const double(&s)[2] = kSigns[static_cast<int>(t_s / 3.0) % 4];
  return control::VelocitySetpoint{{1.5 * s[0], 1.5 * s[1]}, 10.0, 0.0};
}

/// Flights that differ only in the seed: 1, 2, ...
inline std::vector<std::vector<Sample>> flights(Loop loop, int count, double duration_s,
                                                const std::function<control::Setpoint(double)>& setpoint) {
  std::vector<std::vector<Sample>> all;
  for (int i = 0; i < count; ++i) {
    loop.seed = static_cast<uint64_t>(i) + 1;
    all.push_back(fly(loop, duration_s, setpoint));
  }
  return all;
}

}  // namespace hedgehop::dynamics
