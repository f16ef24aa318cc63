#include "vision/landmarks/bundle_adjustment.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>
#include <random>

#include "tests/vision/landmarks/looking_at.h"

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr BundleNoise kNoise{
    .bearing = 5e-4, .position_m = 0.3, .attitude_rad = 1e-3, .step_m_rt_s = 0.05, .turn_rad_rt_s = 3e-4};
constexpr double kFrameS = 0.5;

Isometry3d turned(const Isometry3d& X, const Vector3d& turn) {
  Isometry3d result = X;
  if (turn.norm() > 0.0) {
    result.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * X.linear();
  }
  return result;
}

/// A flight on an arc about points near the origin. Frames hold exact sensors unless errors are added.
struct Flight {
  std::vector<BundleFrame> frames;
  std::vector<Isometry3d> truth;
  std::vector<Vector3d> points_W;
  Isometry3d X_BC = Isometry3d::Identity();
};

Flight exact_flight(size_t images, std::mt19937_64& random) {
  Flight flight;
  flight.X_BC.translation() = Vector3d(0.3, 0.1, -0.2);
  std::uniform_real_distribution<double> aside_m(-10.0, 10.0), up_m(-15.0, 0.0);
  for (int i = 0; i < 8; ++i) flight.points_W.emplace_back(aside_m(random), aside_m(random), up_m(random));
  for (size_t k = 0; k < images; ++k) {
    const double angle = std::numbers::pi + 0.03 * static_cast<double>(k);
    const Isometry3d X_WC = looking_at({40.0 * std::cos(angle), 40.0 * std::sin(angle), -40.0}, {0, 0, -7});
    BundleFrame frame;
    frame.X_WB = frame.X_WB_nav = X_WC * flight.X_BC.inverse();
    if (k > 0) {
      const Isometry3d& before = flight.truth.back();
      frame.step_W = frame.X_WB.translation() - before.translation();
      frame.turn_B = before.linear().transpose() * frame.X_WB.linear();
      frame.dt_s = kFrameS;
    }
    for (size_t i = 0; i < flight.points_W.size(); ++i) {
      frame.bearings.push_back({i, project_point(flight.points_W[i], frame.X_WB, flight.X_BC).bearing});
    }
    flight.truth.push_back(frame.X_WB);
    flight.frames.push_back(frame);
  }
  return flight;
}

class Normal {
 public:
  explicit Normal(uint64_t seed) : random_(seed) {}
  Vector3d vector(double sigma) {
    const double x = normal_(random_), y = normal_(random_);
    return sigma * Vector3d(x, y, normal_(random_));
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

/// Adds errors with the standard deviations of `kNoise` to all sensors.
void add_errors(Flight& flight, Normal& normal) {
  const double root = std::sqrt(kFrameS);
  for (BundleFrame& frame : flight.frames) {
    frame.X_WB_nav = turned(frame.X_WB_nav, normal.vector(kNoise.attitude_rad));
    frame.X_WB_nav.translation() += normal.vector(kNoise.position_m);
    frame.X_WB = frame.X_WB_nav;
    frame.step_W += normal.vector(root * kNoise.step_m_rt_s);
    Isometry3d turn_B = Isometry3d::Identity();
    turn_B.linear() = frame.turn_B;
    frame.turn_B = turned(turn_B, normal.vector(root * kNoise.turn_rad_rt_s)).linear();
    for (BundleBearing& seen : frame.bearings) seen.bearing += normal.vector(kNoise.bearing).head<2>();
  }
}

TEST(BundleAdjustment, JacobiansAreThoseOfFiniteDifferences) {
  constexpr double kStep = 1e-6, kTruncation = 1e-8;
  std::mt19937_64 random(1);
  const Flight flight = exact_flight(3, random);
  for (const Isometry3d& X_WB : flight.truth) {
    for (const Vector3d& p_W : flight.points_W) {
      const BundleProjection at = project_point(p_W, X_WB, flight.X_BC);
      for (int i = 0; i < 3; ++i) {
        const Vector3d step = kStep * Vector3d::Unit(i);
        const auto bearing = [&](const Vector3d& p, const Isometry3d& X) {
          return project_point(p, X, flight.X_BC).bearing;
        };
        Isometry3d ahead = X_WB, behind = X_WB;
        ahead.translation() += step;
        behind.translation() -= step;
        const Eigen::Vector2d by_point = (bearing(p_W + step, X_WB) - bearing(p_W - step, X_WB)) / (2.0 * kStep);
        const Eigen::Vector2d by_position = (bearing(p_W, ahead) - bearing(p_W, behind)) / (2.0 * kStep);
        const Eigen::Vector2d by_turn =
            (bearing(p_W, turned(X_WB, step)) - bearing(p_W, turned(X_WB, -step))) / (2.0 * kStep);
        EXPECT_LT((at.d_point.col(i) - by_point).norm(), kTruncation);
        EXPECT_LT((at.d_pose.col(i) - by_position).norm(), kTruncation);
        EXPECT_LT((at.d_pose.col(3 + i) - by_turn).norm(), kTruncation);
      }
    }
  }
}

TEST(BundleAdjustment, ExactSensorsYieldExactPosesAndPoints) {
  constexpr double kConvergedM = 1e-6, kConvergedRad = 1e-8;
  std::mt19937_64 random(2);
  Flight flight = exact_flight(20, random);
  Normal normal(3);
  std::vector<Vector3d> points_W = flight.points_W;
  for (Vector3d& p_W : points_W) p_W += normal.vector(1.0);
  for (BundleFrame& frame : flight.frames) {
    frame.X_WB = turned(frame.X_WB, normal.vector(0.01));
    frame.X_WB.translation() += normal.vector(0.5);
  }
  const BundleResult result = adjust_bundle(flight.frames, points_W, flight.X_BC, kNoise, 50);
  EXPECT_LT(result.cost, 1e-9);
  for (size_t i = 0; i < points_W.size(); ++i) EXPECT_LT((points_W[i] - flight.points_W[i]).norm(), kConvergedM) << i;
  for (size_t k = 0; k < flight.frames.size(); ++k) {
    EXPECT_LT((flight.frames[k].X_WB.translation() - flight.truth[k].translation()).norm(), kConvergedM) << k;
    EXPECT_LT((flight.frames[k].X_WB.linear() - flight.truth[k].linear()).norm(), kConvergedRad) << k;
  }
}

// The mean of 150 squared errors over the reported covariance, three degrees of freedom each, has a standard deviation
// of 0.067. The poses must be better than the navigation's.
TEST(BundleAdjustment, CovarianceIsThatOfAMonteCarloTrial) {
  constexpr int kTrials = 150;
  constexpr double kFourSigmas = 0.27;
  std::mt19937_64 random(4);
  Normal normal(5);
  const Flight exact = exact_flight(12, random);
  double sum = 0.0, pose_m2 = 0.0, navigation_m2 = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Flight flight = exact;
    add_errors(flight, normal);
    std::vector<Vector3d> points_W = exact.points_W;
    const BundleResult result = adjust_bundle(flight.frames, points_W, flight.X_BC, kNoise, 20);
    const size_t i = static_cast<size_t>(trial) % points_W.size();
    const Vector3d error = points_W[i] - exact.points_W[i];
    sum += error.dot(result.covariances_W[i].inverse() * error) / 3.0;
    pose_m2 += (flight.frames[6].X_WB.translation() - flight.truth[6].translation()).squaredNorm();
    navigation_m2 += (flight.frames[6].X_WB_nav.translation() - flight.truth[6].translation()).squaredNorm();
  }
  EXPECT_NEAR(sum / kTrials, 1.0, kFourSigmas);
  EXPECT_LT(pose_m2, 0.25 * navigation_m2);
}

// One of 20 bearings is wrong by 100 sigmas.
TEST(BundleAdjustment, WrongMatchesHardlyMoveThePoints) {
  std::mt19937_64 random(6);
  Flight flight = exact_flight(20, random);
  for (size_t k = 0; k < flight.frames.size(); ++k) {
    flight.frames[k].bearings[k % flight.points_W.size()].bearing.x() += k % 3 == 0 ? 100.0 * kNoise.bearing : 0.0;
  }
  std::vector<Vector3d> points_W = flight.points_W;
  adjust_bundle(flight.frames, points_W, flight.X_BC, kNoise, 20);
  for (size_t i = 0; i < points_W.size(); ++i) EXPECT_LT((points_W[i] - flight.points_W[i]).norm(), 0.1) << i;
}

}  // namespace
}  // namespace hedgehop::vision::landmarks
