#include "dynamics/rigid_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "dynamics/helicopter/helicopter_flight.h"
#include "dynamics/helicopter/trim.h"
#include "tests/dynamics/recorded_check.h"

namespace hedgehop::dynamics {
namespace {

MassProperties mass_of(double xx, double yy, double zz) { return make_mass_properties(1.0, {xx, yy, zz}, 0.0); }

/// Steps a body without loads; the quaternion is normalized as in flight.
RigidBodyState step_free(const MassProperties& mass, const RigidBodyState& state, double h) {
  const auto rate = [&](double, const RigidBodyVector& x) {
    return derivative(mass, to_rigid_body(x), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  };
  RigidBodyState next = to_rigid_body(rk4_step<13>(to_vector(state), 0.0, h, rate));
  next.q_WB.normalize();
  return next;
}

double energy(const MassProperties& mass, const RigidBodyState& s) { return 0.5 * s.w_WB_B.dot(mass.I_B * s.w_WB_B); }
Eigen::Vector3d momentum_W(const MassProperties& mass, const RigidBodyState& s) {
  return s.q_WB * (mass.I_B * s.w_WB_B);
}

/// Returns the times at which w[axis] changes sign, linear within a step, and the angular velocities there.
struct Flips {
  std::vector<double> t_s;
  std::vector<Eigen::Vector3d> w;
};
Flips flips(const MassProperties& mass, const Eigen::Vector3d& w0, int axis, double h, double end_s) {
  RigidBodyState s;
  s.w_WB_B = w0;
  Flips out;
  for (int i = 0; i * h < end_s; ++i) {
    const RigidBodyState next = step_free(mass, s, h);
    const double before = s.w_WB_B[axis], after = next.w_WB_B[axis];
    if (before * after < 0.0) {
      const double part = before / (before - after);
      out.t_s.push_back((i + part) * h);
      out.w.push_back(s.w_WB_B + part * (next.w_WB_B - s.w_WB_B));
    }
    s = next;
  }
  return out;
}

// Check RB1.
TEST(RigidBody, RB1_DzhanibekovFlipPeriodMatchesEllipticIntegrals) {
  const MassProperties mass = mass_of(0.18, 0.34, 0.28);
  const Flips f = flips(mass, {0.01, 0.0, 5.0}, 2, 1e-3, 20.0);
  ASSERT_EQ(f.t_s.size(), 2u);
  expect_recorded("first flip, s", f.t_s[0], 4.68292, 1e-3);
  expect_recorded("second flip, s", f.t_s[1], 14.04876, 1e-3);
}

TEST(RigidBody, RB1_DzhanibekovKeepsEnergyMomentumAndNorm) {
  const MassProperties mass = mass_of(0.18, 0.34, 0.28);
  RigidBodyState s;
  s.w_WB_B = {0.01, 0.0, 5.0};
  EXPECT_NEAR(energy(mass, s), 3.500009, 1e-12);
  const Eigen::Vector3d L{0.0018, 0.0, 1.4};
  double worst_energy = 0.0, worst_momentum = 0.0, worst_norm = 0.0;
  for (int i = 0; i < 20000; ++i) {
    s = step_free(mass, s, 1e-3);
    worst_energy = std::max(worst_energy, std::abs(energy(mass, s) / 3.500009 - 1.0));
    worst_momentum = std::max(worst_momentum, (momentum_W(mass, s) - L).norm() / L.norm());
    worst_norm = std::max(worst_norm, std::abs(s.q_WB.norm() - 1.0));
  }
  expect_recorded_below("relative drift of the energy", worst_energy, 1e-10);
  expect_recorded_below("relative drift of the momentum", worst_momentum, 1e-10);
  expect_recorded_below("quaternion norm less 1", worst_norm, 1e-12);
}

TEST(RigidBody, RB1_DzhanibekovGrowsAtTheLinearRate) {
  const MassProperties mass = mass_of(0.18, 0.34, 0.28);
  RigidBodyState s;
  s.w_WB_B = {1e-6, 0.0, 5.0};
  for (int i = 0; i < 2000; ++i) s = step_free(mass, s, 1e-3);
  expect_recorded("linear growth rate, 1/s", std::acosh(s.w_WB_B.x() / 1e-6) / 2.0, 1.56556, 1e-5);
}

TEST(RigidBody, TorqueFreeMotionKeepsEnergyAndMomentumForAMinute) {
  const MassProperties mass = make_mass_properties(8.2, {0.18, 0.34, 0.28}, 0.03);
  RigidBodyState s;
  s.w_WB_B = {3.0, 2.0, -4.0};
  const double E = energy(mass, s);
  const Eigen::Vector3d L = momentum_W(mass, s);
  for (int i = 0; i < 30000; ++i) {
    s = step_free(mass, s, 2e-3);
    ASSERT_NEAR(energy(mass, s), E, 1e-6 * E) << i;
    ASSERT_LT((momentum_W(mass, s) - L).norm(), 1e-6 * L.norm()) << i;
  }
}

// Check RB2.
TEST(RigidBody, RB2_FlipsAboutTheMiddleAxisPeriodically) {
  const Flips f = flips(mass_of(1.0, 2.0, 3.0), {1e-3, 1.0, 0.0}, 1, 1e-3, 100.0);
  ASSERT_GE(f.t_s.size(), 3u);
  for (size_t i = 1; i < f.t_s.size(); ++i) {
    expect_recorded("time between flips, s", f.t_s[i] - f.t_s[i - 1], 28.73142, 5e-3);
  }
  for (const Eigen::Vector3d& w : f.w) {
    expect_recorded("w_x in a flip, rad/s", std::abs(w.x()), 1.0, 1e-5);
    expect_recorded("w_z in a flip, rad/s", std::abs(w.z()), 0.577350, 1e-5);
  }
}

// Check RB3.
TEST(RigidBody, RB3_IntegratesWithFourthOrder) {
  const MassProperties mass = mass_of(0.18, 0.34, 0.28);
  Eigen::Matrix<double, 7, 1> exact;
  exact << -0.532631726, -0.832714213, 0.151294602, -0.000653401, 2.165798156, -0.444590014, -2.896101325;
  const auto final_state = [&](double h) {
    RigidBodyState s;
    s.w_WB_B = {3.0, 2.0, 1.0};
    for (int i = 0, n = static_cast<int>(std::lround(2.0 / h)); i < n; ++i) s = step_free(mass, s, h);
    Eigen::Matrix<double, 7, 1> x;
    x << s.q_WB.w(), s.q_WB.vec(), s.w_WB_B;
    return x;
  };
  const Eigen::Matrix<double, 7, 1> fine = final_state(2.5e-4);
  constexpr double kPrintedDigits = 2e-9;
  expect_recorded_below("attitude and rates after 2 s, norm of the error", (fine - exact).norm(), kPrintedDigits);
  const double e1 = (final_state(0.02) - fine).norm();
  const double e2 = (final_state(0.01) - fine).norm();
  const double e3 = (final_state(0.005) - fine).norm();
  expect_recorded("order of convergence, 20 to 10 ms", std::log2(e1 / e2), 4.0, 0.1);
  expect_recorded("order of convergence, 10 to 5 ms", std::log2(e2 / e3), 4.0, 0.1);
  expect_recorded_relative("error at 20 ms", e1, 6.96e-8, 0.02);
  expect_recorded_relative("error at 10 ms", e2, 4.34e-9, 0.02);
  expect_recorded_relative("error at 5 ms", e3, 2.71e-10, 0.02);
}

// Check RB4.
TEST(RigidBody, RB4_SymmetricTopPrecessesInBodyAxes) {
  const MassProperties mass = mass_of(0.007, 0.007, 0.012);
  RigidBodyState s;
  s.w_WB_B = {1.0, 0.0, 10.0};
  double angle = 0.0, before = 0.0;
  const double h = 1e-3;
  const int n = 10000;
  for (int i = 0; i < n; ++i) {
    s = step_free(mass, s, h);
    const double now = std::atan2(s.w_WB_B.y(), s.w_WB_B.x());
    angle += std::remainder(now - before, 2.0 * std::numbers::pi);
    before = now;
  }
  expect_recorded("period in body axes, s", 2.0 * std::numbers::pi * n * h / std::abs(angle), 0.879646, 1e-5);
}

helicopter::BladeAngles wiggle(const helicopter::BladeAngles& trim, double t_s) {
  return {trim.collective_rad + 0.01 * std::sin(2.0 * t_s), trim.lateral_rad + 0.004 * std::sin(3.0 * t_s),
          trim.longitudinal_rad + 0.004 * std::sin(2.5 * t_s + 1.0), trim.tail_rad + 0.01 * std::sin(1.5 * t_s)};
}

// Check RB5.
TEST(Helicopter, RB5_UniformWindOnlyTranslatesTheMotion) {
  const Eigen::Vector3d wind_W{3.0, -4.0, 0.0};
  helicopter::HelicopterFlight still{helicopter::HelicopterConfig{}}, carried{helicopter::HelicopterConfig{}};
  helicopter::HelicopterFlightState start = still.state();
  start.airframe.body.v_WB_B += start.airframe.body.q_WB.conjugate() * wind_W;
  carried.set_state(start, wind_W);
  const helicopter::BladeAngles hover = still.actuators();
  const double dt = 0.002;
  double worst = 0.0;
  for (int i = 1; i <= 5000; ++i) {
    const helicopter::BladeAngles command = wiggle(hover, (i - 1) * dt);
    still.step(command, Eigen::Vector3d::Zero(), dt);
    carried.step(command, wind_W, dt);
    worst = std::max(worst, (carried.body().p_WB - still.body().p_WB - wind_W * i * dt).norm());
  }
  EXPECT_GT(still.body().v_WB_B.norm(), 0.5) << "the flight must move through the air";
  expect_recorded_below("distance from W t over 10 s, m", worst, 1e-9);
}

/// Returns the change of kinetic and potential energy minus the work of all loads except gravity, after a maneuver of
/// 10 s, over the maximum change of energy during it.
double energy_residual(double h) {
  const helicopter::HelicopterModel model = make_model(helicopter::HelicopterConfig{});
  const std::optional<helicopter::Trim> start = trim(model, {8.0, 0.0, 0.0});
  using Vector = Eigen::Matrix<double, 18, 1>;
  const auto rate = [&](double t, const Vector& x) {
    const helicopter::HelicopterState s = helicopter::to_helicopter(x.head<17>());
    const helicopter::BladeAngles blades = wiggle(start->blades, t);
    const helicopter::HelicopterLoads loads = helicopter::helicopter_loads(model, s, blades, Eigen::Vector3d::Zero());
    Vector dx;
    dx << derivative(model, s, blades, Eigen::Vector3d::Zero()),
        loads.f_B.dot(s.body.v_WB_B) + loads.t_B.dot(s.body.w_WB_B);
    return dx;
  };
  const auto total = [&](const Vector& x) {
    const RigidBodyState b = to_rigid_body(x.head<13>());
    return 0.5 * model.mass.mass_kg * b.v_WB_B.squaredNorm() + energy(model.mass, b) -
           model.mass.mass_kg * kGravityMps2 * b.p_WB.z();
  };
  Vector x;
  x << to_vector(start->state), 0.0;
  const double E0 = total(x);
  double greatest = 0.0;
  for (int i = 0, n = static_cast<int>(std::lround(10.0 / h)); i < n; ++i) {
    x = rk4_step<18>(x, i * h, h, rate);
    x.segment<4>(3).normalize();
    greatest = std::max(greatest, std::abs(total(x) - E0));
  }
  return (total(x) - E0 - x[17]) / greatest;
}

// Check RB6.
TEST(Helicopter, RB6_EnergyIsTheWorkOfItsLoads) {
  const double coarse = energy_residual(0.004), fine = energy_residual(0.002);
  expect_recorded_below("residual over 10 s, relative", std::abs(fine), 1e-6);
  expect_recorded("fall of the residual per halved step", coarse / fine, 16.0, 1.6);
}

// Check RB7.
TEST(RigidBody, RB7_FreeFallIsUniformlyAccelerated) {
  const MassProperties mass = mass_of(1.0, 1.0, 1.0);
  RigidBodyState s;
  for (int i = 0; i < 500; ++i) s = step_free(mass, s, 0.002);
  expect_recorded("way after 1 s, m", s.p_WB.z(), 4.905, 1e-12);
  expect_recorded("speed after 1 s, m/s", s.v_WB_B.z(), 9.81, 1e-12);
}

TEST(RigidBody, RefusesAnInertiaOfNoRigidBody) {
  EXPECT_THROW(make_mass_properties(1.0, {1.0, 1.0, 2.1}, 0.0), std::invalid_argument);
  EXPECT_THROW(make_mass_properties(1.0, {1.0, 1.0, 1.0}, 1.1), std::invalid_argument);
  EXPECT_THROW(make_mass_properties(-1.0, {1.0, 1.0, 1.0}, 0.0), std::invalid_argument);
}

TEST(RigidBody, EulerAnglesRoundTrip) {
  const Eigen::Vector3d rph = to_roll_pitch_heading(from_roll_pitch_heading(0.3, -0.7, 2.5));
  EXPECT_LT((rph - Eigen::Vector3d{0.3, -0.7, 2.5}).norm(), 1e-14);
}

}  // namespace
}  // namespace hedgehop::dynamics
