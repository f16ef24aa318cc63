#pragma once

#include <Eigen/Core>

#include "sim/fields/field.h"
#include "sim/libm/random.h"

/// Wind, turbulence and gusts.
namespace hedgehop::dynamics::air {

/// One horizontal gust of 1-cosine shape: it rises over a length, holds, and falls over the same length.
struct GustConfig {
  double speed_mps = 0.0;  ///< maximum; 0 for no gust
  double from_rad = 0.0;   ///< heading it comes from, from north to east
  double start_s = 0.0;    ///< flight time at which the aircraft enters it
  double length_m = 20.0;  ///< distance through the air from zero to maximum speed
  double hold_m = 0.0;     ///< distance at maximum speed
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<GustConfig> auto& c) {
  v("speed", c.speed_mps,
    {.unit = "m/s", .at_least = 0.0, .at_most = 30.0, .meaning = "maximum speed of the gust; 0 for none"});
  v("from", c.from_rad,
    {.unit = "deg",
     .at_least = -360.0,
     .at_most = 360.0,
     .meaning = "heading that the gust comes from, from north to east"});
  v("start", c.start_s, {.unit = "s", .at_least = 0.0, .meaning = "flight time at which the vehicle enters the gust"});
  v("length", c.length_m,
    {.unit = "m", .above = 0.0, .meaning = "distance through the air over which the gust rises, and falls"});
  v("hold", c.hold_m, {.unit = "m", .at_least = 0.0, .meaning = "distance through the air at maximum speed"});
}

/// Returns the gust's speed at a distance behind its front, m/s: 0 before the front and beyond the gust.
/// @param path_m  distance through the air. Source: [MIL8785C] sec. 3.7.1.3. Differs: the speed falls again as it rose;
/// in the standard it stays.
double gust_speed_mps(const GustConfig& config, double path_m);

/// Scale lengths and intensities of turbulence below 1000 ft: u along the mean wind, v across it, w down.
struct DrydenScales {
  double length_uv_m = 0.0, length_w_m = 0.0;
  double sigma_uv_mps = 0.0, sigma_w_mps = 0.0;
};
/// @param height_m  above ground; clamped to 10..1000 ft. @param w20_mps  wind at 20 ft, >= 0.
/// Source: [MIL8785C] sec. 3.7.3, low altitude.
DrydenScales dryden_scales(double height_m, double w20_mps);

/// One step of the shaping filter of the u gusts, H = sqrt(2L/V) / (1 + s L/V) scaled to unit variance:
/// z' = decay z + noise eta, output z. Exact for any step.
struct FirstOrderStep {
  double decay = 1.0, noise = 0.0;
};
/// @param path  V dt / L, >= 0: distance flown in one step, divided by the scale length.
FirstOrderStep first_order_step(double path);

/// One step of the shaping filter of the v and w gusts, H = sqrt(L/V) (1 + sqrt(3) s L/V) / (1 + s L/V)^2 scaled to
/// unit variance: z' = decay z + noise eta, with two unit normals eta. For any step, each state has unit stationary
/// variance and their correlation is 1/sqrt(2). V and L may therefore change during a flight.
struct SecondOrderStep {
  Eigen::Matrix2d decay = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d noise = Eigen::Matrix2d::Zero();  ///< lower triangular
};
SecondOrderStep second_order_step(double path);
/// Returns the row that gives the output of the second-order filter when multiplied by z.
Eigen::RowVector2d second_order_output();

/// A steady horizontal wind, Dryden turbulence and one gust, each set separately. By [MIL8785C] sec. 3.7.3, W20 of 15,
/// 30 and 45 kt (7.7, 15.4, 23.2 m/s) is light, moderate and severe turbulence.
struct WindConfig {
  double speed_mps = 0.0;           ///< of the steady wind; with shear, at 20 ft
  double from_rad = 0.0;            ///< heading that the wind comes from, from north to east
  double spread_rad = 0.0;          ///< maximum difference between the drawn heading and `from_rad`
  double roughness_m = 0.0;         ///< roughness length, below which the air is at rest; 0 for no shear
  double turbulence_w20_mps = 0.0;  ///< wind at 20 ft that sets the turbulence; 0 for none
  GustConfig gust;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<WindConfig> auto& c) {
  v("speed", c.speed_mps,
    {.unit = "m/s", .at_least = 0.0, .at_most = 30.0, .meaning = "steady wind speed; with shear, at 20 ft"});
  v("from", c.from_rad,
    {.unit = "deg",
     .at_least = -360.0,
     .at_most = 360.0,
     .meaning = "heading that the steady wind comes from, from north to east"});
  v("spread", c.spread_rad,
    {.unit = "deg",
     .at_least = 0.0,
     .at_most = 180.0,
     .meaning = "maximum difference between 'from' and the heading that the seed draws; 180 for any heading"});
  v("roughness", c.roughness_m,
    {.unit = "m",
     .at_least = 0.0,
     .at_most = 5.0,  // clearly below 20 ft
     .meaning = "roughness length of a logarithmic wind shear: 0.046 at airfields, 0.61 elsewhere, 0 for no shear"});
  v("turbulence_w20", c.turbulence_w20_mps,
    {.unit = "m/s",
     .at_least = 0.0,
     .at_most = 30.0,
     .meaning = "wind at 20 ft that sets the turbulence: 7.7 light, 15.4 moderate, 23.2 severe, 0 for none"});
  v("gust", c.gust, {.meaning = "one gust of 1-cosine shape"});
}

/// Velocity of the air around one vehicle. Equal seeds and equal arguments give equal bits.
class Wind {
 public:
  /// Throws std::invalid_argument "<key>: ..." on values out of bounds.
  Wind(const WindConfig& config, uint64_t seed);

  /// Returns the steady wind in W, m/s: zero below the roughness length, constant above 1000 ft.
  /// @param height_m  above ground. Source: [MIL8785C] sec. 3.7.3.
  Eigen::Vector3d steady_W(double height_m) const;

  /// Advances turbulence and gust by dt and returns the velocity of the air in W, m/s. The first call starts a flight.
  /// @param height_m  above ground. @param v_WB_W  velocity of the vehicle over ground, m/s. @param dt_s  > 0.
  /// The vehicle flies through frozen fields at its mean airspeed, at least 1 m/s. The filters are exact for any dt and
  /// keep their variance if airspeed or height change. Source: [MIL8785C] sec. 3.7.1.2, Dryden form.
  Eigen::Vector3d sample(double height_m, const Eigen::Vector3d& v_WB_W, double dt_s);
  /// Stops the time of the gust until start_gust(), for a vehicle that is not yet in flight.
  void delay_gust() { gust_runs_ = false; }
  /// Lets the time of the gust run.
  void start_gust() { gust_runs_ = true; }

 private:
  void draw_stationary();
  Eigen::Vector3d turbulence_W(double height_m, double path_m);
  void advance(Eigen::Vector2d& z, const SecondOrderStep& step);

  WindConfig config_;
  Eigen::Vector3d steady_W_;  ///< without shear, or at 20 ft
  Eigen::Vector3d gust_along_W_;
  Eigen::Matrix3d R_WT_;  ///< T: axes of the turbulence, x along the steady wind, z down
  RandomStream noise_;
  double u_ = 0.0;  ///< filter states, scaled to unit stationary variance
  Eigen::Vector2d v_ = Eigen::Vector2d::Zero(), w_ = Eigen::Vector2d::Zero();
  bool gust_runs_ = true;
  double t_s_ = 0.0, gust_path_m_ = 0.0;  ///< since the start of the flight, since the front of the gust
};

}  // namespace hedgehop::dynamics::air
