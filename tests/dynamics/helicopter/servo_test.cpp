#include "dynamics/helicopter/blade_servos.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "dynamics/rigid_body.h"
#include "tests/dynamics/recorded_check.h"

namespace hedgehop::dynamics::helicopter {
namespace {

constexpr double kStep = 1e-4;
const ServoConfig kServo;

template <class Command>
ServoState advance(const ServoConfig& servo, const ServoState& s, double t, double h, const Command& command) {
  const auto rate = [&](double time, const Eigen::Vector2d& x) {
    return derivative(servo, ServoState{x[0], x[1]}, command(time));
  };
  const Eigen::Vector2d x = rk4_step<2>(Eigen::Vector2d{s.position_rad, s.rate_radps}, t, h, rate);
  return within_limits(servo, {x[0], x[1]});
}

// Check AS1.
TEST(Servo, AS1_StepOvershootsAsASecondOrderLag) {
  const double target = 0.05;
  ServoState s;
  double peak = 0.0, at = 0.0;
  for (int i = 0; i < 3000; ++i) {
    s = advance(kServo, s, i * kStep, kStep, [&](double) { return target; });
    if (s.position_rad > peak) peak = s.position_rad, at = (i + 1) * kStep;
  }
  expect_recorded_relative("overshoot", peak / target - 1.0, 0.1539, 0.01);
  expect_recorded_relative("time of the peak, s", at, 0.0957, 0.01);
}

/// Returns gain and phase at a frequency, from the last whole period of a long sine.
std::complex<double> response(double w_radps) {
  const double amplitude = 0.01;
  const int per_period = 2000;
  const double h = 2.0 * std::numbers::pi / w_radps / per_period;
  ServoState s;
  std::complex<double> sum = 0.0;
  const int periods = 3 + static_cast<int>(std::ceil(1.0 * w_radps / (2.0 * std::numbers::pi)));
  for (int i = 0; i < periods * per_period; ++i) {
    const double t = i * h;
    if (i >= (periods - 1) * per_period) {
      sum += s.position_rad / amplitude * std::exp(std::complex<double>(0.0, -w_radps * t)) * 2.0 / double(per_period);
    }
    s = advance(kServo, s, t, h, [&](double time) { return amplitude * std::sin(w_radps * time); });
  }
  return sum * std::complex<double>(0.0, 1.0);  // of a sine
}

TEST(Servo, AS1_PassesFrequenciesAsASecondOrderLag) {
  double low = 30.0, high = 80.0;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    (std::abs(response(middle)) > std::numbers::sqrt2 / 2.0 ? low : high) = middle;
  }
  expect_recorded_relative("-3 dB, rad/s", low, 48.11, 0.01);
  const double phase_deg = std::arg(response(2.0 * 2.0 * std::numbers::pi)) * 180.0 / std::numbers::pi;
  expect_recorded_relative("phase at 2 Hz, deg", phase_deg, -20.67, 0.01);
}

TEST(Servo, StaysWithinStopsAndRateLimit) {
  ServoConfig servo;
  servo.rate_limit_radps = 0.5;
  ServoState s;
  double fastest = 0.0, farthest = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const double before = s.position_rad;
    s = advance(servo, s, 0.0, 1e-3, [&](double) { return i % 1000 < 500 ? 10.0 : -10.0; });
    fastest = std::max(fastest, std::abs(s.position_rad - before) / 1e-3);
    farthest = std::max(farthest, std::abs(s.position_rad));
  }
  EXPECT_LE(fastest, 0.5 * (1.0 + 1e-9));
  EXPECT_GT(fastest, 0.49);
  EXPECT_DOUBLE_EQ(farthest, servo.highest_rad);
}

TEST(Servo, ReachesItsTargetAtTheRateLimit) {
  ServoConfig servo;
  servo.rate_limit_radps = 0.5;
  ServoState s;
  for (int i = 0; i < 2000; ++i) s = advance(servo, s, 0.0, 1e-3, [](double) { return 0.1; });
  EXPECT_NEAR(s.position_rad, 0.1, 1e-9);
}

}  // namespace
}  // namespace hedgehop::dynamics::helicopter
