#include "dynamics/identification/flight_identification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace hedgehop::dynamics::identification {
namespace {

using Complex = std::complex<double>;

/// Largest differences of two responses of one state to one input.
struct Difference {
  double gain_db = 0.0, phase_deg = 0.0;
};
Difference difference(const FrequencyResponse& measured, const FrequencyResponse& exact, Eigen::Index state,
                      Eigen::Index input) {
  Difference worst;
  for (size_t i = 0; i < exact.responses.size(); ++i) {
    const Complex ratio = measured.responses[i](state, input) / exact.responses[i](state, input);
    worst.gain_db = std::max(worst.gain_db, std::abs(20.0 * std::log10(std::abs(ratio))));
    worst.phase_deg = std::max(worst.phase_deg, std::abs(std::arg(ratio)) * 180.0 / std::numbers::pi);
  }
  return worst;
}

/// Record of a linear system under u = sweep of one input - K x, at 100 Hz.
Record swept(const control::LinearSystem& system, const Eigen::MatrixXd& K, Eigen::Index axis) {
  constexpr double kStep = 0.01;
  const FrequencySweep sweep;
  const control::LinearSystem step = control::sampled(system, kStep);
  constexpr double kTailS = 20.0;
  const auto samples = static_cast<Eigen::Index>((sweep.duration_s + kTailS) / kStep);
  Record record{kStep, Eigen::MatrixXd(samples, system.B.cols()), Eigen::MatrixXd(samples, system.A.rows())};
  Eigen::VectorXd x = Eigen::VectorXd::Zero(system.A.rows()), before = Eigen::VectorXd::Zero(system.B.cols());
  for (Eigen::Index i = 0; i < samples; ++i) {
    const Eigen::VectorXd u =
        sweep_input(sweep, static_cast<double>(i) * kStep) * Eigen::VectorXd::Unit(system.B.cols(), axis) - K * x;
    record.inputs.row(i) = 0.5 * (before + u);
    record.states.row(i) = x;
    x = step.A * x + step.B * u;
    before = u;
  }
  return record;
}

TEST(SweepInput, BeginsAndEndsWithItsFrequencies) {
  const FrequencySweep sweep{.from_radps = 0.5, .to_radps = 20.0, .duration_s = 60.0};
  std::vector<double> zeros_s;
  double before = sweep_input(sweep, 1e-3);
  for (double t_s = 2e-3; t_s < sweep.duration_s; t_s += 1e-3) {
    const double now = sweep_input(sweep, t_s);
    if (before * now < 0.0) zeros_s.push_back(t_s);
    before = now;
  }
  const double first = std::numbers::pi / zeros_s.front();
  const double last = std::numbers::pi / (zeros_s.back() - zeros_s[zeros_s.size() - 2]);
  EXPECT_NEAR(first, 0.5, 0.1) << "mean frequency of the first half period";
  EXPECT_NEAR(last, 20.0, 0.4);
  EXPECT_EQ(sweep_input(sweep, -1.0), 0.0);
  EXPECT_EQ(sweep_input(sweep, 60.0), 0.0);
}

TEST(DoubletInput, HasTwoEqualHalves) {
  EXPECT_EQ(doublet_input(2.0, 1.0, 0.5, 0.9), 0.0);
  EXPECT_EQ(doublet_input(2.0, 1.0, 0.5, 1.4), 2.0);
  EXPECT_EQ(doublet_input(2.0, 1.0, 0.5, 1.6), -2.0);
  EXPECT_EQ(doublet_input(2.0, 1.0, 0.5, 2.1), 0.0);
}

TEST(IdentifiedResponse, IsTheClosedFormOfASecondOrderSystem) {
  constexpr double kW = 6.0, kDamping = 0.2;
  control::LinearSystem system;
  system.A = Eigen::Matrix2d{{0.0, 1.0}, {-kW * kW, -2.0 * kDamping * kW}};
  system.B = Eigen::Vector2d{0.0, kW * kW};
  const std::vector<double> frequencies = log_spaced(0.5, 25.0, 30);
  const std::vector<Record> records{swept(system, Eigen::MatrixXd::Zero(1, 2), 0)};
  const FrequencyResponse measured = identified_response(records, frequencies);
  FrequencyResponse exact = measured;
  for (size_t i = 0; i < frequencies.size(); ++i) {
    const Complex s(0.0, frequencies[i]);
    exact.responses[i](0, 0) = kW * kW / (s * s + 2.0 * kDamping * kW * s + kW * kW);
    EXPECT_GT(measured.coherence(static_cast<Eigen::Index>(i), 0), 0.99) << frequencies[i];
  }
  // Windows average the response over neighboring frequencies, and samples hold the input for 10 ms.
  const Difference worst = difference(measured, exact, 0, 0);
  EXPECT_LT(worst.gain_db, 0.3);
  EXPECT_LT(worst.phase_deg, 2.0);
}

TEST(IdentifiedResponse, SeparatesTwoInputsOfAnUnstableSystemWithFeedback) {
  control::LinearSystem system;
  system.A = Eigen::Matrix2d{{0.3, 1.0}, {-0.5, -2.0}};
  system.B = Eigen::Matrix2d{{1.0, 0.4}, {0.0, 1.0}};
  const Eigen::Matrix2d K{{1.5, 0.2}, {0.3, 0.0}};
  const std::vector<double> frequencies = log_spaced(0.5, 10.0, 20);
  const std::vector<Record> records{swept(system, K, 0), swept(system, K, 1)};
  const FrequencyResponse measured = identified_response(records, frequencies);
  const FrequencyResponse exact = linear_response(system, frequencies);
  for (Eigen::Index state : {0, 1}) {
    for (Eigen::Index input : {0, 1}) {
      const Difference worst = difference(measured, exact, state, input);
      EXPECT_LT(worst.gain_db, 0.5) << state << input;
      EXPECT_LT(worst.phase_deg, 4.0) << state << input;
    }
  }
}

/// On-axis responses: w, p, q and r to the controls in their order.
constexpr std::array<Eigen::Index, 4> kOnAxis = {2, 3, 4, 5};

TEST(Identification, FindsTheLinearModelOfAHelicopterInTheFullModel) {
  for (const double speed_mps : {0.0, 12.0}) {
    const auto found = identify(helicopter::HelicopterConfig{}, {.v_air_W = {speed_mps, 0.0, 0.0}});
    ASSERT_TRUE(found);
    for (Eigen::Index input = 0; input < kControlAxes; ++input) {
      const Eigen::Index state = kOnAxis[static_cast<size_t>(input)];
      EXPECT_LT(mismatch(found->measured, found->model, state, input), 50.0) << speed_mps << " m/s, input " << input;
      EXPECT_GT(found->measured.coherence.col(state).mean(), 0.9) << speed_mps << " m/s, input " << input;
    }
  }
}

TEST(Identification, FindsTheLinearModelOfAMulticopterInTheFullModel) {
  const auto found = identify(multicopter::MulticopterConfig{}, {});
  ASSERT_TRUE(found);
  for (Eigen::Index input = 0; input < kControlAxes; ++input) {
    const Eigen::Index state = kOnAxis[static_cast<size_t>(input)];
    EXPECT_LT(mismatch(found->measured, found->model, state, input), 10.0) << input;
  }
}

TEST(FlyTest, FollowsTheLinearModelAfterASmallStep) {
  const helicopter::HelicopterConfig config;
  constexpr double kSmallRad = 1e-3, kSecondOrder = 0.02;
  const TestFlight test{
      .input = [](double t_s) { return Controls(step_input(kSmallRad, 0.1, t_s) * Controls::Unit(kPitch)); },
      .duration_s = 1.0,
      .gain = {},
      .steps_per_sample = 1};
  const auto record = fly_test(config, test);
  ASSERT_TRUE(record);
  const auto linear = linear_system(config, Eigen::Vector3d::Zero());
  const Eigen::MatrixXd states = linear_states(linear->system, *record);
  constexpr Eigen::Index kPitchRate = 4;
  const double peak = record->states.col(kPitchRate).cwiseAbs().maxCoeff();
  EXPECT_GT(peak, 0.01);
  EXPECT_LT((record->states.col(kPitchRate) - states.col(kPitchRate)).cwiseAbs().maxCoeff(), kSecondOrder * peak);
}

}  // namespace
}  // namespace hedgehop::dynamics::identification
