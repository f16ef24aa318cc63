#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

#include "dynamics/dryden.h"

namespace hedgehop::dynamics {

/// A steady horizontal wind with Dryden turbulence upon it. Turbulence and steady wind are set apart, so that each can
/// be studied alone; by [MIL8785C] sec. 3.7.3 W20 15, 30 and 45 kt (7.7, 15.4, 23.2 m/s) are light, moderate and
/// severe.
struct WindConfig {
  double speed_mps = 0.0;
  double from_rad = 0.0;            ///< heading the wind comes from, from north to east
  double turbulence_w20_mps = 0.0;  ///< wind at 20 ft that sets the turbulence; 0 for smooth air
};
template <class Visitor>
void describe(Visitor& v, WindConfig& c) {
  v("speed", c.speed_mps, {.unit = "m/s", .at_least = 0.0, .at_most = 30.0, .meaning = "steady wind"});
  v("from", c.from_rad,
    {.unit = "deg",
     .at_least = -360.0,
     .at_most = 360.0,
     .meaning = "heading the steady wind comes from, from north to east"});
  v("turbulence_w20", c.turbulence_w20_mps,
    {.unit = "m/s",
     .at_least = 0.0,
     .at_most = 30.0,
     .meaning = "wind at 20 ft that sets the turbulence: 7.7 light, 15.4 moderate, 23.2 severe, 0 none"});
}

/// The air one vehicle meets. Equal seeds and equal arguments give equal sequences, bit for bit.
class Wind {
 public:
  /// Throws std::invalid_argument when a value is not finite, or a speed is negative.
  Wind(const WindConfig& config, uint64_t seed);

  const Eigen::Vector3d& steady_W() const { return steady_W_; }

  /// Moves the turbulence on by dt and returns the velocity of the air in W, m/s.
  /// @param height_m   above ground. @param v_WB_W  velocity of the vehicle over ground, m/s. @param dt_s  > 0.
  /// The vehicle flies through a frozen field at the greater of its mean airspeed and 1 m/s. The filters are exact for
  /// any dt and keep their variance when airspeed or height change. Source: [MIL8785C] sec. 3.7.1.2, Dryden form.
  Eigen::Vector3d sample(double height_m, const Eigen::Vector3d& v_WB_W, double dt_s);

 private:
  double normal() { return normal_(generator_); }
  void draw_stationary();
  void move(Eigen::Vector2d& z, const SecondOrderStep& step);

  WindConfig config_;
  Eigen::Vector3d steady_W_;
  Eigen::Matrix3d R_WT_;  ///< T: turbulence axes, x along the steady wind, z down
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
  double u_ = 0.0;  ///< filter states, scaled to unit stationary variance
  Eigen::Vector2d v_ = Eigen::Vector2d::Zero(), w_ = Eigen::Vector2d::Zero();
};

}  // namespace hedgehop::dynamics
