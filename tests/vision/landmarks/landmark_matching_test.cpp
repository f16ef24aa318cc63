#include "vision/landmarks/landmark_matching.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Vector2d;
using Matches = std::vector<std::optional<size_t>>;

/// J^2 / C with the gradients of J = |Z - x|^2 by finite differences, [Shah2009] eq. (4.5), (4.6).
double z_by_differences(const PredictedBearing& seen, const Vector2d& measured) {
  const auto J = [&](const Vector2d& x) { return (measured - x).squaredNorm(); };
  constexpr double kStep = 1e-4;  // J is a parabola: central differences are exact for any step
  Vector2d gradient;
  for (int i = 0; i < 2; ++i) {
    gradient[i] =
        (J(seen.bearing + kStep * Vector2d::Unit(i)) - J(seen.bearing - kStep * Vector2d::Unit(i))) / 2 / kStep;
  }
  return J(seen.bearing) * J(seen.bearing) / gradient.dot(seen.covariance * gradient);
}

/// Exhaustive matching over all pairs.
Matches all_pairs(const std::vector<std::optional<PredictedBearing>>& predicted, const std::vector<Vector2d>& measured,
                  double gate) {
  Matches found(measured.size());
  std::vector<bool> taken(predicted.size(), false);
  while (true) {
    double least = gate;
    std::optional<std::pair<size_t, size_t>> best;
    for (size_t i = 0; i < measured.size(); ++i) {
      for (size_t k = 0; k < predicted.size(); ++k) {
        if (found[i] || taken[k] || !predicted[k]) continue;
        const double z = z_by_differences(*predicted[k], measured[i]);
        if (z < least) {
          least = z;
          best = {i, k};
        }
      }
    }
    if (!best) return found;
    found[best->first] = best->second;
    taken[best->second] = true;
  }
}

std::optional<PredictedBearing> random_prediction(std::mt19937_64& random) {
  if (random() % 10 == 0) return std::nullopt;
  PredictedBearing seen;
  seen.bearing = {uniform(random, -0.3, 0.3), uniform(random, -0.2, 0.2)};
  Eigen::Matrix2d root;
  for (int i = 0; i < 4; ++i) root(i) = 0.03 * std::pow(uniform(random, 0, 1), 3) * (random() % 2 ? 1.0 : -1.0);
  seen.covariance = root * root.transpose() + 1e-6 * Eigen::Matrix2d::Identity();
  return seen;
}

TEST(LandmarkMatching, EqualsExhaustiveMatchingOnRandomScenes) {
  std::mt19937_64 random(21);
  size_t matched = 0, all = 0;
  for (int scene = 0; scene < 150; ++scene) {
    std::vector<std::optional<PredictedBearing>> predicted(random() % 60);
    for (auto& one : predicted) one = random_prediction(random);
    std::vector<Vector2d> measured(random() % 60);
    for (Vector2d& one : measured) one = {uniform(random, -0.3, 0.3), uniform(random, -0.2, 0.2)};
    const double gate = uniform(random, 0.3, 6.0);
    const Matches found = match_landmarks(predicted, measured, gate);
    EXPECT_EQ(found, all_pairs(predicted, measured, gate)) << scene;
    for (const auto& match : found) matched += match.has_value();
    all += measured.size();
  }
  EXPECT_GT(matched, all / 5);  // the scenes are dense enough for ambiguous matches
  EXPECT_LT(matched, all - all / 5);
}

TEST(LandmarkMatching, GateIsAQuarterOfTheSquaredStandardDeviations) {
  PredictedBearing seen;
  seen.bearing = {0.1, 0.0};
  seen.covariance << 4e-4, 0.0, 0.0, 1e-4;
  const std::vector<std::optional<PredictedBearing>> predicted = {seen};
  for (const double sigmas : {2.9, 3.1}) {
    const std::vector<Vector2d> across = {seen.bearing + Vector2d(0.02 * sigmas, 0)};
    const std::vector<Vector2d> along = {seen.bearing - Vector2d(0, 0.01 * sigmas)};
    EXPECT_EQ(match_landmarks(predicted, across, 9.0 / 4.0)[0].has_value(), sigmas < 3.0);
    EXPECT_EQ(match_landmarks(predicted, along, 9.0 / 4.0)[0].has_value(), sigmas < 3.0);
  }
}

TEST(LandmarkMatching, UncertainLandmarkIsMoreLikelyAtEqualDistance) {
  PredictedBearing sure, unsure;
  sure.bearing = {-0.01, 0.0};
  sure.covariance = 1e-4 * Eigen::Matrix2d::Identity();
  unsure.bearing = {0.01, 0.0};
  unsure.covariance = 4e-4 * Eigen::Matrix2d::Identity();
  EXPECT_EQ(
      match_landmarks(std::vector<std::optional<PredictedBearing>>{sure, unsure}, std::vector{Vector2d(0, 0)}, 9.0),
      Matches{1});
}

TEST(LandmarkMatching, IsEmptyForEmptyInput) {
  EXPECT_TRUE(match_landmarks({}, {}, 1.0).empty());
  EXPECT_EQ(match_landmarks({}, std::vector{Vector2d(0, 0)}, 1.0), Matches{std::nullopt});
}

}  // namespace
}  // namespace hedgehop::vision::landmarks
