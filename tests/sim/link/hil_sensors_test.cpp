#include "sim/link/hil_sensors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace hedgehop::sim::link {
namespace {

constexpr int64_t kSensorsHz = 1000, kImuSteps = 4;

/// Reads all sensors of a vehicle at rest for a duration.
struct AtRest {
  HilSensors sensors{kSensorsHz, 7};
  OutsideInput input;
  std::vector<mavlink::HilSensor> readings;
  std::vector<mavlink::HilGps> fixes;

  void run_for(int64_t steps) {
    input.specific_force_B = {0.0, 0.0, -9.81};
    for (int64_t step = 0; step <= steps; ++step) {
      input.step = step;
      sensors.observe(input);
      if (step == 0 || step % kImuSteps != 0) continue;
      readings.push_back(sensors.sensor(input));
      if (const auto fix = sensors.gps(step)) fixes.push_back(*fix);
    }
  }
};

TEST(HilSensors, HaveTheirRates) {
  AtRest flight;
  EXPECT_EQ(flight.sensors.period(), kImuSteps);
  flight.run_for(10 * kSensorsHz);
  int field = 0, pressure = 0;
  for (const mavlink::HilSensor& reading : flight.readings) {
    EXPECT_EQ(reading.fields_updated & 0x3F, 0x3Fu);
    field += (reading.fields_updated & 0x1C0) == 0x1C0 ? 1 : 0;
    pressure += (reading.fields_updated & 0x1A00) == 0x1A00 ? 1 : 0;
  }
  EXPECT_EQ(flight.readings.size(), 2500u);
  EXPECT_EQ(field, 1000);
  EXPECT_EQ(pressure, 500);
  EXPECT_NEAR(static_cast<double>(flight.fixes.size()), 50.0, 1.0);
}

/// PX4 takes a sensor for broken if its values repeat.
TEST(HilSensors, DoNotRepeatTheirValues) {
  AtRest flight;
  flight.run_for(2 * kSensorsHz);
  std::set<float> accelerations, fields, pressures;
  for (const mavlink::HilSensor& reading : flight.readings) {
    accelerations.insert(reading.zacc);
    if (reading.fields_updated & 0x1C0) fields.insert(reading.xmag);
    if (reading.fields_updated & 0x1A00) pressures.insert(reading.abs_pressure);
  }
  EXPECT_GT(accelerations.size(), 450u);
  EXPECT_GT(fields.size(), 150u);
  EXPECT_GT(pressures.size(), 50u);
}

TEST(HilSensors, ReadGravityTheFieldAndThePressureOfTheHome) {
  AtRest flight;
  flight.run_for(10 * kSensorsHz);
  double zacc = 0.0, pressure_hpa = 0.0;
  Eigen::Vector3d field = Eigen::Vector3d::Zero();
  for (const mavlink::HilSensor& reading : flight.readings) {
    zacc += reading.zacc / 2500.0;
    field += Eigen::Vector3d(reading.xmag, reading.ymag, reading.zmag) / 1000.0;
    pressure_hpa += static_cast<double>(reading.abs_pressure) / 500.0;
  }
  constexpr double kBiasMps2 = 0.22;  // three standard deviations of the wandering bias
  EXPECT_NEAR(zacc, -9.81, kBiasMps2);
  EXPECT_NEAR(field.norm(), 0.48, 0.001);
  EXPECT_NEAR(std::atan2(field.y(), field.x()) * 180.0 / std::numbers::pi, 3.0, 0.1) << "declination of Zurich";
  EXPECT_NEAR(pressure_hpa, 1013.25 * std::pow(1.0 - 0.0065 * 488.0 / 288.15, 5.2559), 0.2);
}

TEST(HilSensors, PositionsAreCoordinatesFromPx4sHome) {
  HilSensors sensors(kSensorsHz, 7);
  OutsideInput input{.step = 4};
  input.body.p_WB = Eigen::Vector3d(1000.0, -500.0, -20.0);
  input.body.v_WB_B = Eigen::Vector3d(3.0, 0.0, 0.0);
  input.body.q_WB = Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ()));
  input.specific_force_B = {0.0, 0.0, -9.81};
  const mavlink::HilStateQuaternion state = sensors.state(input);
  // A degree of latitude is 111.195 km on a sphere of 6371 km.
  EXPECT_NEAR(state.lat, 473977420 + 1e7 * 1000.0 / 111194.93, 2.0);
  EXPECT_NEAR(state.lon, 85455940 - 1e7 * 500.0 / (111194.93 * std::cos(47.397742 * std::numbers::pi / 180.0)), 2.0);
  EXPECT_EQ(state.alt, 508000);
  EXPECT_EQ(state.vx, 0);
  EXPECT_EQ(state.vy, 300) << "to the east";
  EXPECT_EQ(state.true_airspeed, 300);
  EXPECT_EQ(state.zacc, -9810);
  EXPECT_NEAR(state.attitude_quaternion[3], std::sqrt(0.5), 1e-6);
  EXPECT_EQ(state.time_usec, 4000u);
}

TEST(HilSensors, AreEqualForEqualSeedsOnly) {
  const auto first = [](uint64_t seed) {
    HilSensors sensors(kSensorsHz, seed);
    OutsideInput input{.step = 4};
    sensors.observe(input);
    return sensors.sensor(input).xgyro;
  };
  EXPECT_EQ(first(1), first(1));
  EXPECT_NE(first(1), first(2));
}

}  // namespace
}  // namespace hedgehop::sim::link
