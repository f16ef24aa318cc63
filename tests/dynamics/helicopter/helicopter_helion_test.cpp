#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "tests/dynamics/helicopter/helion.h"
#include "tests/dynamics/recorded_check.h"

namespace hedgehop::dynamics::helicopter {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

Trim helion_trim(double north_mps) {
  const std::optional<Trim> found = trim(make_helion(), {north_mps, 0.0, 0.0});
  EXPECT_TRUE(found) << north_mps;
  return found.value_or(Trim{});
}

// Check HT1.
TEST(Helion, HT1_HoverMatchesPublishedValues) {
  const Trim t = helion_trim(0.0);
  constexpr double kPrinted = 0.03;  // of the trim in [HeLionCode]
  expect_recorded_relative("phi, rad", t.roll_rad, 0.0389, kPrinted);
  expect_recorded_relative("theta, rad", t.pitch_rad, 0.000887, kPrinted);
  expect_recorded_relative("a, rad", t.state.flap.back_rad, -0.000874, kPrinted);
  expect_recorded_relative("b, rad", t.state.flap.right_rad, 0.0048, kPrinted);
}

TEST(Helion, HT1_HoverTrimInFull) {
  const Trim t = helion_trim(0.0);
  constexpr double kDerived = 0.002;
  expect_recorded_relative("phi, rad", t.roll_rad, 0.038943, kDerived);
  expect_recorded_relative("theta, rad", t.pitch_rad, 0.000887, kDerived);
  expect_recorded_relative("a, rad", t.state.flap.back_rad, -0.000874, kDerived);
  expect_recorded_relative("b, rad", t.state.flap.right_rad, 0.004921, kDerived);
  expect_recorded_relative("theta_c, deg", t.blades.collective_rad / kDeg, 5.941, kDerived);
  expect_recorded_relative("theta_t, deg", t.blades.tail_rad / kDeg, 8.185, kDerived);
  expect_recorded_relative("T, N", t.loads.main_rotor.inflow.thrust_n, 96.765, kDerived);
  expect_recorded_relative("v_i, m/s", t.loads.main_rotor.inflow.induced_mps, 4.8972, kDerived);
  expect_recorded_relative("P, W", t.loads.main_rotor.power_w, 839.96, kDerived);
  expect_recorded_relative("Q, N m", t.loads.main_rotor.power_w / 193.73, 4.3357, kDerived);
  expect_recorded_relative("T_tr, N", t.loads.tail_rotor.inflow.thrust_n, 4.1891, kDerived);
  expect_recorded_relative("tail v_i, m/s", t.loads.tail_rotor.inflow.induced_mps, 5.612, kDerived);
}

// Check HT2.
TEST(Helion, HT2_LevelFlight) {
  struct Row {
    double north_mps, collective_deg, tail_deg, roll_deg, pitch_deg, induced_mps, power_w;
  };
  const auto expect_angle = [](double value_rad, double expected_deg, const std::string& what) {
    expect_recorded(what, value_rad / kDeg, expected_deg, std::max(0.02, 0.005 * std::abs(expected_deg)));
  };
  for (const Row& row :
       {Row{-4.0, 5.476, 7.179, 2.049, 0.695, 4.130, 772.1}, Row{6.0, 5.080, 6.279, 1.913, -1.406, 3.413, 721.5},
        Row{14.0, 5.065, 6.052, 2.338, -7.405, 1.663, 888.2}}) {
    const std::string at = std::to_string(static_cast<int>(row.north_mps)) + " m/s: ";
    const Trim t = helion_trim(row.north_mps);
    expect_angle(t.blades.collective_rad, row.collective_deg, at + "theta_c, deg");
    expect_angle(t.blades.tail_rad, row.tail_deg, at + "theta_t, deg");
    expect_angle(t.roll_rad, row.roll_deg, at + "phi, deg");
    expect_angle(t.pitch_rad, row.pitch_deg, at + "theta, deg");
    expect_recorded_relative(at + "v_i, m/s", t.loads.main_rotor.inflow.induced_mps, row.induced_mps, 0.005);
    expect_recorded_relative(at + "P, W", t.loads.main_rotor.power_w, row.power_w, 0.005);
  }
}

// Check HT4.
TEST(Helion, HT4_HoversRightSideDownAndPitchesDownWithSpeed) {
  expect_recorded("phi in hover, deg", helion_trim(0.0).roll_rad / kDeg, 2.23, 0.02);
  double pitch = 1e9, inflow = 1e9;
  for (double V = 0.0; V <= 14.0; V += 1.0) {
    const Trim t = helion_trim(V);
    EXPECT_LT(t.pitch_rad, pitch) << V;
    EXPECT_LT(t.loads.main_rotor.inflow.induced_mps, inflow) << V;
    pitch = t.pitch_rad;
    inflow = t.loads.main_rotor.inflow.induced_mps;
  }
}

/// Expects an eigenvalue of A at a position.
void expect_mode(const Eigen::MatrixXd& A, std::complex<double> expected) {
  const Eigen::VectorXcd modes = A.eigenvalues();
  const std::complex<double> found = *std::min_element(
      modes.begin(), modes.end(), [&](auto a, auto b) { return std::abs(a - expected) < std::abs(b - expected); });
  expect_recorded("mode, real part, 1/s", found.real(), expected.real(),
                  std::max(0.01 * std::abs(expected.real()), 0.0005));
  if (expected.imag() == 0.0) {
    EXPECT_NEAR(found.imag(), 0.0, 1e-12) << expected;
  } else {
    expect_recorded_relative("and imaginary part, 1/s", found.imag(), expected.imag(), 0.01);
  }
}

// Check LM2.
TEST(Helion, LM2_ModesOfTheHover) {
  using L = LinearModel;
  const LinearModel m = linearize(make_helion(), helion_trim(0.0));
  expect_recorded_relative("L_b, 1/s2", m.A(L::kP, L::kDiscRight), 583.51, 0.01);
  expect_recorded_relative("M_a, 1/s2", m.A(L::kQ, L::kDiscBack), 267.01, 0.01);
  const Eigen::MatrixXd A = m.A.topLeftCorner<L::kBarBack, L::kBarBack>();
  for (const std::complex<double> mode : {std::complex<double>(-1.698, 24.10),
                                          {-1.719, 16.26},
                                          {-0.729, 0.0},
                                          {-0.3455, 0.093},
                                          {-0.0335, 0.0},
                                          {-0.008, 0.0},
                                          {0.032, 0.0}}) {
    expect_mode(A, mode);
  }
}

/// System of roll rate, disc and bar: dp/dt = L_b b, the rest from the flapping equations by differences.
Eigen::Matrix3d roll_subsystem(const FlappingModel& model, double L_b) {
  const auto rate = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    const Eigen::Vector4d flap = derivative(model, FlapState{0.0, x[1], 0.0, x[2]}, FlapInput{.roll_radps = x[0]});
    return {L_b * x[1], flap[1], flap[3]};
  };
  Eigen::Matrix3d A;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d dx = 1e-3 * Eigen::Vector3d::Unit(i);
    A.col(i) = (rate(dx) - rate(-dx)) / 2e-3;
  }
  return A;
}

TEST(Helion, LM2_StabilizerBarSlowsTheRollMode) {
  FlappingModel bar = make_main_rotor(helion_main_rotor(), 1.292).flapping;
  const Eigen::Matrix3d with_bar = roll_subsystem(bar, 583.51);
  expect_mode(with_bar, {-0.750, 25.02});
  expect_mode(with_bar, {-20.34, 0.0});
  bar.mixing = 0.0;
  expect_mode(roll_subsystem(bar, 583.51), {-8.843, 22.48});
}

// Check LM6.
TEST(Helion, LM6_RollRatePerStickAndHeaveAreInThePublishedBands) {
  using L = LinearModel;
  const HelionModel model = make_helion();
  const LinearModel m = linearize(model, helion_trim(0.0));
  // Steady roll rate and disc under a constant stick.
  Eigen::Matrix2d A;
  A << m.A(L::kP, L::kP), m.A(L::kP, L::kDiscRight), m.A(L::kDiscRight, L::kP), m.A(L::kDiscRight, L::kDiscRight);
  const Eigen::Vector2d B{m.B(L::kP, L::kLateral), m.B(L::kDiscRight, L::kLateral)};
  const double p_per_stick = -(A.inverse() * B)[0];
  expect_recorded_relative("p per stick, rad/s", p_per_stick, 2.592, 0.01);
  expect_recorded_relative("p per stick, rad/s, XCell Tempest, [AbbeelGanapathiNg2006] table of coefficients",
                           p_per_stick, 33.04 / 12.78, 0.01);
  expect_recorded_relative("Z_w, 1/s", m.A(L::kW, L::kW), -0.73, 0.01);
}

}  // namespace
}  // namespace hedgehop::dynamics::helicopter
