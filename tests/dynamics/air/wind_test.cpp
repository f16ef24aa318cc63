#include "dynamics/air/wind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "tests/dynamics/recorded_check.h"

namespace hedgehop::dynamics::air {
namespace {

constexpr double kKnotMps = 0.514444;
constexpr double kW20 = 15.0 * kKnotMps;
constexpr double kHeightM = 10.0;
constexpr double kSpeedMps = 25.0;

WindConfig turbulent() { return {.turbulence_w20_mps = kW20}; }

// Check DR1.
TEST(Wind, DR1_ScalesMatchTheLowAltitudeModel) {
  const std::array<double, 4> heights{3.048, 6.096, 15.24, 100.0}, lengths{23.055, 43.766, 94.728, 262.79},
      sigmas{1.5148, 1.4887, 1.4188, 1.0649};
  for (size_t i = 0; i < heights.size(); ++i) {
    const DrydenScales s = dryden_scales(heights[i], kW20);
    const std::string at = " at " + std::to_string(heights[i]).substr(0, 5) + " m";
    expect_recorded_relative("L_u" + at + ", m", s.length_uv_m, lengths[i], 1e-3);
    expect_recorded_relative("sigma_u" + at + ", m/s", s.sigma_uv_mps, sigmas[i], 1e-3);
    expect_recorded_relative("sigma_w" + at + ", m/s", s.sigma_w_mps, 0.77167, 1e-3);
    EXPECT_NEAR(s.length_w_m, heights[i], 1e-9);
  }
}

/// Sums over a record of u, v, w.
struct Statistics {
  Eigen::Vector3d variance = Eigen::Vector3d::Zero(), kurtosis = Eigen::Vector3d::Zero();
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
};
Statistics statistics(double dt, uint64_t seed) {
  const DrydenScales s = dryden_scales(kHeightM, kW20);
  const auto n = static_cast<int64_t>(1.5e4 * s.length_uv_m / kSpeedMps / dt);
  Wind wind(turbulent(), seed);
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  Eigen::Vector3d fourth = Eigen::Vector3d::Zero();
  for (int64_t i = 0; i < n; ++i) {
    const Eigen::Vector3d g = wind.sample(kHeightM, {kSpeedMps, 0.0, 0.0}, dt);
    second += g * g.transpose();
    fourth += g.array().pow(4).matrix();
  }
  second /= static_cast<double>(n);
  fourth /= static_cast<double>(n);
  Statistics out;
  out.variance = second.diagonal();
  out.kurtosis = fourth.cwiseQuotient(out.variance.cwiseAbs2());
  const Eigen::Vector3d sigma = out.variance.cwiseSqrt();
  out.correlation = second.cwiseQuotient(sigma * sigma.transpose());
  return out;
}

void expect_variance(const Statistics& s) {
  const DrydenScales scales = dryden_scales(kHeightM, kW20);
  const double uv = scales.sigma_uv_mps * scales.sigma_uv_mps, w = scales.sigma_w_mps * scales.sigma_w_mps;
  expect_recorded_relative("variance of u, m2/s2", s.variance[0], uv, 0.05);
  expect_recorded_relative("variance of v, m2/s2", s.variance[1], uv, 0.05);
  expect_recorded_relative("variance of w, m2/s2", s.variance[2], w, 0.05);
}

// Checks DR2 and DR5.
TEST(Wind, DR2_DR5_VarianceIsTheModelsAndGaussianAt50Hz) {
  const Statistics s = statistics(0.02, 11);
  expect_variance(s);
  for (int i = 0; i < 3; ++i) {
    expect_recorded(std::string("kurtosis of ") + "uvw"[i], s.kurtosis[i], 3.0, 0.15);
    for (int k = 0; k < i; ++k) EXPECT_LT(std::abs(s.correlation(i, k)), 0.04) << i << k;
  }
}

TEST(Wind, DR2_VarianceIsTheModelsAt200Hz) { expect_variance(statistics(0.005, 12)); }

TEST(Wind, DR2_StepsKeepTheVarianceExactly) {
  // The stationary covariance is a fixed point of the step, and the output's variance is one, for any step.
  Eigen::Matrix2d P;
  P << 1.0, std::numbers::sqrt2 / 2.0, std::numbers::sqrt2 / 2.0, 1.0;
  EXPECT_NEAR(second_order_output() * P * second_order_output().transpose(), 1.0, 1e-12);
  for (double path = 1e-9; path < 100.0; path *= 1.7) {
    const SecondOrderStep step = second_order_step(path);
    const Eigen::Matrix2d next = step.decay * P * step.decay.transpose() + step.noise * step.noise.transpose();
    EXPECT_LT((next - P).cwiseAbs().maxCoeff(), 1e-12) << path;
    const FirstOrderStep first = first_order_step(path);
    EXPECT_NEAR(first.decay * first.decay + first.noise * first.noise, 1.0, 1e-12) << path;
  }
}

TEST(Wind, DR2_TwoHalfStepsAreOneStep) {
  for (const double path : {1e-4, 0.03, 0.7, 3.0}) {
    const SecondOrderStep half = second_order_step(0.5 * path), whole = second_order_step(path);
    EXPECT_LT((half.decay * half.decay - whole.decay).norm(), 1e-13);
    const Eigen::Matrix2d Q = half.noise * half.noise.transpose();
    const Eigen::Matrix2d twice = half.decay * Q * half.decay.transpose() + Q;
    EXPECT_LT((twice - whole.noise * whole.noise.transpose()).norm(), 1e-13);
  }
}

/// Returns the one-sided spectral density at some frequencies (rad/s), from Hann-windowed segments.
/// @param component  0 u, 1 v, 2 w.
std::vector<double> spectrum(int component, const std::vector<double>& w_radps, double dt, int per_segment,
                             int segments) {
  Wind wind(turbulent(), 13);
  std::vector<double> density(w_radps.size(), 0.0);
  std::vector<std::complex<double>> sums(w_radps.size());
  for (int s = 0; s < segments; ++s) {
    std::fill(sums.begin(), sums.end(), 0.0);
    double window_power = 0.0;
    for (int i = 0; i < per_segment; ++i) {
      const double x = wind.sample(kHeightM, {kSpeedMps, 0.0, 0.0}, dt)[component];
      const double window = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * i / per_segment);
      window_power += window * window;
      for (size_t k = 0; k < sums.size(); ++k) sums[k] += window * x * std::polar(1.0, -w_radps[k] * i * dt);
    }
    for (size_t k = 0; k < sums.size(); ++k) {
      density[k] += std::norm(sums[k]) * dt / (std::numbers::pi * window_power * segments);
    }
  }
  return density;
}

// Check DR3.
TEST(Wind, DR3_SpectraHaveDrydensShape) {
  const DrydenScales s = dryden_scales(kHeightM, kW20);
  const int segments = 2000, per_segment = 800;
  for (const auto& [component, length, sigma] :
       {std::tuple{0, s.length_uv_m, s.sigma_uv_mps}, std::tuple{2, s.length_w_m, s.sigma_w_mps}}) {
    const double corner = kSpeedMps / length;
    const double dt = 0.05 / corner;
    const std::vector<double> density =
        spectrum(component, {corner / std::numbers::sqrt3, corner}, dt, per_segment, segments);
    // At frequency zero u has twice the density of w.
    const double at_zero = sigma * sigma * length / (std::numbers::pi * kSpeedMps) * (component == 0 ? 2.0 : 1.0);
    const std::string of = component == 0 ? "Phi_u" : "Phi_w";
    expect_recorded_relative(of + " at V/(sqrt(3) L) over that at 0", density[0] / at_zero,
                             component == 0 ? 0.75 : 1.125, 0.1);
    expect_recorded_relative(of + " at V/L over that at 0", density[1] / at_zero, component == 0 ? 0.5 : 1.0, 0.1);
  }
}

// Check DR4.
TEST(Wind, DR4_AutocorrelationHasTheZeroOfDrydensModel) {
  const DrydenScales s = dryden_scales(kHeightM, kW20);
  const double dt = 0.02, speed = 10.0;
  Wind wind(turbulent(), 14);
  const auto lag = static_cast<size_t>(std::lround(s.length_w_m / speed / dt));  // 1 s
  std::vector<double> u, w;
  for (int i = 0; i < 1500000; ++i) {
    const Eigen::Vector3d g = wind.sample(kHeightM, {speed, 0.0, 0.0}, dt);
    u.push_back(g[0]);
    w.push_back(g[2]);
  }
  const auto correlation = [](const std::vector<double>& x, size_t k, double sigma) {
    double sum = 0.0;
    for (size_t i = 0; i + k < x.size(); ++i) sum += x[i] * x[i + k];
    return sum / static_cast<double>(x.size() - k) / (sigma * sigma);
  };
  expect_recorded("R_w at 1 s over its variance", correlation(w, lag, s.sigma_w_mps), std::exp(-1.0) * 0.5, 0.05);
  expect_recorded("R_w at 2 s over its variance", correlation(w, 2 * lag, s.sigma_w_mps), 0.0, 0.05);
  const double tau = static_cast<double>(2 * lag) * dt;
  expect_recorded("R_u at 2 s over its variance", correlation(u, 2 * lag, s.sigma_uv_mps),
                  std::exp(-speed * tau / s.length_uv_m), 0.05);
}

TEST(Wind, DR5_SameSeedSameWindBitForBit) {
  Wind a(turbulent(), 5), b(turbulent(), 5), other(turbulent(), 6);
  bool differs = false;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d v{0.1 * i, 1.0, 0.0};
    const Eigen::Vector3d x = a.sample(3.0 + i, v, 0.002);
    ASSERT_EQ(x, b.sample(3.0 + i, v, 0.002));
    differs = differs || x != other.sample(3.0 + i, v, 0.002);
  }
  EXPECT_TRUE(differs);
}

// Check DR6.
constexpr double kSlopeTruncation = 2e-6;  // of central differences over a thousandth of the length, relative

TEST(Gust, DR6_RisesAsACosine) {
  const GustConfig gust{.speed_mps = 8.0, .length_m = 25.0, .hold_m = 10.0};
  const double step_m = 0.001 * gust.length_m;
  const auto slope = [&](double way_m) {
    return (gust_speed_mps(gust, way_m + step_m) - gust_speed_mps(gust, way_m - step_m)) / (2.0 * step_m);
  };
  const double steepest = std::numbers::pi * 8.0 / (2.0 * 25.0);
  expect_recorded("speed at mid length, m/s", gust_speed_mps(gust, 12.5), 4.0, 1e-12);
  expect_recorded_relative("slope at mid length, 1/s", slope(12.5), steepest, kSlopeTruncation);
  // The difference includes one step of the rise: pi s / 4 d of the maximum slope.
  expect_recorded("slope at the beginning, 1/s", slope(0.0), 0.0, 1e-3 * steepest);
  expect_recorded("slope at the top, 1/s", slope(25.0), 0.0, 1e-3 * steepest);
}

TEST(Gust, DR6_HoldsAndFallsSymmetrically) {
  const GustConfig gust{.speed_mps = 8.0, .length_m = 25.0, .hold_m = 10.0};
  EXPECT_DOUBLE_EQ(gust_speed_mps(gust, 25.0), 8.0);
  EXPECT_DOUBLE_EQ(gust_speed_mps(gust, 30.0), 8.0);
  EXPECT_DOUBLE_EQ(gust_speed_mps(gust, 35.0), 8.0);
  for (const double way_m : {0.0, 3.0, 12.5, 20.0, 27.0}) {
    EXPECT_NEAR(gust_speed_mps(gust, way_m), gust_speed_mps(gust, 60.0 - way_m), 1e-12);
  }
  EXPECT_EQ(gust_speed_mps(gust, -1.0), 0.0);
  EXPECT_EQ(gust_speed_mps(gust, 61.0), 0.0);
}

TEST(Wind, DR6_GustStartsAtItsTimeAndPassesAtTheAirspeed) {
  // A headwind of 4 m/s at a ground speed of 6 m/s: 10 m of air per second, so half the length 1 s after the start.
  Wind wind({.speed_mps = 4.0,
             .gust = {.speed_mps = 6.0, .from_rad = std::numbers::pi / 2.0, .start_s = 2.0, .length_m = 20.0}},
            1);
  const double dt = 0.002;
  const auto gust_W = [&](double duration_s) {
    Eigen::Vector3d air_W;
    for (int i = 0; i < std::lround(duration_s / dt); ++i) air_W = wind.sample(10.0, {6.0, 0.0, 0.0}, dt);
    return Eigen::Vector3d(air_W - Eigen::Vector3d{-4.0, 0.0, 0.0});
  };
  EXPECT_LT(gust_W(2.0).norm(), 1e-9);
  EXPECT_LT((gust_W(1.0) - Eigen::Vector3d{0.0, -3.0, 0.0}).norm(), 1e-9);
  EXPECT_LT((gust_W(1.0) - Eigen::Vector3d{0.0, -6.0, 0.0}).norm(), 1e-9);
  EXPECT_LT(gust_W(2.0).norm(), 1e-9);
}

TEST(Wind, GustDoesNotChangeTheTurbulence) {
  WindConfig gusty = turbulent();
  gusty.gust = {.speed_mps = 5.0, .from_rad = std::numbers::pi, .start_s = 0.1, .length_m = 2.0, .hold_m = 1000.0};
  Wind a(turbulent(), 5), b(gusty, 5);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d difference_W =
        b.sample(10.0, {kSpeedMps, 0.0, 0.0}, 0.002) - a.sample(10.0, {kSpeedMps, 0.0, 0.0}, 0.002);
    if (i < 50) {
      ASSERT_EQ(difference_W, Eigen::Vector3d::Zero());
    } else if (i > 100) {
      ASSERT_LT((difference_W - Eigen::Vector3d{5.0, 0.0, 0.0}).norm(), 1e-12);
    }
  }
}

TEST(Wind, ShearFollowsTheLogarithmOfTheHeight) {
  // At the roughness times e, e^2, e^3 the wind is in the ratio 1 : 2 : 3; at 20 ft it is as set; at the ground it is
  // 0.
  const double z0 = 0.046, e = std::numbers::e;
  Wind wind({.speed_mps = 7.0, .from_rad = std::numbers::pi, .roughness_m = z0}, 1);
  const auto north = [&](double height_m) { return wind.sample(height_m, {0, 0, 0}, 0.002).x(); };
  EXPECT_NEAR(north(6.096), 7.0, 1e-12);
  EXPECT_NEAR(north(z0 * e * e) / north(z0 * e), 2.0, 1e-12);
  EXPECT_NEAR(north(z0 * e * e * e) / north(z0 * e), 3.0, 1e-12);
  EXPECT_NEAR(north(60.96) - north(6.096), 7.0 * std::numbers::ln10 / std::log(6.096 / z0), 1e-12);
  for (const double height_m : {z0, 0.01, 0.0, -3.0}) EXPECT_EQ(north(height_m), 0.0);
  EXPECT_EQ(north(304.8), north(1000.0));
}

TEST(Wind, SteadyWindComesFromItsHeading) {
  Wind wind({.speed_mps = 5.0, .from_rad = std::numbers::pi / 2.0}, 1);  // from the east
  EXPECT_LT((wind.sample(10.0, {1, 2, 3}, 0.002) - Eigen::Vector3d{0.0, -5.0, 0.0}).norm(), 1e-12);
}

TEST(Wind, SeedDrawsTheHeadingWithinItsSpread) {
  double least = 9.0, most = -9.0;
  for (uint64_t seed = 1; seed <= 500; ++seed) {
    const Eigen::Vector3d air_W = Wind({.speed_mps = 5.0, .from_rad = 0.5, .spread_rad = 0.7}, seed).steady_W(10.0);
    EXPECT_NEAR(air_W.norm(), 5.0, 1e-12);
    least = std::min(least, std::atan2(-air_W.y(), -air_W.x()));
    most = std::max(most, std::atan2(-air_W.y(), -air_W.x()));
  }
  constexpr double kGap = 0.02;  // the probability that 500 draws all miss either end by this is below 1e-3
  EXPECT_NEAR(least, -0.2 + 0.5 * kGap, 0.5 * kGap);
  EXPECT_NEAR(most, 1.2 - 0.5 * kGap, 0.5 * kGap);
}

TEST(Wind, TurbulenceAddsToTheSteadyWindAndRotatesWithIt) {
  // A wind from the south blows north, along W's axes; from the west it blows east, rotated by 90 degrees.
  Wind north({.speed_mps = 5.0, .from_rad = std::numbers::pi, .turbulence_w20_mps = kW20}, 9);
  Wind east({.speed_mps = 5.0, .from_rad = -std::numbers::pi / 2.0, .turbulence_w20_mps = kW20}, 9);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d a = north.sample(10.0, {0, 0, 0}, 0.02);
    const Eigen::Vector3d b = east.sample(10.0, {0, 0, 0}, 0.02);
    EXPECT_LT((b - Eigen::Vector3d{-a.y(), a.x(), a.z()}).norm(), 1e-9);
  }
}

TEST(Wind, RefusesInvalidConfigs) {
  EXPECT_THROW(Wind({.speed_mps = -1.0}, 1), std::invalid_argument);
  EXPECT_THROW(Wind({.turbulence_w20_mps = std::numeric_limits<double>::infinity()}, 1), std::invalid_argument);
  EXPECT_THROW(Wind({.roughness_m = 6.096}, 1), std::invalid_argument);
  EXPECT_THROW(Wind({.gust = {.speed_mps = 1.0, .length_m = 0.0}}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::dynamics::air
