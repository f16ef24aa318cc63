#include "avoidance/corridor_centering/centering_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "avoidance/corridor_centering/pursuit.h"

namespace hedgehop::avoidance::corridor_centering {
namespace {

constexpr double kGravityMps2 = 9.80665;

// The point mass of [Zingg2010] sec. V-C in a straight corridor along x: roll and turn rate as commanded,
// constant speed along the heading. y is to the right of the middle, m.
struct PointMass {
  double half_width_m = 2.0, speed_mps = 0.42;
  double x_m = 0.0, y_m = 0.0, v_m_s = 0.0;  // v: sideways, of the body
  double heading_rad = 0.0;

  double error() const { return -y_m / half_width_m; }
  void fly(double roll_rad, double turn_radps, double t_s) {
    constexpr int kSteps = 100;
    const double dt_s = t_s / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      v_m_s += kGravityMps2 * std::tan(roll_rad) * dt_s;
      heading_rad += turn_radps * dt_s;
      x_m += (speed_mps * std::cos(heading_rad) - v_m_s * std::sin(heading_rad)) * dt_s;
      y_m += (speed_mps * std::sin(heading_rad) + v_m_s * std::cos(heading_rad)) * dt_s;
    }
  }
};

struct Path {
  std::vector<double> x_m, y_m;
  double largest_y_m() const { return *std::max_element(y_m.begin(), y_m.end()); }
  /// Path length after which |y| remains within a band.
  double settled_after_m(double band_m) const {
    double after_m = 0.0;
    for (size_t i = 0; i < y_m.size(); ++i) {
      if (std::abs(y_m[i]) > band_m) after_m = x_m[i];
    }
    return after_m;
  }
};

constexpr double kSampleS = 0.5;

template <class Noise>
Path fly_printed(Noise noise, double t_s) {
  PointMass mass;
  mass.y_m = -1.5;  // 1.5 m left of the middle of 4 m: fig. 11 and 12
  Path path;
  double last = mass.error() + noise();
  for (double t = 0.0; t < t_s; t += kSampleS) {
    const double error = mass.error() + noise();
    const double control = published_control({}, error, last);
    last = error;
    mass.fly(control, control, kSampleS);
    path.x_m.push_back(mass.x_m);
    path.y_m.push_back(mass.y_m);
  }
  return path;
}

TEST(PublishedControl, HasTheSteadyGainAndTheDifferenceGainOfItsTransferFunction) {
  const CenteringGains gains;
  EXPECT_NEAR(published_control(gains, 1.0, 1.0), 0.009, 1e-15);  // C(1) = kD
  EXPECT_NEAR(published_control(gains, 1.0, 0.0), 0.209, 1e-15);  // the first sample of a step
  // C(z) at a frequency, from the response to a sine.
  const double w = 0.7;
  const std::complex<double> z = std::polar(1.0, w), C = (0.209 * z - 0.2) / z;
  for (int k = 0; k < 20; ++k) {
    EXPECT_NEAR(published_control(gains, std::cos(w * k), std::cos(w * (k - 1))), (C * std::polar(1.0, w * k)).real(),
                1e-14);
  }
}

TEST(PublishedControl, Figure11SettlesInTheMiddleWithoutOvershoot) {
  const Path path = fly_printed([] { return 0.0; }, 120.0);
  EXPECT_LT(std::abs(path.y_m.back()), 0.02);
  // Two real poles follow from y'' = -g (kD y + kp T y') / 2: 0.119 /s and 0.371 /s; overdamped, so the
  // overshoot is at most that of the turn.
  EXPECT_LT(path.largest_y_m(), 0.2);
  RecordProperty("settled_within_0m2_after_m", std::to_string(path.settled_after_m(0.2)));
  RecordProperty("overshoot_m", std::to_string(path.largest_y_m()));
}

TEST(PublishedControl, Figure12StaysNearTheMiddleWithTheMeasuredNoise) {
  // Deviations of fig. 9: mean 0.146, maximum 0.54; a normal distribution of this spread has that mean.
  constexpr double kSpread = 0.146 / 0.7979;
  int touches = 0;
  double sum_m2 = 0.0, count = 0.0;
  for (uint64_t seed = 1; seed <= 50; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0.0, kSpread);
    const Path path = fly_printed([&] { return std::clamp(normal(random), -0.54, 0.54); }, 120.0);
    touches += std::ranges::any_of(path.y_m, [](double y_m) { return std::abs(y_m) >= 2.0; });
    for (size_t i = path.y_m.size() / 2; i < path.y_m.size(); ++i) sum_m2 += path.y_m[i] * path.y_m[i];
    count += std::ceil(0.5 * static_cast<double>(path.y_m.size()));
  }
  // It is stable, but the start is so near a wall that noise alone can cause a collision.
  EXPECT_LT(std::sqrt(sum_m2 / count), 0.5);
  EXPECT_LE(touches, 5);
  RecordProperty("touches_of_50", touches);
  RecordProperty("rms_m", std::to_string(std::sqrt(sum_m2 / count)));
}

// The same start with the modified law: a point that follows its course without delay.
template <class Noise>
Path fly_pursuit(Noise noise, double speed_mps, double t_s) {
  PointMass mass;
  mass.speed_mps = speed_mps;
  mass.y_m = -1.5;
  Path path;
  constexpr double kPeriodS = 0.1, kAheadM = 1.5;
  for (double t = 0.0; t < t_s; t += kPeriodS) {
    const double seen_m = mass.y_m - noise() * mass.half_width_m;
    mass.heading_rad = pursuit_course_rad({mass.half_width_m + seen_m, mass.half_width_m - seen_m}, kAheadM, 1.0);
    mass.fly(0.0, 0.0, kPeriodS);
    path.x_m.push_back(mass.x_m);
    path.y_m.push_back(mass.y_m);
  }
  return path;
}

TEST(Pursuit, OffsetDecreasesByEPerLookaheadDistanceAtAnySpeed) {
  for (const double speed_mps : {0.2, 0.42, 1.0}) {
    const Path path = fly_pursuit([] { return 0.0; }, speed_mps, 12.0 / speed_mps);
    EXPECT_LE(path.largest_y_m(), 0.0);  // no overshoot
    // dy/dx = -y / 1.5 m exactly, as tan(course) = -y / 1.5 m, except for the time steps of 0.1 s.
    for (size_t i = 0; i < path.x_m.size(); ++i) {
      EXPECT_NEAR(path.y_m[i], -1.5 * std::exp(-path.x_m[i] / 1.5), 0.03 * speed_mps + 1e-9) << path.x_m[i];
    }
  }
}

TEST(Pursuit, StaysCloserToTheMiddleThanThePublishedLawWithTheSameNoise) {
  constexpr double kSpread = 0.146 / 0.7979;
  const auto rms = [](const Path& path) {
    double sum = 0.0;
    for (size_t i = path.y_m.size() / 2; i < path.y_m.size(); ++i) sum += path.y_m[i] * path.y_m[i];
    return std::sqrt(sum / (0.5 * static_cast<double>(path.y_m.size())));
  };
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0.0, kSpread);
    const double printed_m = rms(fly_printed([&] { return normal(random); }, 120.0));
    const double pursuit_m = rms(fly_pursuit([&] { return normal(random); }, 0.42, 120.0));
    EXPECT_LT(pursuit_m, printed_m) << seed;
  }
}

TEST(ClearanceSpeed, LeavesSufficientPathForAStop) {
  const SpeedLimits limits{5.0, 0.1, 1.3, 0.4};
  for (const double path_m : {0.0, 0.05, 0.3, 1.0, 4.0}) {
    const double v = clearance_speed_mps(10.0, path_m, limits);
    EXPECT_NEAR(v * 0.4 + v * v / (2.0 * 1.3), path_m, 1e-12);
  }
  EXPECT_EQ(clearance_speed_mps(10.0, std::numeric_limits<double>::infinity(), limits), 5.0);
  EXPECT_EQ(clearance_speed_mps(10.0, -1.0, limits), 0.0);
  EXPECT_NEAR(clearance_speed_mps(0.2, 100.0, limits), 2.0, 1e-12);
  EXPECT_EQ(clearance_speed_mps(-0.2, 100.0, limits), 0.0);
}

}  // namespace
}  // namespace hedgehop::avoidance::corridor_centering
