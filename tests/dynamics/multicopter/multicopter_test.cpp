#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "dynamics/control/hover_model.h"
#include "dynamics/multicopter/multicopter_flight.h"
#include "dynamics/vehicle.h"
#include "tests/dynamics/multicopter/published_multicopters.h"
#include "tests/dynamics/recorded_check.h"

// Values marked MC.. follow from the published parameter sets by closed forms.
namespace hedgehop::dynamics::multicopter {
namespace {

constexpr double kDensity = 1.225;

PerRotor hover_speeds(const MulticopterConfig& config) {
  return trim(make_model(config), Eigen::Vector3d::Zero())->state.speeds_radps;
}

TEST(Multicopter, MC1_HoverSpeedsOfThePublishedVehicles) {
  expect_recorded_relative("Hummingbird A, rad/s", hover_speeds(hummingbird_a()).mean(), 453.22, 5e-4);
  expect_recorded_relative("Hummingbird B, rad/s", hover_speeds(hummingbird_b()).mean(), 469.20, 5e-4);
  expect_recorded_relative("Firefly, rad/s", hover_speeds(firefly()).mean(), 540.95, 5e-4);
  // The third set of the Hummingbird, [BoucekFlidr2019] table of parameters.
  MulticopterConfig third = hummingbird_b();
  third.rotor.thrust_ns2 = 3.2032e-6;
  expect_recorded_relative("third Hummingbird, rad/s", hover_speeds(third).mean(), 618.73, 5e-4);
  const PerRotor big = hover_speeds(s900());
  const double thrust_n = 6.54e-5 * big[0] * big[0];
  expect_recorded_relative("S900 thrust of a motor, N", thrust_n, 7.6048, 5e-4);
  expect_recorded_relative("S900 share of maximum thrust", thrust_n / 24.525, 0.310, 2e-3);
  expect_recorded_relative("S900, rad/s", big.mean(), 341.0, 5e-4);
}

TEST(Multicopter, MC2_InflowTorqueAndThrustToWeightOfTheHover) {
  const auto inflow_mps = [](const MulticopterConfig& c) {
    const double thrust_n = c.rotor.thrust_ns2 * std::pow(hover_speeds(c)[0], 2);
    return std::sqrt(thrust_n / (2.0 * kDensity * std::numbers::pi * std::pow(c.rotor.radius_m, 2)));
  };
  expect_recorded_relative("v_i of Hummingbird A, m/s", inflow_mps(hummingbird_a()), 4.776, 1e-3);
  expect_recorded_relative("v_i of Hummingbird B, m/s", inflow_mps(hummingbird_b()), 3.992, 1e-3);
  expect_recorded_relative("v_i of Firefly, m/s", inflow_mps(firefly()), 5.701, 1e-3);
  expect_recorded_relative("v_i of S900, m/s", inflow_mps(s900()), 5.218, 1e-3);
  const auto torque_nm = [](const MulticopterConfig& c) {
    return c.rotor.torque_m * c.rotor.thrust_ns2 * std::pow(hover_speeds(c)[0], 2);
  };
  expect_recorded_relative("rotor torque of Hummingbird A, N m", torque_nm(hummingbird_a()), 0.02810, 1e-3);
  expect_recorded_relative("rotor torque of Firefly, N m", torque_nm(firefly()), 0.04002, 1e-3);
  const auto thrust_to_weight = [](const MulticopterConfig& c) {
    return authority(make_model(c))[kHeave] / (c.mass.mass_kg * kGravityMps2);
  };
  expect_recorded_relative("thrust/weight of Hummingbird A", thrust_to_weight(hummingbird_a()), 3.42, 2e-3);
  expect_recorded_relative("thrust/weight of Firefly", thrust_to_weight(firefly()), 2.40, 2e-3);
  expect_recorded_relative("thrust/weight of S900", thrust_to_weight(s900()), 3.22, 2e-3);
}

Eigen::Vector3d angular_acceleration(const MulticopterConfig& config, const std::vector<double>& change_radps) {
  const MulticopterModel model = make_model(config);
  PerRotor speeds = hover_speeds(config);
  for (Eigen::Index i = 0; i < speeds.size(); ++i) speeds[i] += change_radps[static_cast<size_t>(i)];
  const MulticopterLoads loads =
      multicopter_loads(model, {}, speeds, PerRotor::Zero(speeds.size()), Eigen::Vector3d::Zero());
  return model.mass.I_B_inv * loads.t_B;
}

TEST(Multicopter, MC3_AngularAccelerationOfUnequalSpeeds) {
  // Front and back rotors turn clockwise: if they accelerate, the body rotates the other way.
  expect_recorded_relative("Hummingbird A yaw, rad/s2", angular_acceleration(hummingbird_a(), {10, -10, 10, -10}).z(),
                           -0.4133, 1e-3);
  expect_recorded_relative("Hummingbird A roll, rad/s2", angular_acceleration(hummingbird_a(), {0, -10, 0, 10}).x(),
                           3.764, 1e-3);
  expect_recorded_relative("Firefly roll, rad/s2", angular_acceleration(firefly(), {-10, -10, -10, 10, 10, 10}).x(),
                           2.288, 1e-3);
}

TEST(Multicopter, MC4_LevelSpeedAtATiltByRotorDragAlone) {
  // m g tan(tilt) = n lambda omega v, omega^2 = m g cos(tilt) / (n k): steady flight at that tilt.
  const auto tilt_deg = [](const MulticopterConfig& c, double v_mps) {
    return -trim(make_model(c), {v_mps, 0.0, 0.0})->pitch_rad / kDeg;
  };
  const auto speed_at = [&](const MulticopterConfig& c, double wanted_deg) {
    double low = 0.0, high = 40.0;
    for (int i = 0; i < 50; ++i) (tilt_deg(c, 0.5 * (low + high)) < wanted_deg ? low : high) = 0.5 * (low + high);
    return low;
  };
  // The rolling moment and the arm of the drag redistribute thrust between rotors: a second-order effect on the speed.
  expect_recorded_relative("Hummingbird A at 5 deg, m/s", speed_at(hummingbird_a(), 5.0), 4.211, 5e-3);
  expect_recorded_relative("Hummingbird A at 10 deg, m/s", speed_at(hummingbird_a(), 10.0), 8.537, 5e-3);
  expect_recorded_relative("Hummingbird A at 20 deg, m/s", speed_at(hummingbird_a(), 20.0), 18.04, 5e-3);
  expect_recorded_relative("Firefly at 5 deg, m/s", speed_at(firefly(), 5.0), 5.026, 5e-3);
  expect_recorded_relative("Firefly at 20 deg, m/s", speed_at(firefly(), 20.0), 21.53, 5e-3);
}

TEST(Multicopter, MC5_LevelSpeedsOfHummingbirdBWithAllItsDrag) {
  for (const auto& [v_mps, tilt_deg, omega] :
       {std::array{1.844, 5.0, 469.6}, {3.569, 10.0, 471.7}, {6.738, 20.0, 485.9}}) {
    const auto found = trim(make_model(hummingbird_b()), {v_mps, 0.0, 0.0});
    ASSERT_TRUE(found);
    const std::string at = " of Hummingbird B at " + std::to_string(v_mps).substr(0, 5) + " m/s";
    expect_recorded_relative("tilt" + at + ", deg", -found->pitch_rad / kDeg, tilt_deg, 5e-3);
    expect_recorded_relative("rotor speed" + at + ", rad/s", found->state.speeds_radps.mean(), omega, 5e-3);
  }
}

TEST(Multicopter, MC5_LevelFallEndsAtTerminalSpeed) {
  MulticopterFlight flight(hummingbird_b());
  MulticopterFlightState state = flight.state();
  state.speeds_radps.setZero();
  flight.set_state(state, Eigen::Vector3d::Zero());
  const PerRotor off = PerRotor::Zero(4);
  for (int i = 0; i < 10000; ++i) flight.step(off, Eigen::Vector3d::Zero(), 0.002);
  expect_recorded_relative("terminal speed of Hummingbird B, m/s", flight.body().v_WB_B.z(), 22.147, 1e-3);
}

TEST(Multicopter, MC5_HoverDamping) {
  using L = MulticopterLinearModel;
  const auto linear = [](const MulticopterConfig& c) {
    const MulticopterModel model = make_model(c);
    return linearize(model, *trim(model, Eigen::Vector3d::Zero()));
  };
  expect_recorded_relative("X_u of Hummingbird B, 1/s", linear(hummingbird_b()).A(L::kU, L::kU), -0.4467, 5e-3);
  expect_recorded_relative("Z_w of Hummingbird B, 1/s", linear(hummingbird_b()).A(L::kW, L::kW), -0.871, 5e-3);
  expect_recorded_relative("X_u of Hummingbird A, 1/s", linear(hummingbird_a()).A(L::kU, L::kU), -0.2042, 5e-3);
}

TEST(Multicopter, MC6_MotorsFollowAFirstOrderLag) {
  MulticopterFlight flight{MulticopterConfig{}};
  const double from = flight.state().speeds_radps[0];
  const PerRotor commanded = PerRotor::Constant(4, from + 100.0);
  for (int i = 0; i < 5; ++i) flight.step(commanded, Eigen::Vector3d::Zero(), 0.002);
  expect_recorded("per cent of a step after 10 ms", flight.state().speeds_radps[0] - from, 55.07, 0.06);
  // 10 to 90 % takes ln(9) time constants.
  const auto reached_s = [&](double share) {
    MulticopterFlight again{MulticopterConfig{}};
    double t_s = 0.0;
    while (t_s < 1.0 && again.state().speeds_radps[0] < from + 100.0 * share) {
      again.step(commanded, {0, 0, 0}, 1e-5);
      t_s += 1e-5;
    }
    EXPECT_LT(t_s, 1.0) << share;
    return t_s;
  };
  expect_recorded("rise from 10 to 90 %, s", reached_s(0.9) - reached_s(0.1), 0.02747, 3e-5);
}

TEST(Multicopter, MC7_WithoutBodyDragAFallAccelerates) {
  MulticopterFlight flight{MulticopterConfig{}};
  MulticopterFlightState state = flight.state();
  state.speeds_radps.setZero();
  flight.set_state(state, Eigen::Vector3d::Zero());
  for (int i = 0; i < 5000; ++i) flight.step(PerRotor::Zero(4), Eigen::Vector3d::Zero(), 0.002);
  expect_recorded("speed after 10 s of fall, m/s", flight.body().v_WB_B.z(), 98.1, 1e-6);
}

TEST(Multicopter, RotorAccelerationRotatesTheBodyByTheirMomentum) {
  // Without drag torque, the angular momentum of body and rotors is constant.
  MulticopterConfig config;
  config.rotor.torque_m = 1e-4;
  config.rotor.drag_ns2pm = config.rotor.rolling_nms2pm = 0.0;
  MulticopterFlight flight(config);
  MulticopterFlightState state = flight.state();
  state.body = {};
  flight.set_state(state, Eigen::Vector3d::Zero());
  PerRotor commanded = state.speeds_radps;
  commanded[0] += 50.0, commanded[2] += 50.0;  // both clockwise
  double torque_impulse = 0.0;
  for (int i = 0; i < 100; ++i) {
    flight.step(commanded, Eigen::Vector3d::Zero(), 0.001);
    torque_impulse += 0.001 * wrench(flight.model(), flight.state().speeds_radps)[kYaw];
  }
  const double rotors = 7.67e-6 * 2.0 * (flight.state().speeds_radps[0] - state.speeds_radps[0]);
  const double body = 0.012 * flight.body().w_WB_B.z();
  EXPECT_NEAR(body + rotors, torque_impulse, 0.02 * rotors);
  EXPECT_LT(body, -0.8 * rotors);
}

TEST(Multicopter, StaysInATrimmedHoverInWind) {
  for (const MulticopterConfig& config : {hummingbird_a(), hummingbird_b(), firefly(), s900()}) {
    Vehicle vehicle{VehicleConfig(config)};
    const Eigen::Vector3d wind_W(3.0, -2.0, 0.5);
    vehicle.reset({1.0, 2.0, -20.0}, 0.7, wind_W);
    const Controls trim = vehicle.actuators();
    for (int i = 0; i < 500; ++i) vehicle.step(trim, wind_W, 0.002);
    EXPECT_LT((vehicle.body().p_WB - Eigen::Vector3d(1.0, 2.0, -20.0)).norm(), 1e-6);
    EXPECT_LT((vehicle.body().q_WB * vehicle.specific_force_B() + Eigen::Vector3d{0, 0, 9.81}).norm(), 1e-6);
  }
}

TEST(Multicopter, HoverModelMatchesTheVehicleNearItsHover) {
  for (const MulticopterConfig& plain : {hummingbird_a(), hummingbird_b(), firefly(), s900()}) {
    MulticopterConfig config = plain;
    config.rotor.time_constant_down_s = config.rotor.time_constant_up_s;  // one lag, as in the linear model
    const control::HoverModel model = control::make_hover_model(config);
    const control::LinearSystem step = control::sampled(model.motion, 0.002);
    for (int input = 0; input < kControlAxes; ++input) {
      Vehicle vehicle{VehicleConfig(config)};
      Controls u = Controls::Zero();
      u[input] = 1e-4 * model.acceptable[input];
      control::DesignVector x = control::DesignVector::Zero(model.motion.A.rows());
      for (int i = 0; i < 200; ++i) {
        vehicle.step(model.trim + u, Eigen::Vector3d::Zero(), 0.002);
        x = control::DesignVector(step.A * x + step.B * u);
      }
      const RigidBodyState& b = vehicle.body();
      Eigen::Matrix<double, 10, 1> truth;
      truth << b.q_WB * b.v_WB_B, to_roll_pitch_heading(b.q_WB) - Eigen::Vector3d(model.roll_rad, model.pitch_rad, 0.0),
          b.w_WB_B, b.p_WB.z();
      EXPECT_LT((truth - x.head<10>()).norm(), 2e-3 * truth.norm()) << "input " << input;
    }
  }
}

TEST(Multicopter, FliesWithAnyNumberOfArms) {
  for (const int arms : {4, 5, 6, 8, 12, 16}) {
    MulticopterConfig config;
    config.arms.clear();
    for (int i = 0; i < arms; ++i) {
      config.arms.push_back(
          {2.0 * std::numbers::pi * i / arms, 0.2, i % 2 == 0 ? Turns::clockwise : Turns::counter_clockwise});
    }
    EXPECT_NO_THROW(control::make_hover_model(config)) << arms;
  }
}

TEST(Multicopter, RefusesVehiclesThatCannotHover) {
  const auto refused = [](auto change) {
    MulticopterConfig config;
    change(config);
    EXPECT_THROW(Vehicle{VehicleConfig{config}}, std::invalid_argument);
  };
  refused([](auto& c) { c.mass.mass_kg = -1.0; });
  refused([](auto& c) { c.mass.mass_kg = 3.0; });  // more than the rotors can lift
  refused([](auto& c) { c.arms.pop_back(); });     // the remaining rotors cannot balance it
  refused([](auto& c) {
    for (ArmConfig& arm : c.arms) arm.turns = Turns::clockwise;
  });
  refused([](auto& c) {
    for (ArmConfig& arm : c.arms) arm.azimuth_rad = 0.0;
  });
  refused([](auto& c) { c.arms.resize(17); });
  refused([](auto& c) { c.rotor.thrust_ns2 = 0.0; });
  refused([](auto& c) { c.rotor.time_constant_up_s = 0.0; });
  refused([](auto& c) { c.hull.body_size_m.x() = 0.0; });
}

TEST(Multicopter, HullContainsEveryRotorAndArm) {
  const std::vector<HullPart> parts = dynamics::hull(VehicleConfig(s900()));
  ASSERT_EQ(parts.size(), 8u);
  EXPECT_NEAR(radius_m(parts), 0.45 + 0.1905, 1e-12);
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(parts[i].center_B_m.head<2>().norm(), 0.45, 1e-12);
    EXPECT_NEAR(parts[i].center_B_m.z(), -0.115, 1e-12);
  }
}

}  // namespace
}  // namespace hedgehop::dynamics::multicopter
