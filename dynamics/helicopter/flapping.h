#pragma once

#include <Eigen/Core>
#include <string_view>
#include <variant>

#include "sim/fields/field.h"

/// First-order flapping of the main rotor's disc and its Bell-Hiller stabilizer bar.
namespace hedgehop::dynamics::helicopter {

/// Rotor and bar lumped into one: they share one lag. Source: [Gavrilets2015] sec. on flapping.
struct LumpedBarConfig {
  static constexpr std::string_view kName = "lumped";
  static constexpr std::string_view kMeaning = "rotor and stabilizer bar lumped into one response with one lag";
  double lock_number = 0.8;   ///< effective gamma_fb
  double lateral_gain = 4.2;  ///< disc tilt per cyclic, rad/rad
  double longitudinal_gain = 4.2;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LumpedBarConfig> auto& c) {
  v("lock_number", c.lock_number, {.above = 0.0, .meaning = "effective Lock number of rotor and bar"});
  v("lateral_gain", c.lateral_gain, {.above = 0.0, .meaning = "steady disc tilt right per lateral cyclic, rad/rad"});
  v("longitudinal_gain", c.longitudinal_gain,
    {.above = 0.0, .meaning = "steady disc tilt back per longitudinal cyclic, rad/rad"});
}

/// The bar as a second, slower rotor that acts on the blade pitch. Source: [MettlerTischlerKanade2002] sec. on the
/// stabilizer bar. The defaults are estimates: the default helicopter has the lag and gain of its lumped bar.
struct ExplicitBarConfig {
  static constexpr std::string_view kName = "explicit";
  static constexpr std::string_view kMeaning =
      "rotor and stabilizer bar flap separately; the bar acts on the blade pitch";
  double mixing = 1.0;                   ///< K_s, disc tilt per bar tilt
  double lateral_gain = 1.145;           ///< B_lat, cyclic directly to the blades, rad/rad
  double longitudinal_gain = 1.145;      ///< A_lon
  double bar_lateral_gain = 3.055;       ///< D_lat, cyclic to the bar, rad/rad
  double bar_longitudinal_gain = 3.055;  ///< C_lon
  double paddle_inner_radius_m = 0.22;
  double paddle_outer_radius_m = 0.30;
  double paddle_chord_m = 0.055;
  double paddle_lift_slope_prad = 3.0;
  double bar_inertia_kgm2 = 0.001141;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ExplicitBarConfig> auto& c) {
  v("mixing", c.mixing, {.at_least = 0.0, .meaning = "blade pitch per bar tilt as disc tilt, rad/rad"});
  v("lateral_gain", c.lateral_gain, {.at_least = 0.0, .meaning = "lateral cyclic directly to the blades, rad/rad"});
  v("longitudinal_gain", c.longitudinal_gain,
    {.at_least = 0.0, .meaning = "longitudinal cyclic directly to the blades, rad/rad"});
  v("bar_lateral_gain", c.bar_lateral_gain, {.at_least = 0.0, .meaning = "lateral cyclic to the bar, rad/rad"});
  v("bar_longitudinal_gain", c.bar_longitudinal_gain,
    {.at_least = 0.0, .meaning = "longitudinal cyclic to the bar, rad/rad"});
  v("paddle_inner_radius", c.paddle_inner_radius_m,
    {.unit = "m", .at_least = 0.0, .meaning = "radius of the inner end of the paddles"});
  v("paddle_outer_radius", c.paddle_outer_radius_m,
    {.unit = "m", .above = 0.0, .meaning = "radius of the outer end of the paddles"});
  v("paddle_chord", c.paddle_chord_m, {.unit = "m", .above = 0.0, .meaning = "chord of the paddles"});
  v("paddle_lift_slope", c.paddle_lift_slope_prad,
    {.unit = "1/rad", .above = 0.0, .meaning = "lift per angle of the paddles"});
  v("bar_inertia", c.bar_inertia_kgm2,
    {.unit = "kg m2", .above = 0.0, .meaning = "moment of inertia of the bar about its hinge"});
}
using FlybarConfig = std::variant<LumpedBarConfig, ExplicitBarConfig>;

/// Tilt of disc and bar relative to the shaft, rad: back and right positive.
struct FlapState {
  double back_rad = 0.0, right_rad = 0.0;          ///< a, b of the disc
  double bar_back_rad = 0.0, bar_right_rad = 0.0;  ///< c, d of the bar; unused if lumped
};

/// Coefficients of the flapping equations for either kind of bar.
struct FlappingModel {
  bool explicit_bar = false;
  double clockwise = 1.0;       ///< s_R, +1 for a rotor that turns clockwise seen from above
  double lag_s = 0.1;           ///< tau_e of the lumped rotor, tau_f of the bare one
  double lock_number = 1.0;     ///< of the blades alone
  double blade_lag_s = 0.1;     ///< tau_f of the blades alone
  double cross_coupling = 0.0;  ///< A_b
  double longitudinal_gain = 1.0, lateral_gain = 1.0;
  double bar_lag_s = 1.0, mixing = 0.0, bar_longitudinal_gain = 0.0, bar_lateral_gain = 0.0;
  double speed_gain = 0.0;          ///< K_mu, flap-back per advance ratio
  double lift_solidity_prad = 0.1;  ///< a sigma
};

/// Returns the same rotor at `ratio` times its speed: lags fall, and the gains of a lumped bar grow with the square of
/// the speed. Source: as derivative().
FlappingModel at_speed(FlappingModel model, double ratio);

/// Inputs of the flapping equations, in B.
struct FlapInput {
  double lateral_rad = 0.0, longitudinal_rad = 0.0;
  double collective_rad = 0.0;
  double inflow_ratio = 0.0;                                        ///< lambda = v_i / (Omega R)
  double forward_ratio = 0.0, right_ratio = 0.0, down_ratio = 0.0;  ///< hub's air velocity over Omega R
  double roll_radps = 0.0, pitch_radps = 0.0;
};

/// Returns the time derivatives of the four tilts, in the order of FlapState. Source: [Gavrilets2015] sec. on
/// flapping for the lumped bar and the speed terms, [MettlerTischlerKanade2002] sec. on the stabilizer bar for the
/// explicit one.
/// Differs: the lateral speed term has the sign that tilts the disc away from the motion (L_v < 0).
Eigen::Vector4d derivative(const FlappingModel& model, const FlapState& flap, const FlapInput& input);

/// Return the backward disc tilt per forward advance ratio, and per vertical one. Source: as derivative().
double speed_flapping(const FlappingModel& model, double collective_rad, double inflow_ratio);
double heave_flapping(const FlappingModel& model, double advance_ratio);

/// Returns the cyclic (lateral, longitudinal, rad) that holds the disc at these tilts, and sets the bar tilts in `flap`
/// to their steady values. The cyclic in `input` is not used.
Eigen::Vector2d steady_cyclic(const FlappingModel& model, FlapState& flap, const FlapInput& input);

}  // namespace hedgehop::dynamics::helicopter
