#pragma once

#include <initializer_list>
#include <numbers>
#include <utility>

#include "dynamics/multicopter/multicopter.h"

/// Multicopters with published parameters, for tests.
namespace hedgehop::dynamics {

using Turns = multicopter::ArmConfig::Turns;
inline constexpr double kDeg = std::numbers::pi / 180.0;

// [FurrerBurriAchtelikSiegwart2016] table of parameters in the model file; the default.
inline multicopter::MulticopterConfig hummingbird_a() { return {}; }

// [FolkPaulosKumar2023] table of the Hummingbird's parameters: another set.
inline multicopter::MulticopterConfig hummingbird_b() {
  multicopter::MulticopterConfig c;
  c.mass = {0.5, {3.65e-3, 3.68e-3, 7.03e-3}, 0.0};
  c.arms = {{45 * kDeg, 0.17, Turns::clockwise},
            {135 * kDeg, 0.17, Turns::counter_clockwise},
            {-135 * kDeg, 0.17, Turns::clockwise},
            {-45 * kDeg, 0.17, Turns::counter_clockwise}};
  c.rotor.thrust_ns2 = 5.57e-6;
  c.rotor.torque_m = 1.36e-7 / 5.57e-6;
  c.rotor.drag_ns2pm = 1.19e-4;
  c.rotor.rolling_nms2pm = 0.0;
  c.rotor.axial_damping_ns2pm = 2.32e-4;
  c.rotor.translational_lift_ns2pm2 = 3.39e-3;
  c.rotor.time_constant_up_s = c.rotor.time_constant_down_s = 0.005;
  c.rotor.highest_radps = 1500.0;
  c.rotor.height_m = 0.0;
  c.body_drag_ns2pm2 = {0.005, 0.005, 0.01};
  return c;
}

// [FurrerBurriAchtelikSiegwart2016] table of parameters in the model file. The published yaw inertia, 0.0977, exceeds
// the sum of the other two, which is impossible; the sum is used instead.
inline multicopter::MulticopterConfig firefly() {
  multicopter::MulticopterConfig c;
  c.mass = {1.53, {0.0347563, 0.0458929, 0.0806492}, 0.0};
  c.arms.clear();
  for (const auto& [azimuth_deg, turns] :
       std::initializer_list<std::pair<double, Turns>>{{30.0, Turns::clockwise},
                                                       {90.0, Turns::counter_clockwise},
                                                       {150.0, Turns::clockwise},
                                                       {-150.0, Turns::counter_clockwise},
                                                       {-90.0, Turns::clockwise},
                                                       {-30.0, Turns::counter_clockwise}}) {
    c.arms.push_back({azimuth_deg * kDeg, 0.215, turns});
  }
  c.rotor.height_m = 0.037;
  c.rotor.inertia_kgm2 = 4.26e-6;
  return c;
}

inline multicopter::MulticopterConfig s900() {
  multicopter::MulticopterConfig c;
  c.mass = {4.606, {0.25665, 0.25024, 0.36309}, -0.00241};
  c.arms.clear();
  for (int i = 0; i < 6; ++i) {
    c.arms.push_back({(30.0 + 60.0 * i) * kDeg, 0.45, i % 2 == 0 ? Turns::clockwise : Turns::counter_clockwise});
  }
  c.rotor = {.thrust_ns2 = 6.54e-5,
             .torque_m = 0.024,
             .drag_ns2pm = 4e-4,
             .rolling_nms2pm = 0.0,
             .time_constant_up_s = 0.1,
             .time_constant_down_s = 0.1,
             .highest_radps = 612.0,
             .inertia_kgm2 = 3e-4,
             .radius_m = 0.1905,
             .tilt_in_rad = 8.0 * kDeg,
             .height_m = 0.115};
  c.body_drag_ns2pm2 = {0.03, 0.03, 0.06};
  return c;
}

}  // namespace hedgehop::dynamics
