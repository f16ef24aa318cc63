#include "dynamics/helicopter/induced_velocity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "dynamics/helicopter/helicopter.h"
#include "tests/dynamics/helicopter/helion.h"
#include "tests/dynamics/recorded_check.h"

namespace hedgehop::dynamics::helicopter {
namespace {

constexpr double kWeightN = 8.2 * 9.81;
constexpr double kPerMille = 1e-3;

const RotorDisc kXCell = make_model(HelicopterConfig{}).main_rotor.disc;
const double kHoverInflowMps = std::sqrt(kWeightN / (2.0 * kXCell.density_kgpm3 * kXCell.area_m2));

/// Returns the collective for a thrust, by bisection.
double collective_for(const RotorDisc& disc, double thrust_n, double upflow, double inplane) {
  double low = -1.0, high = 1.5;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (solve_inflow(disc, middle, upflow, inplane).thrust_n < thrust_n ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Returns v_i over hover inflow for a thrust equal to the weight.
double inflow_ratio(double upflow_over_vh, double inplane_over_vh) {
  RotorDisc disc = kXCell;
  disc.descent_limit = 0.6;
  const double w = upflow_over_vh * kHoverInflowMps, V = inplane_over_vh * kHoverInflowMps;
  return solve_inflow(disc, collective_for(disc, kWeightN, w, V), w, V).induced_mps / kHoverInflowMps;
}

// Check MT1.
TEST(InducedVelocity, MT1_XCellHoverMatchesMomentumTheory) {
  const RotorDisc& disc = kXCell;
  expect_recorded_relative("disc area, m2", disc.area_m2, 1.886919, kPerMille);
  expect_recorded_relative("tip speed, m/s", disc.tip_speed_mps, 129.425, kPerMille);
  expect_recorded_relative("C_T", kWeightN / (1.225 * disc.area_m2 * disc.tip_speed_mps * disc.tip_speed_mps),
                           0.00207758, kPerMille);
  const double theta = collective_for(disc, kWeightN, 0.0, 0.0);
  const Inflow hover = solve_inflow(disc, theta, 0.0, 0.0);
  expect_recorded_relative("v_h, m/s", hover.induced_mps, 4.17140, kPerMille);
  expect_recorded_relative("lambda", hover.induced_mps / disc.tip_speed_mps, 0.0322302, kPerMille);
  expect_recorded_relative("theta_c, deg", theta * 180.0 / std::numbers::pi, 5.4956, kPerMille);
  expect_recorded_relative("ideal power, W", hover.thrust_n * hover.induced_mps, 335.56, kPerMille);
  expect_recorded_relative("profile power, W", disc.profile_power_w, 716.26, kPerMille);
  expect_recorded_relative("shaft power, W", shaft_power_w(disc, hover, 0.0, 0.0), 335.56 + 716.26, kPerMille);
}

// Check MT2.
TEST(InducedVelocity, MT2_ClimbAndSlowDescentFollowTheQuadratic) {
  expect_recorded_relative("v_i/v_h, climb at 0.5 v_h", inflow_ratio(-0.5, 0.0), 0.78078, kPerMille);
  expect_recorded_relative("v_i/v_h, climb at v_h", inflow_ratio(-1.0, 0.0), 0.61803, kPerMille);
  expect_recorded_relative("v_i/v_h, climb at 2 v_h", inflow_ratio(-2.0, 0.0), 0.41421, kPerMille);
  expect_recorded_relative("v_i/v_h, descent at 0.5 v_h", inflow_ratio(0.5, 0.0), 1.28078, kPerMille);
}

// Check MT3.
TEST(InducedVelocity, MT3_EdgewiseFlowFollowsGlauert) {
  expect_recorded_relative("v_i/v_h, edgewise at v_h", inflow_ratio(0.0, 1.0), 0.78615, kPerMille);
  expect_recorded_relative("v_i/v_h, edgewise at 2 v_h", inflow_ratio(0.0, 2.0), 0.48587, kPerMille);
  expect_recorded_relative("v_i/v_h, edgewise at 3 v_h", inflow_ratio(0.0, 3.0), 0.33132, kPerMille);
  expect_recorded_relative("v_i/v_h, edgewise at 5 v_h", inflow_ratio(0.0, 5.0), 0.19984, kPerMille);
}

/// Returns dT/dw and dT/dtheta over the mass, in hover, by differences.
struct Heave {
  double Z_w, Z_col;
};
Heave heave(const RotorDisc& disc, double weight_n, double mass_kg) {
  const double theta = collective_for(disc, weight_n, 0.0, 0.0);
  const double h = 1e-4;
  const double T_w =
      (solve_inflow(disc, theta, h, 0.0).thrust_n - solve_inflow(disc, theta, -h, 0.0).thrust_n) / (2 * h);
  const double T_c =
      (solve_inflow(disc, theta + h, 0.0, 0.0).thrust_n - solve_inflow(disc, theta - h, 0.0, 0.0).thrust_n) / (2 * h);
  return {-T_w / mass_kg, -T_c / mass_kg};
}

// Check MT4.
TEST(InducedVelocity, MT4_HeaveDerivativesMatchTheClosedForm) {
  const Heave xcell = heave(kXCell, kWeightN, 8.2);
  expect_recorded_relative("X-Cell Z_w, 1/s", xcell.Z_w, -0.7924, 0.01);
  expect_recorded_relative("X-Cell Z_col, m/s2/rad", xcell.Z_col, -136.74, 0.01);
  const RotorDisc helion = make_helion().main_rotor.disc;
  const Heave other = heave(helion, 9.75 * 9.781, 9.75);
  expect_recorded_relative("HeLion Z_w, 1/s", other.Z_w, -0.7097, 0.01);
  expect_recorded_relative("HeLion Z_col, m/s2/rad", other.Z_col, -129.23, 0.01);
}

// Check MT5.
TEST(InducedVelocity, MT5_FlapBackIsThatOfIdealHover) {
  const double theta = collective_for(kXCell, kWeightN, 0.0, 0.0);
  const double lambda = solve_inflow(kXCell, theta, 0.0, 0.0).induced_mps / kXCell.tip_speed_mps;
  FlappingModel ideal;
  ideal.speed_gain = 1.0;
  expect_recorded("X-Cell flap-back per speed ratio, K_mu = 1", speed_flapping(ideal, theta, lambda), 0.191316, 1e-6);
}

constexpr double kFootM = 0.3048, kPoundN = 4.4482216, kHorsepowerW = 745.69987, kSlugFt2Kgm2 = 1.3558179;

/// The AH-1S of [HeffleyMnich1988] table of parameters, or its rotor at another radius.
RotorDisc ah_1s(double radius_ft) {
  return make_rotor_disc({.radius_m = radius_ft * kFootM,
                          .chord_m = 2.25 * kFootM,
                          .blades = 2,
                          .lift_slope_prad = 6.0,
                          .profile_drag = 0.01,
                          .profile_power_growth = 4.6,
                          .max_thrust_coefficient = 0.05},
                         324.0 * std::numbers::pi / 30.0, 1.225);
}
double hover_inflow_mps(const RotorDisc& disc, double weight_n) {
  return solve_inflow(disc, collective_for(disc, weight_n, 0.0, 0.0), 0.0, 0.0).induced_mps;
}

// Check MT6.
TEST(InducedVelocity, MT6_FullScaleHoversMatchPublishedValues) {
  constexpr double kHalfPercent = 0.005;
  const RotorDisc disc = ah_1s(22.0);
  const double weight_n = 9000.0 * kPoundN;
  const double v_h = hover_inflow_mps(disc, weight_n);
  expect_recorded_relative("AH-1S v_h, ft/s", v_h / kFootM, 35.29, kHalfPercent);
  expect_recorded_relative("AH-1S induced power, hp", weight_n * v_h / kHorsepowerW, 577.4, kHalfPercent);
  expect_recorded_relative("AH-1S profile power, hp", disc.profile_power_w / kHorsepowerW, 222.4, kHalfPercent);

  MainRotorConfig rotor;
  rotor.speed_radps = 324.0 * std::numbers::pi / 30.0;
  rotor.radius_m = 22.0 * kFootM;
  rotor.chord_m = 2.25 * kFootM;
  rotor.lift_slope_prad = 6.0;
  rotor.blade_inertia_kgm2 = 1382.0 * kSlugFt2Kgm2;
  const FlappingModel flapping = make_main_rotor(rotor, 1.225).flapping;
  expect_recorded_relative("AH-1S Lock number", flapping.lock_number, 5.439, kHalfPercent);
  expect_recorded_relative("AH-1S flapping rate, 1/s", 1.0 / flapping.blade_lag_s, 11.534, kHalfPercent);
  expect_recorded_relative("AH-1S flapping lag, s", flapping.blade_lag_s, 0.0867, kHalfPercent);

  // Weight and radius of an A109; the hover inflow depends on these only.
  expect_recorded_relative("A109 v_h, ft/s", hover_inflow_mps(ah_1s(18.0), 5401.0 * kPoundN) / kFootM, 33.41,
                           kHalfPercent);
}

/// Solves the same two equations by bisection on v_i, without limits.
double bisected_inflow(const RotorDisc& disc, double theta, double w_r, double V) {
  const auto excess = [&](double v_i) {
    const double blades = disc.lift_nspm * (w_r + 2.0 / 3.0 * disc.tip_speed_mps * theta - v_i);
    return 2.0 * disc.density_kgpm3 * disc.area_m2 * v_i * std::sqrt(V * V + (w_r - v_i) * (w_r - v_i)) - blades;
  };
  double low = 0.0, high = 60.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Check MT7.
TEST(InducedVelocity, MT7_SolverAgreesWithBisection) {
  double worst = 0.0;
  const auto compare = [&](double w_r, double V) {
    for (const double theta : {0.06, 0.096, 0.13}) {
      const Inflow inflow = solve_inflow(kXCell, theta, w_r, V);
      EXPECT_TRUE(inflow.within_momentum_theory) << theta << " " << w_r << " " << V;
      worst = std::max(worst, std::abs(inflow.induced_mps - bisected_inflow(kXCell, theta, w_r, V)));
    }
  };
  for (double V = 0.0; V <= 20.0; V += 0.5) compare(0.0, V);
  for (double climb = 0.0; climb <= 4.0; climb += 0.25) compare(-climb, 0.0);
  // In descent, momentum theory is valid up to half the hover inflow, so the thrust must be near the weight.
  for (double descent = 0.0; descent <= 1.5; descent += 0.25) {
    const double theta = collective_for(kXCell, kWeightN, descent, 0.0);
    worst = std::max(worst, std::abs(solve_inflow(kXCell, theta, descent, 0.0).induced_mps -
                                     bisected_inflow(kXCell, theta, descent, 0.0)));
  }
  expect_recorded_below("maximum difference from bisection, m/s", worst, 1e-6);
}

TEST(InducedVelocity, MT7_FiniteForAnyAirspeedUpTo40) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> speed(0.0, 40.0), cosine(-1.0, 1.0), collective(-0.35, 0.35);
  const HelicopterModel model = make_model(HelicopterConfig{});
  for (int i = 0; i < 200000; ++i) {
    const double v = speed(generator), c = cosine(generator), theta = collective(generator);
    for (const RotorDisc& disc : {model.main_rotor.disc, model.tail_rotor.disc}) {
      const Inflow inflow = solve_inflow(disc, theta, v * c, v * std::sqrt(1.0 - c * c));
      ASSERT_TRUE(std::isfinite(inflow.thrust_n) && std::isfinite(inflow.induced_mps)) << v << " " << c << " " << theta;
      ASSERT_LE(std::abs(inflow.thrust_n), disc.max_thrust_n * (1.0 + 1e-12));
      ASSERT_GE(inflow.thrust_n * inflow.induced_mps, 0.0);
    }
  }
}

TEST(InducedVelocity, ThrustSatisfiesBothTheoriesWithinTheirRange) {
  std::mt19937_64 generator(8);
  std::uniform_real_distribution<double> along(-8.0, 8.0), across(0.0, 30.0), collective(-0.2, 0.25);
  int valid = 0;
  for (int i = 0; i < 20000; ++i) {
    const double w = along(generator), V = across(generator), theta = collective(generator);
    const Inflow inflow = solve_inflow(kXCell, theta, w, V);
    if (!inflow.within_momentum_theory) continue;
    ++valid;
    const double v_i = inflow.induced_mps;
    const double momentum =
        2.0 * kXCell.density_kgpm3 * kXCell.area_m2 * v_i * std::sqrt(V * V + (w - v_i) * (w - v_i));
    const double blades = kXCell.lift_nspm * (w + 2.0 / 3.0 * kXCell.tip_speed_mps * theta - v_i);
    ASSERT_NEAR(inflow.thrust_n, momentum, 1e-7 * (1.0 + std::abs(momentum)));
    const double bounded = std::clamp(blades, -kXCell.max_thrust_n, kXCell.max_thrust_n);
    ASSERT_NEAR(inflow.thrust_n, bounded, 1e-7 * (1.0 + std::abs(bounded)));
  }
  EXPECT_GT(valid, 10000);
}

TEST(InducedVelocity, ReportsADescentOutsideMomentumTheory) {
  const double theta = collective_for(kXCell, kWeightN, 0.0, 0.0);
  EXPECT_TRUE(solve_inflow(kXCell, theta, 0.4 * kHoverInflowMps, 0.0).within_momentum_theory);
  EXPECT_FALSE(solve_inflow(kXCell, theta, 1.0 * kHoverInflowMps, 0.0).within_momentum_theory);
  EXPECT_TRUE(solve_inflow(kXCell, theta, 1.0 * kHoverInflowMps, 15.0).within_momentum_theory);
}

TEST(InducedVelocity, ThrustHasNoJumps) {
  // Across the limits of descent rate and advance ratio, and through zero thrust.
  double before = solve_inflow(kXCell, 0.096, 0.0, 0.0).thrust_n;
  for (int i = 1; i <= 40000; ++i) {
    const double s = i / 40000.0;
    const double now = solve_inflow(kXCell, 0.096 - 0.25 * s, 10.0 * s, 20.0 * s * s).thrust_n;
    ASSERT_LT(std::abs(now - before), 0.1) << s;
    before = now;
  }
}

}  // namespace
}  // namespace hedgehop::dynamics::helicopter
