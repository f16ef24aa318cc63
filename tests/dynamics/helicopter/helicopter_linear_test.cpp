#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/helicopter/trim.h"
#include "dynamics/rigid_body.h"
#include "tests/dynamics/recorded_check.h"

namespace hedgehop::dynamics::helicopter {
namespace {

using L = LinearModel;

struct Hover {
  HelicopterModel model = make_model(HelicopterConfig{});
  Trim trim = *helicopter::trim(model, Eigen::Vector3d::Zero());
  LinearModel linear = linearize(model, trim);
};
const Hover& hover() {
  static const Hover h;
  return h;
}

/// Returns the eigenvalue nearest to an expected one; the lumped bar has none.
std::complex<double> mode_near(std::complex<double> where) {
  const Eigen::VectorXcd modes = hover().linear.A.topLeftCorner<L::kBarBack, L::kBarBack>().eigenvalues();
  return *std::min_element(modes.begin(), modes.end(),
                           [&](auto a, auto b) { return std::abs(a - where) < std::abs(b - where); });
}

// Check LM1.
TEST(HelicopterLinear, LM1_FastModesOfTheHover) {
  for (const auto& [name, expected] : {std::pair{"roll mode", std::complex<double>{-4.18, 19.69}},
                                       {"pitch mode", std::complex<double>{-4.18, 14.03}}}) {
    const std::complex<double> mode = mode_near(expected);
    expect_recorded_relative(std::string(name) + ", real part, 1/s", mode.real(), expected.real(), 0.01);
    expect_recorded_relative(std::string(name) + ", imaginary part, 1/s", mode.imag(), expected.imag(), 0.01);
  }
  expect_recorded_relative("roll mode, frequency, rad/s", std::abs(mode_near({-4.18, 19.69})), 20.12, 0.01);
  expect_recorded_relative("pitch mode, frequency, rad/s", std::abs(mode_near({-4.18, 14.03})), 14.64, 0.01);
}

TEST(HelicopterLinear, LM1_YawHeaveAndSlowModesOfTheHover) {
  expect_recorded_relative("yaw mode, 1/s", mode_near({-1.082, 0.0}).real(), -1.082, 0.02);
  expect_recorded_relative("heave mode, 1/s", mode_near({-0.791, 0.0}).real(), -0.791, 0.02);
  for (const std::complex<double> expected : {std::complex<double>{-0.016, 0.154}, {0.0005, 0.155}}) {
    expect_recorded("slow mode, frequency, rad/s", std::abs(mode_near(expected)), std::abs(expected), 0.002);
    expect_recorded("and real part, 1/s", mode_near(expected).real(), expected.real(), 0.001);
  }
}

TEST(HelicopterLinear, LM1_DerivativesOfTheHover) {
  const LinearModel& m = hover().linear;
  expect_recorded_relative("L_b, 1/s2", m.A(L::kP, L::kDiscRight), 404.70, 0.01);
  expect_recorded_relative("M_a, 1/s2", m.A(L::kQ, L::kDiscBack), 214.25, 0.01);
  expect_recorded_relative("N_r, 1/s", m.A(L::kR, L::kR), -1.069, 0.02);
  expect_recorded_relative("N_v, rad/s/m", m.A(L::kR, L::kV), 1.175, 0.02);
  expect_recorded_relative("L_v, rad/s/m", m.A(L::kP, L::kV), -0.161, 0.02);
  expect_recorded_relative("Y_v, 1/s", m.A(L::kV, L::kV), -0.044, 0.02);
  expect_recorded_relative("N per pedal, 1/s2", m.B(L::kR, L::kTail), 158.4, 0.02);
  expect_recorded_relative("Z per collective, m/s2/rad", m.B(L::kW, L::kCollective), -136.7, 0.02);
}

/// Simulates from the hover with a step of the blade angles, without servos, at 1 ms.
std::vector<HelicopterState> step_response(const BladeAngles& change, double end_s) {
  const BladeAngles& b = hover().trim.blades;
  const BladeAngles blades{b.collective_rad + change.collective_rad, b.lateral_rad + change.lateral_rad,
                           b.longitudinal_rad + change.longitudinal_rad, b.tail_rad + change.tail_rad};
  const auto rate = [&](double, const HelicopterVector& x) {
    return derivative(hover().model, to_helicopter(x), blades, Eigen::Vector3d::Zero());
  };
  std::vector<HelicopterState> states{hover().trim.state};
  for (int i = 0, n = static_cast<int>(std::lround(end_s * 1000.0)); i < n; ++i) {
    HelicopterState next = to_helicopter(rk4_step<17>(to_vector(states.back()), 0.0, 1e-3, rate));
    next.body.q_WB.normalize();
    states.push_back(next);
  }
  return states;
}

// Check LM3.
TEST(HelicopterLinear, LM3_RollRateAfterALateralStep) {
  const std::vector<HelicopterState> s = step_response({.lateral_rad = 0.05}, 0.3);
  const auto p = [&](size_t ms) { return s[ms].body.w_WB_B.x(); };
  const auto roll = [&](size_t ms) { return to_roll_pitch_heading(s[ms].body.q_WB)[0]; };
  size_t peak = 0;
  for (size_t i = 0; i < s.size(); ++i) {
    if (p(i) > p(peak)) peak = i;
  }
  expect_recorded_relative("peak of the roll rate, rad/s", p(peak), 2.650, 0.01);
  expect_recorded_relative("at, s", static_cast<double>(peak) * 1e-3, 0.160, 0.01);
  expect_recorded_relative("p at 0.1 s, rad/s", p(100), 1.972, 0.01);
  expect_recorded_relative("p at 0.2 s, rad/s", p(200), 2.397, 0.01);
  expect_recorded_relative("phi at 0.1 s, rad", roll(100), 0.1589, 0.01);
  expect_recorded_relative("phi at 0.2 s, rad", roll(200), 0.4067, 0.01);
}

// Check LM4.
TEST(HelicopterLinear, LM4_HeaveAfterACollectiveStep) {
  const std::vector<HelicopterState> s = step_response({.collective_rad = 0.01}, 1.0);
  expect_recorded_relative("w at 0.1 s, m/s", s[100].body.v_WB_B.z(), -0.1327, 0.01);
  expect_recorded_relative("w at 0.5 s, m/s", s[500].body.v_WB_B.z(), -0.5656, 0.01);
  expect_recorded_relative("w at 1 s, m/s", s[1000].body.v_WB_B.z(), -0.9326, 0.01);
}

// Check LM7.
TEST(HelicopterLinear, LM7_SignsAreThoseOfAHelicopter) {
  const LinearModel& m = hover().linear;
  // Speed tilts the body directly, and through the settled disc.
  const double L_v =
      m.A(L::kP, L::kV) - m.A(L::kP, L::kDiscRight) * m.A(L::kDiscRight, L::kV) / m.A(L::kDiscRight, L::kDiscRight);
  const double M_u =
      m.A(L::kQ, L::kU) - m.A(L::kQ, L::kDiscBack) * m.A(L::kDiscBack, L::kU) / m.A(L::kDiscBack, L::kDiscBack);
  EXPECT_LT(L_v, 0.0);
  EXPECT_LT(m.A(L::kP, L::kV), 0.0);
  EXPECT_GT(M_u, 0.0);
  EXPECT_LT(m.A(L::kR, L::kR), 0.0);
  EXPECT_GT(m.A(L::kR, L::kV), 0.0);
  EXPECT_LT(m.A(L::kW, L::kW), 0.0);

  const auto rates_after = [](const BladeAngles& change) { return step_response(change, 0.1).back().body; };
  EXPECT_GT(rates_after({.lateral_rad = 0.01}).w_WB_B.x(), 0.0);
  EXPECT_GT(rates_after({.longitudinal_rad = 0.01}).w_WB_B.y(), 0.0);
  EXPECT_LT(rates_after({.collective_rad = 0.01}).v_WB_B.z(), 0.0);
  EXPECT_LT(rates_after({.collective_rad = 0.01}).w_WB_B.z(), 0.0);
  EXPECT_GT(rates_after({.tail_rad = 0.01}).w_WB_B.z(), 0.0);
}

TEST(HelicopterLinear, PredictsSmallMotionsOfTheFullModel) {
  const double size = 1e-4;
  const std::vector<HelicopterState> full = step_response({size, size, size, size}, 0.5);
  Eigen::Matrix<double, L::kStates, 1> x = Eigen::Matrix<double, L::kStates, 1>::Zero();
  const Eigen::Vector4d u = Eigen::Vector4d::Constant(size);
  const auto rate = [&](double, const auto& y) -> Eigen::Matrix<double, L::kStates, 1> {
    return hover().linear.A * y + hover().linear.B * u;
  };
  for (int i = 0; i < 500; ++i) x = rk4_step<L::kStates>(x, 0.0, 1e-3, rate);
  const RigidBodyState& start = hover().trim.state.body;
  const Eigen::Vector3d dv = full.back().body.v_WB_B - start.v_WB_B;
  const Eigen::Vector3d dw = full.back().body.w_WB_B - start.w_WB_B;
  constexpr double kSecondOrder = 0.01;
  EXPECT_LT((dv - x.segment<3>(L::kU)).norm(), kSecondOrder * dv.norm());
  EXPECT_LT((dw - x.segment<3>(L::kP)).norm(), kSecondOrder * dw.norm());
}

}  // namespace
}  // namespace hedgehop::dynamics::helicopter
