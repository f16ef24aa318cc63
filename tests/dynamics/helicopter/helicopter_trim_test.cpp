#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "dynamics/helicopter/trim.h"
#include "dynamics/vehicle.h"
#include "tests/dynamics/recorded_check.h"

namespace hedgehop::dynamics::helicopter {
namespace {

constexpr double kTrimDeg = std::numbers::pi / 180.0;
constexpr double kAny = std::numeric_limits<double>::quiet_NaN();

const HelicopterModel& xcell() {
  static const HelicopterModel model = make_model(HelicopterConfig{});
  return model;
}

Trim trimmed(const Eigen::Vector3d& v_air_W) {
  const std::optional<Trim> found = trim(xcell(), v_air_W);
  EXPECT_TRUE(found) << v_air_W.transpose();
  return found.value_or(Trim{});
}

struct Row {
  std::string name;
  Eigen::Vector3d v_W;
  double collective_deg, tail_deg, roll_deg, pitch_deg, induced_mps, thrust_n, power_w, tail_power_w;
};

void expect_angle(double value_rad, double expected_deg, const char* what) {
  if (std::isnan(expected_deg)) return;
  expect_recorded(std::string(what) + ", deg", value_rad / kTrimDeg, expected_deg,
                  std::max(0.02, 0.005 * std::abs(expected_deg)));
}
void expect_half_percent(double value, double expected, const char* what) {
  if (std::isnan(expected)) return;
  expect_recorded_relative(what, value, expected, 0.005);
}

class HelicopterTrimTable : public testing::TestWithParam<Row> {};

// Check HT3.
TEST_P(HelicopterTrimTable, HT3_XCellMatchesTheTable) {
  const Row& row = GetParam();
  const Trim t = trimmed(row.v_W);
  expect_angle(t.blades.collective_rad, row.collective_deg, "theta_c");
  expect_angle(t.blades.tail_rad, row.tail_deg, "theta_t");
  expect_angle(t.roll_rad, row.roll_deg, "phi");
  expect_angle(t.pitch_rad, row.pitch_deg, "theta");
  expect_half_percent(t.loads.main_rotor.inflow.induced_mps, row.induced_mps, "v_i, m/s");
  expect_half_percent(t.loads.main_rotor.inflow.thrust_n, row.thrust_n, "T, N");
  expect_half_percent(t.loads.main_rotor.power_w, row.power_w, "P, W");
  expect_half_percent(t.loads.tail_rotor.power_w, row.tail_power_w, "P_t, W");
}

INSTANTIATE_TEST_SUITE_P(
    Conditions, HelicopterTrimTable,
    testing::Values(Row{"hover", {0, 0, 0}, 5.483, 11.218, 4.494, 0.000, 4.165, 80.19, 1050.3, 79.1},
                    Row{"north_4", {4, 0, 0}, 4.955, 10.289, 4.23, -0.70, 3.319, 80.24, 989.6, 71.5},
                    Row{"north_8", {8, 0, 0}, 4.368, 8.692, 3.95, -2.76, 2.082, 80.50, 927.7, 60.1},
                    Row{"north_16", {16, 0, 0}, 5.612, 8.508, 4.48, -10.52, 1.117, 84.02, 1114.8, 59.2},
                    Row{"north_20", {20, 0, 0}, 7.485, 10.138, 5.15, -15.74, 0.945, 89.13, 1388.5, 70.9},
                    Row{"rearward_4", {-4, 0, 0}, 4.955, 10.289, 4.23, 0.70, 3.319, 80.24, 989.6, 71.5},
                    Row{"right_4", {0, 4, 0}, 5.140, 9.316, 5.86, 0.00, 3.212, kAny, 1012.0, kAny},
                    Row{"left_4", {0, -4, 0}, 4.836, 12.705, 2.63, 0.00, 3.398, kAny, 975.2, kAny},
                    Row{"climb_2", {0, 0, -2}, 6.239, 11.893, kAny, kAny, 3.294, 80.54, 1142.0, kAny},
                    Row{"descent_1", {0, 0, 1}, 5.167, 10.860, kAny, kAny, 4.690, 80.11, 1012.2, kAny}),
    [](const auto& row) { return row.param.name; });

TEST(HelicopterTrim, HT3_HoverInflowAndPower) {
  const Trim t = trimmed({0, 0, 0});
  expect_half_percent(t.state.flap.right_rad, 0.007590, "b, rad");
  expect_half_percent(t.loads.main_rotor.power_w / 167.0, 6.289, "Q, N m");
  expect_half_percent(t.loads.tail_rotor.inflow.thrust_n, 6.911, "T_tr, N");
  expect_half_percent(t.loads.tail_rotor.inflow.induced_mps, 7.289, "tail v_i, m/s");
  const FlapInput& in = t.loads.main_rotor.flap_input;
  expect_half_percent(speed_flapping(xcell().main_rotor.flapping, in.collective_rad, in.inflow_ratio), 0.03817, "D_mu");
}

// Check HT4.
TEST(HelicopterTrim, HT4_PowerHasABucket) {
  double least = 1e9, at = 0.0;
  for (double V = 0.0; V <= 20.0; V += 0.1) {
    const double power = trimmed({V, 0, 0}).loads.main_rotor.power_w;
    if (power < least) least = power, at = V;
  }
  expect_recorded("speed of minimum power, m/s", at, 8.5, 1.0);
  expect_recorded_relative("minimum power, W", least, 926.9, 0.005);
  EXPECT_GT(trimmed({0, 0, 0}).blades.collective_rad, trimmed({at, 0, 0}).blades.collective_rad);
  EXPECT_GT(trimmed({20, 0, 0}).blades.collective_rad, trimmed({at, 0, 0}).blades.collective_rad);
}

TEST(HelicopterTrim, HT4_InflowAndPitchFallWithSpeed) {
  for (const double direction : {1.0, -1.0}) {
    double inflow = 1e9;
    for (double V = 0.0; V <= 20.0; V += 0.5) {
      const double now = trimmed({direction * V, 0, 0}).loads.main_rotor.inflow.induced_mps;
      EXPECT_LT(now, inflow) << V;
      inflow = now;
    }
  }
  double pitch = 1e9;
  for (double V = -6.0; V <= 20.0; V += 0.5) {
    const double now = trimmed({V, 0, 0}).pitch_rad;
    EXPECT_LT(now, pitch) << V;
    pitch = now;
  }
}

TEST(HelicopterTrim, HT4_PitchIsOddInSpeed) {
  for (double V = 0.5; V <= 6.0; V += 0.5) {
    EXPECT_NEAR(trimmed({V, 0, 0}).pitch_rad, -trimmed({-V, 0, 0}).pitch_rad, 0.1 * kTrimDeg) << V;
  }
}

TEST(HelicopterTrim, HT4_TailCollectiveFallsThenRises) {
  const auto tail = [](double V) { return trimmed({V, 0, 0}).blades.tail_rad; };
  EXPECT_LT(tail(6.0), tail(0.0));
  EXPECT_LT(tail(12.0), tail(6.0));
  EXPECT_GT(tail(20.0), tail(12.0));
}

TEST(HelicopterTrim, HT4_ClockwiseRotorHoversRightSideDown) {
  expect_recorded("phi in hover, deg", trimmed({0, 0, 0}).roll_rad / kTrimDeg, 4.49, 0.02);
  HelicopterConfig mirrored;
  mirrored.main_rotor.turns = MainRotorConfig::Turns::counter_clockwise;
  const std::optional<Trim> left = trim(make_model(mirrored), Eigen::Vector3d::Zero());
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->roll_rad / kTrimDeg, -4.49, 0.02);
}

TEST(HelicopterTrim, HT4_HeadwindHelpsTheHover) {
  const double still = trimmed({0, 0, 0}).loads.main_rotor.power_w;
  const double headwind = trimmed({5, 0, 0}).loads.main_rotor.power_w;
  expect_recorded_relative("P in a headwind of 5 m/s, W", headwind, 966.6, 0.005);
  expect_recorded("share of power it saves", 1.0 - headwind / still, 0.08, 0.005);
}

TEST(HelicopterTrim, HoversInWindFromAnyDirection) {
  for (double from = 0.0; from < 6.2; from += 0.7) {
    for (double heading = -3.0; heading < 3.1; heading += 1.5) {
      Vehicle vehicle{VehicleConfig{}};
      const Eigen::Vector3d wind_W{-5.0 * std::cos(from), -5.0 * std::sin(from), 0.0};
      vehicle.reset({10.0, -20.0, -30.0}, heading, wind_W);
      EXPECT_NEAR(to_roll_pitch_heading(vehicle.body().q_WB)[2], heading, 1e-12);
      const Controls command = vehicle.actuators();
      for (int i = 0; i < 500; ++i) vehicle.step(command, wind_W, 0.002);
      EXPECT_LT((vehicle.body().p_WB - Eigen::Vector3d{10.0, -20.0, -30.0}).norm(), 1e-8);
      // The specific force balances gravity.
      EXPECT_LT((vehicle.body().q_WB * vehicle.specific_force_B() + Eigen::Vector3d{0, 0, 9.81}).norm(), 1e-8);
    }
  }
}

TEST(Vehicle, SameCommandsGiveTheSameFlightBitForBit) {
  Vehicle a{VehicleConfig{}}, b{VehicleConfig{}};
  a.step({0.2, 0.1, -0.1, 0.0}, {1, 2, 3}, 0.002);
  a.reset({0, 0, 0}, 0.0, {0, 0, 0});
  const Controls hover = b.actuators();
  for (int i = 0; i < 1000; ++i) {
    const Controls c{hover[kHeave], 0.01 * std::sin(0.01 * i), hover[kPitch], hover[kYaw]};
    a.step(c, {0.3, 0, 0}, 0.002);
    b.step(c, {0.3, 0, 0}, 0.002);
  }
  EXPECT_EQ(to_vector(a.body()), to_vector(b.body()));
}

TEST(Vehicle, StateIsFiniteForExtremeCommandsAndWind) {
  Vehicle vehicle{VehicleConfig{}};
  for (int i = 0; i < 5000; ++i) {
    const double s = i % 400 < 200 ? 1.0 : -1.0;
    vehicle.step({0.15 * s, 0.02 * s, -0.02 * s, 0.3 * s}, {20.0 * s, -20.0, 5.0 * s}, 0.002);
    ASSERT_TRUE(to_vector(vehicle.body()).allFinite()) << i;
  }
}

TEST(Vehicle, ReportsADescentIntoItsOwnWake) {
  Vehicle vehicle{VehicleConfig{}};
  EXPECT_TRUE(vehicle.within_validity());
  const Controls hover = vehicle.actuators();
  vehicle.step(hover, {0.0, 0.0, -4.0}, 0.002);  // air that rises through the rotor at the speed of its inflow
  EXPECT_FALSE(vehicle.within_validity());
}

}  // namespace
}  // namespace hedgehop::dynamics::helicopter
