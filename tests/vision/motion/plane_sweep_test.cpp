#include "vision/motion/plane_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/vision/motion/cast_world.h"

namespace hedgehop::vision::motion {
namespace {

constexpr camera::PinholeCamera kCamera{240, 136, 131.0, 131.0, 119.5, 67.5};
constexpr double kNoiseGrey = 2.8;  // twice that of MatchNoise: the mean of four pixels has half the noise

/// A world whose texture is a few times the noise, so that noise decides the error.
CastWorld faint_world() {
  CastWorld world;
  world.contrast = 0.3;
  return world;
}

/// Two images of a camera that flies ahead, to the side and turns.
struct Pair {
  CastWorld::Image key, here;
  CameraMotion motion;
};

Pair fly(const CastWorld& world, const Eigen::Vector3d& by_W, double noise_grey, uint64_t seed) {
  std::mt19937_64 generator(seed);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.05, Eigen::Vector3d(0.5, 0.6, 0.6).normalized()));
  const Eigen::Isometry3d X_WCk = CastWorld::looking_north(Eigen::Vector3d::Zero());
  const Eigen::Isometry3d X_WC = CastWorld::looking_north(by_W, turn);
  const Eigen::Isometry3d X_CCk = X_WC.inverse() * X_WCk;
  return {world.image(kCamera, X_WCk, noise_grey, generator),
          world.image(kCamera, X_WC, noise_grey, generator),
          {X_CCk.linear(), X_CCk.translation(), 0.0, 0.0}};
}

InverseDepth match(const Pair& pair) {
  PlaneSweep sweep(kCamera, {});
  return sweep.match(PlaneSweep::smooth(pair.here.grey), PlaneSweep::smooth(pair.key.grey), pair.motion);
}

struct Errors {
  double variance = 0.0, mean = 0.0;  ///< of errors divided by sigma, without outliers
  double outliers = 0.0;              ///< share beyond 4 sigma
  double matched = 0.0;               ///< share of all pixels
};

/// Compares depth with ray casting, except at windows across a step in depth.
Errors errors_of(const InverseDepth& depth, const cv::Mat& truth_per_m) {
  constexpr int kEdgePx = 10;
  constexpr float kStepPerM = 0.06F;
  Errors errors;
  int all = 0, matched = 0, inside = 0;
  for (int v = kEdgePx; v < depth.per_m.rows - kEdgePx; ++v) {
    for (int u = kEdgePx; u < depth.per_m.cols - kEdgePx; ++u) {
      double low = 1e9, high = 0.0;
      cv::minMaxLoc(truth_per_m(cv::Rect(2 * u - kEdgePx, 2 * v - kEdgePx, 2 * kEdgePx, 2 * kEdgePx)), &low, &high);
      if (high - low > kStepPerM) continue;
      ++all;
      const float per_m = depth.per_m.at<float>(v, u), sigma = depth.sigma_per_m.at<float>(v, u);
      if (std::isnan(per_m)) continue;
      ++matched;
      const double truth =
          0.25 * (truth_per_m.at<float>(2 * v, 2 * u) + truth_per_m.at<float>(2 * v + 1, 2 * u) +
                  truth_per_m.at<float>(2 * v, 2 * u + 1) + truth_per_m.at<float>(2 * v + 1, 2 * u + 1));
      const double error = (per_m - truth) / sigma;
      if (std::abs(error) > 4.0) continue;
      ++inside;
      errors.mean += error;
      errors.variance += error * error;
    }
  }
  errors.mean /= inside;
  errors.variance /= inside;
  errors.outliers = 1.0 - static_cast<double>(inside) / matched;
  errors.matched = static_cast<double>(matched) / all;
  return errors;
}

TEST(PlaneSweep, ErrorsHaveTheStatedSigma) {
  for (const Eigen::Vector3d& by_W : {Eigen::Vector3d(0.8, 0.1, 0.05), Eigen::Vector3d(0.1, 0.5, 0.0)}) {
    const Pair pair = fly(faint_world(), by_W, kNoiseGrey, 1);
    const Errors errors = errors_of(match(pair), pair.here.per_m);
    EXPECT_GT(errors.matched, 0.8) << by_W.transpose();
    EXPECT_LT(errors.outliers, 0.04) << by_W.transpose();
    EXPECT_GT(errors.variance, 0.3) << by_W.transpose();
    EXPECT_LT(errors.variance, 1.6) << by_W.transpose();
    EXPECT_LT(std::abs(errors.mean), 0.8) << by_W.transpose();  // interpolation on a wall of one depth errs one way
  }
}

// A sigma that ignores the motion's error would be exceeded many times.
TEST(PlaneSweep, SigmaContainsTheErrorOfTheMotion) {
  Pair pair = fly({}, {0.8, 0.0, 0.0}, kNoiseGrey, 2);
  pair.motion.p_CCk.x() += 0.08;
  const InverseDepth overconfident = match(pair);
  pair.motion.sigma_p_m = 0.08;
  EXPECT_GT(errors_of(overconfident, pair.here.per_m).outliers, 0.1);
  const Errors errors = errors_of(match(pair), pair.here.per_m);
  EXPECT_LT(errors.outliers, 0.04);
  EXPECT_LT(errors.variance, 2.0);
}

TEST(PlaneSweep, SigmaIsInfiniteAtTheFocusOfExpansionAndFallsWithTheDistanceFromIt) {
  const CameraMotion motion{Eigen::Matrix3d::Identity(), {-0.2, 0.0, -1.0}, 0.01, 1e-3};
  const Eigen::Vector3d textured(1e4, 0.0, 1e4), focus_C(0.2, 0.0, 1.0);
  EXPECT_GT(sigma_of_inverse_depth(focus_C, motion, 0.1, 175.0, textured, {}), 1e6);
  double before = HUGE_VAL;
  for (const double aside : {0.01, 0.05, 0.2, 0.5}) {
    const double sigma =
        sigma_of_inverse_depth(focus_C + Eigen::Vector3d(0.0, aside, 0.0), motion, 0.1, 175.0, textured, {});
    EXPECT_LT(sigma, before);
    before = sigma;
  }
}

/// Returns the inverse depth at which the place of a pixel in the key image is nearest to a match.
double triangulate(const Eigen::Vector3d& ray_C, const Eigen::Matrix3d& R_CCk, const Eigen::Vector3d& p_CCk,
                   const Eigen::Vector2d& match_px) {
  const auto off_px = [&](double per_m) {
    const Eigen::Vector3d p_Ck = R_CCk.transpose() * (ray_C - per_m * p_CCk);
    return (175.0 * p_Ck.head<2>() / p_Ck.z() - match_px).norm();
  };
  double low = 0.0, high = 0.6;
  for (int i = 0; i < 60; ++i) {  // the distance has one minimum
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    (off_px(a) < off_px(b) ? high : low) = off_px(a) < off_px(b) ? b : a;
  }
  return 0.5 * (low + high);
}

TEST(PlaneSweep, SigmaOfMatchAndMotionIsThatOfAMonteCarloSimulation) {
  constexpr double kMatchPx = 0.2, kPositionM = 0.01, kTurnRad = 1e-3, kPerM = 0.15;
  constexpr int kDraws = 3000;
  constexpr double kSampling = 0.08;  // three times the relative error of a deviation from this many draws, and more
  const Eigen::Vector3d p_CCk(-0.1, 0.05, -1.0);
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  const auto vector = [&](double sigma) {
    return Eigen::Vector3d(sigma * normal(generator), sigma * normal(generator), sigma * normal(generator));
  };
  for (const Eigen::Vector3d& ray_C :
       {Eigen::Vector3d(0.5, 0.1, 1.0), Eigen::Vector3d(-0.3, 0.4, 1.0), Eigen::Vector3d(0.1, 0.15, 1.0)}) {
    const Eigen::Vector3d p_Ck = ray_C - kPerM * p_CCk;
    const Eigen::Vector2d true_px = 175.0 * p_Ck.head<2>() / p_Ck.z();
    double sum2 = 0.0;
    for (int i = 0; i < kDraws; ++i) {
      const Eigen::Vector3d turn = vector(kTurnRad);
      const Eigen::Matrix3d R_CCk = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
      const Eigen::Vector2d match_px = true_px + kMatchPx * Eigen::Vector2d(normal(generator), normal(generator));
      const double error = triangulate(ray_C, R_CCk, p_CCk + vector(kPositionM), match_px) - kPerM;
      sum2 += error * error;
    }
    constexpr double kNoNoise = 1e-9;
    const CameraMotion motion{Eigen::Matrix3d::Identity(), p_CCk, kPositionM, kTurnRad};
    const double sigma =
        sigma_of_inverse_depth(ray_C, motion, kPerM, 175.0, {1.0, 0.0, 1.0}, {kNoNoise, kMatchPx, 0.0});
    EXPECT_NEAR(sigma / std::sqrt(sum2 / kDraws), 1.0, kSampling) << ray_C.transpose();
  }
}

// Equal scenes with other noise: the scatter of the depth is that of the grey noise alone. The absolute difference
// scatters more than the bound, which belongs to the squared one.
TEST(PlaneSweep, ScatterByGreyNoiseIsThatOfTheBound) {
  constexpr int kDraws = 4;
  constexpr double kLeastRatio = 0.8, kMostRatio = 1.6;
  std::vector<InverseDepth> depths;
  const MatchNoise only_grey{1.4, 1e-6, 0.0};
  PlaneSweep sweep(kCamera, only_grey);
  for (int i = 0; i < kDraws; ++i) {
    const Pair pair = fly(faint_world(), {0.8, 0.0, 0.0}, kNoiseGrey, 10 + static_cast<uint64_t>(i));
    depths.push_back(sweep.match(PlaneSweep::smooth(pair.here.grey), PlaneSweep::smooth(pair.key.grey), pair.motion));
  }
  double ratio2 = 0.0;
  int pixels = 0;
  for (int v = 0; v < depths[0].per_m.rows; ++v) {
    for (int u = 0; u < depths[0].per_m.cols; ++u) {
      double sum = 0.0, sum2 = 0.0, sigma2 = 0.0;
      for (const InverseDepth& depth : depths) {
        const double per_m = depth.per_m.at<float>(v, u), sigma = depth.sigma_per_m.at<float>(v, u);
        sum += per_m;
        sum2 += per_m * per_m;
        sigma2 += sigma * sigma / kDraws;
      }
      const double variance = (sum2 - sum * sum / kDraws) / (kDraws - 1);
      if (std::isnan(variance) || variance > 25.0 * sigma2) continue;  // in one of them a different match
      ratio2 += variance / sigma2;
      ++pixels;
    }
  }
  ASSERT_GT(pixels, 2000);
  EXPECT_GT(std::sqrt(ratio2 / pixels), kLeastRatio);
  EXPECT_LT(std::sqrt(ratio2 / pixels), kMostRatio);
}

TEST(PlaneSweep, SmoothAreasAndCamerasAtRestHaveNoDepth) {
  CastWorld plain;
  plain.contrast = 0.0;
  const InverseDepth none = match(fly(plain, {0.8, 0.0, 0.0}, kNoiseGrey, 3));
  int matched = 0;
  for (int v = 0; v < none.per_m.rows; ++v) {
    for (int u = 0; u < none.per_m.cols; ++u) matched += !std::isnan(none.per_m.at<float>(v, u));
  }
  EXPECT_LT(matched, 0.05 * none.per_m.rows * none.per_m.cols);
  const InverseDepth at_rest = match(fly({}, Eigen::Vector3d::Zero(), 0.0, 4));
  EXPECT_EQ(cv::countNonZero(at_rest.per_m == at_rest.per_m), 0);
}

TEST(PlaneSweep, RefusesOddSizesAndOblongPixels) {
  EXPECT_THROW(PlaneSweep({321, 180, 175.0, 175.0, 160.0, 89.5}, {}), std::invalid_argument);
  EXPECT_THROW(PlaneSweep({320, 180, 175.0, 180.0, 159.5, 89.5}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::vision::motion
