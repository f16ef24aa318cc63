#include "dynamics/helicopter/flapping.h"

#include <gtest/gtest.h>

#include <string>

#include <cmath>

#include "dynamics/helicopter/helicopter.h"
#include "dynamics/helicopter/trim.h"
#include "dynamics/rigid_body.h"
#include "tests/dynamics/helicopter/helion.h"
#include "tests/dynamics/recorded_check.h"

namespace hedgehop::dynamics::helicopter {
namespace {

/// HeLion's rotor with an explicit bar; gains are per unit of stick.
MainRotorConfig helion(double hub_stiffness_nmprad) {
  MainRotorConfig c = helion_main_rotor();
  c.hub_stiffness_nmprad = hub_stiffness_nmprad;
  return c;
}
constexpr double kHelionDensity = 1.292;

/// The same with the bar lumped into the rotor: sums of lags and gains.
MainRotorConfig lumped_helion() {
  MainRotorConfig c = helion(0.0);
  c.flybar =
      LumpedBarConfig{.lock_number = 16.0 / (0.297093 * 193.73), .lateral_gain = 0.77, .longitudinal_gain = 0.77};
  return c;
}

FlapState settle(const FlappingModel& model, const FlapInput& input) {
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  const auto rate = [&](double, const Eigen::Vector4d& y) {
    return derivative(model, FlapState{y[0], y[1], y[2], y[3]}, input);
  };
  for (int i = 0; i < 5000; ++i) x = rk4_step<4>(x, 0.0, 0.002, rate);
  return {x[0], x[1], x[2], x[3]};
}

// Check TC1.
TEST(Flapping, TC1_XCellTimeConstants) {
  const FlappingModel m = make_main_rotor({}, 1.225).flapping;
  expect_recorded_relative("tau_e, s", m.lag_s, 0.119760, 1e-3);
  expect_recorded_relative("gamma", m.lock_number, 3.7098, 1e-3);
  expect_recorded_relative("tau_f, s", m.blade_lag_s, 0.025826, 1e-3);
  expect_recorded_relative("A_b", m.cross_coupling, 0.10988, 1e-3);
}

// Check TC2.
TEST(Flapping, TC2_HeLionTimeConstants) {
  const FlappingModel m = make_main_rotor(helion_main_rotor(), kHelionDensity).flapping;
  expect_recorded_relative("gamma", m.lock_number, 1.98668, 1e-3);
  expect_recorded_relative("tau_f, s", m.lag_s, 0.056542, 1e-3);
  expect_recorded_relative("gamma_s", 16.0 / (m.bar_lag_s * 193.73), 0.343334, 1e-3);
  expect_recorded_relative("tau_s, s", m.bar_lag_s, 0.240551, 1e-3);
  expect_recorded_relative("A_b", m.cross_coupling, 0.221986, 1e-3);
  expect_recorded_relative("tau lumped, s", make_helion().main_rotor.flapping.lag_s, 0.297093, 1e-3);
}

// Check TC3.
TEST(Flapping, TC3_XCellOfTheAutopilotProject) {
  MainRotorConfig c;
  c.speed_radps = 157.08;
  c.radius_m = 0.6858;
  c.chord_m = 0.0603;
  c.lift_slope_prad = 6.0;
  c.blade_inertia_kgm2 = 0.1148;
  c.hinge_offset_m = 0.0;  // the published value is without hinge offset
  const FlappingModel m = make_main_rotor(c, 1.225).flapping;
  expect_recorded_relative("gamma", m.lock_number, 0.8540, 1e-3);
  expect_recorded_relative("tau_f, s", m.blade_lag_s, 0.1193, 1e-3);
}

// Check TC4.
TEST(Flapping, TC4_BarLagsBehindARotatingShaft) {
  const double q = 0.1;
  for (const bool lumped : {false, true}) {
    const std::string bar = lumped ? "lumped bar: " : "explicit bar: ";
    const FlappingModel m = make_main_rotor(lumped ? lumped_helion() : helion(0.0), kHelionDensity).flapping;
    expect_recorded_relative(bar + "a/q, s", settle(m, {.pitch_radps = q}).back_rad / q, -0.297093, 1e-3);
    expect_recorded_relative(bar + "b/p, s", settle(m, {.roll_radps = q}).right_rad / q, -0.297093, 1e-3);
  }
}

TEST(Flapping, TC4_CyclicTiltsTheDiscByBothPaths) {
  for (const bool lumped : {false, true}) {
    const std::string bar = lumped ? "lumped bar: " : "explicit bar: ";
    const FlappingModel m = make_main_rotor(lumped ? lumped_helion() : helion(0.0), kHelionDensity).flapping;
    expect_recorded_relative(bar + "b per lateral stick, rad", settle(m, {.lateral_rad = 1.0}).right_rad, 0.77, 1e-3);
    expect_recorded_relative(bar + "a per longitudinal stick, rad", settle(m, {.longitudinal_rad = 1.0}).back_rad, 0.77,
                             1e-3);
  }
}

TEST(Flapping, HubSpringCouplesTheAxesOfAnExplicitBar) {
  const FlappingModel m = make_main_rotor(helion(113.7942), kHelionDensity).flapping;
  EXPECT_LT(settle(m, {.lateral_rad = 1.0}).back_rad * settle(m, {.longitudinal_rad = 1.0}).right_rad, 0.0);
}

TEST(Flapping, SteadyCyclicStopsTheDisc) {
  for (const MainRotorConfig& config : {MainRotorConfig{}, helion(113.7942)}) {
    const FlappingModel m = make_main_rotor(config, 1.225).flapping;
    FlapInput in{.collective_rad = 0.1,
                 .inflow_ratio = 0.03,
                 .forward_ratio = 0.1,
                 .right_ratio = -0.05,
                 .down_ratio = 0.02,
                 .roll_radps = 0.3,
                 .pitch_radps = -0.2};
    FlapState flap{0.02, -0.01, 0.0, 0.0};
    const Eigen::Vector2d cyclic = steady_cyclic(m, flap, in);
    in.lateral_rad = cyclic[0];
    in.longitudinal_rad = cyclic[1];
    EXPECT_LT(derivative(m, flap, in).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(Flapping, DefaultExplicitBarHasLagAndGainOfTheDefaultLumpedOne) {
  MainRotorConfig bar;
  bar.flybar = ExplicitBarConfig{};
  bar.hub_stiffness_nmprad = 0.0;  // no cross coupling, which the lumped bar neglects
  const FlappingModel m = make_main_rotor(bar, 1.225).flapping;
  EXPECT_NEAR(settle(m, {.pitch_radps = 1.0}).back_rad, -0.11976, 1e-3);
  EXPECT_NEAR(settle(m, {.lateral_rad = 1.0}).right_rad, 4.2, 1e-3);
}

TEST(Flapping, HelicopterWithAnExplicitBarHasATrim) {
  HelicopterConfig config;
  config.main_rotor.flybar = ExplicitBarConfig{};
  const HelicopterModel model = make_model(config);
  const std::optional<Trim> hover = trim(model, {3.0, 2.0, 0.0});
  ASSERT_TRUE(hover);
  const HelicopterVector rate = derivative(model, hover->state, hover->blades, Eigen::Vector3d::Zero());
  EXPECT_LT(rate.tail<14>().cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace hedgehop::dynamics::helicopter
