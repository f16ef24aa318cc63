#pragma once

#include <Eigen/Core>

#include "dynamics/air/dryden.h"
#include "dynamics/air/gust.h"
#include "sim/fields/field.h"
#include "sim/libm/random.h"

namespace hedgehop::dynamics::air {

/// A steady horizontal wind, Dryden turbulence and one gust. Each is set on its own, so that it can be studied alone;
/// by [MIL8785C] sec. 3.7.3 W20 15, 30 and 45 kt (7.7, 15.4, 23.2 m/s) are light, moderate and severe.
struct WindConfig {
  double speed_mps = 0.0;           ///< with shear, at 20 ft
  double from_rad = 0.0;            ///< heading the wind comes from, from north to east
  double spread_rad = 0.0;          ///< the seed draws that heading within this of `from_rad`
  double roughness_m = 0.0;         ///< height below which the air is still; 0 for a wind without shear
  double turbulence_w20_mps = 0.0;  ///< wind at 20 ft that sets the turbulence; 0 for smooth air
  GustConfig gust;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<WindConfig> auto& c) {
  v("speed", c.speed_mps,
    {.unit = "m/s", .at_least = 0.0, .at_most = 30.0, .meaning = "steady wind, at 20 ft if sheared"});
  v("from", c.from_rad,
    {.unit = "deg",
     .at_least = -360.0,
     .at_most = 360.0,
     .meaning = "heading the steady wind comes from, from north to east"});
  v("spread", c.spread_rad,
    {.unit = "deg",
     .at_least = 0.0,
     .at_most = 180.0,
     .meaning = "the steady wind's heading is drawn by the seed, within this of 'from'; 180: from anywhere"});
  v("roughness", c.roughness_m,
    {.unit = "m",
     .at_least = 0.0,
     .at_most = 5.0,  // clearly below 20 ft
     .meaning = "roughness length of a logarithmic wind shear: 0.046 at airfields, 0.61 elsewhere, 0 no shear"});
  v("turbulence_w20", c.turbulence_w20_mps,
    {.unit = "m/s",
     .at_least = 0.0,
     .at_most = 30.0,
     .meaning = "wind at 20 ft that sets the turbulence: 7.7 light, 15.4 moderate, 23.2 severe, 0 none"});
  v("gust", c.gust, {.meaning = "one gust of 1-cosine shape"});
}

/// The air one vehicle meets. Equal seeds and equal arguments give equal sequences, bit for bit.
class Wind {
 public:
  /// Throws std::invalid_argument "<key>: ..." on values out of bounds.
  Wind(const WindConfig& config, uint64_t seed);

  /// The steady wind in W, m/s. @param height_m  above ground; below the roughness the air is still, above 1000 ft
  /// the wind is uniform. Source: [MIL8785C] sec. 3.7.3.
  Eigen::Vector3d steady_W(double height_m) const;

  /// Moves turbulence and gust on by dt and returns the velocity of the air in W, m/s. The first call begins a flight.
  /// @param height_m   above ground. @param v_WB_W  velocity of the vehicle over ground, m/s. @param dt_s  > 0.
  /// The vehicle flies through frozen fields at the greater of its mean airspeed and 1 m/s. The filters are exact for
  /// any dt and keep their variance when airspeed or height change. Source: [MIL8785C] sec. 3.7.1.2, Dryden form.
  Eigen::Vector3d sample(double height_m, const Eigen::Vector3d& v_WB_W, double dt_s);

 private:
  void draw_stationary();
  Eigen::Vector3d turbulence_W(double height_m, double path_m);
  void move(Eigen::Vector2d& z, const SecondOrderStep& step);

  WindConfig config_;
  Eigen::Vector3d steady_W_;  ///< without shear, or at 20 ft
  Eigen::Vector3d gust_along_W_;
  Eigen::Matrix3d R_WT_;  ///< T: axes of the turbulence, x along the steady wind, z down
  RandomStream noise_;
  double u_ = 0.0;  ///< filter states, scaled to unit stationary variance
  Eigen::Vector2d v_ = Eigen::Vector2d::Zero(), w_ = Eigen::Vector2d::Zero();
  double t_s_ = 0.0, gust_path_m_ = 0.0;  ///< since the flight began, since the gust was met
};

}  // namespace hedgehop::dynamics::air
