#include "sim/verdict/map_alignment.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace hedgehop::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Vector3d random_vector(std::mt19937& numbers, double size) {
  std::uniform_real_distribution<double> any(-size, size);
  return {any(numbers), any(numbers), any(numbers)};
}

double sum_of_squares(const Isometry3d& X, const std::vector<Vector3d>& from, const std::vector<Vector3d>& to) {
  double sum = 0.0;
  for (size_t i = 0; i < from.size(); ++i) sum += (X * from[i] - to[i]).squaredNorm();
  return sum;
}

TEST(RigidFit, RecoversAKnownMotionOfFlatAndSolidPoints) {
  std::mt19937 numbers(1);
  for (int trial = 0; trial < 50; ++trial) {
    Isometry3d motion = Isometry3d::Identity();
    motion.linear() = Eigen::AngleAxisd(3.0 * trial / 50.0, random_vector(numbers, 1.0).normalized()).matrix();
    motion.translation() = random_vector(numbers, 10.0);
    std::vector<Vector3d> from, to;
    for (int i = 0; i < 3 + trial % 4; ++i) {  // three points are always flat
      from.push_back(random_vector(numbers, 30.0));
      to.push_back(motion * from.back());
    }
    const auto X = rigid_fit(from, to);
    ASSERT_TRUE(X) << trial;
    EXPECT_LT((X->matrix() - motion.matrix()).norm(), 1e-9) << trial;
  }
}

// The oracle is a search: of many other motions, each has a larger sum of squares.
TEST(RigidFit, NoOtherMotionIsCloserToNoisyPartners) {
  std::mt19937 numbers(2);
  std::vector<Vector3d> from, to;
  for (int i = 0; i < 7; ++i) {
    from.push_back(random_vector(numbers, 20.0));
    to.push_back(from.back() + random_vector(numbers, 2.0));
  }
  const auto X = rigid_fit(from, to);
  ASSERT_TRUE(X);
  EXPECT_NEAR(X->linear().determinant(), 1.0, 1e-12);
  const double least = sum_of_squares(*X, from, to);
  for (int trial = 0; trial < 20000; ++trial) {
    const double size = std::pow(10.0, -(trial % 6));
    Isometry3d other = *X;
    const Vector3d turn = random_vector(numbers, size);
    other.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * X->linear();
    other.translation() += random_vector(numbers, 10.0 * size);
    ASSERT_GE(sum_of_squares(other, from, to), least * (1.0 - 1e-12)) << trial;
  }
}

// A mirrored copy is fitted exactly by a reflection, which is no motion.
TEST(RigidFit, NeverReflects) {
  const std::vector<Vector3d> from = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {0, 0, 0}};
  std::vector<Vector3d> to;
  for (const Vector3d& p : from) to.emplace_back(p.x(), p.y(), -p.z());
  const auto X = rigid_fit(from, to);
  ASSERT_TRUE(X);
  EXPECT_NEAR(X->linear().determinant(), 1.0, 1e-12);
  EXPECT_GT(sum_of_squares(*X, from, to), 0.1);
}

TEST(RigidFit, IsUnknownForTwoPointsAndForPointsOnOneLine) {
  const std::vector<Vector3d> line = {{0, 0, 0}, {10, 20, 5}, {20, 40, 10}, {-4, -8, -2}};
  EXPECT_FALSE(rigid_fit(line, line));
  EXPECT_FALSE(rigid_fit(std::vector<Vector3d>{{0, 0, 0}, {0, 9, 0}}, std::vector<Vector3d>{{0, 0, 0}, {0, 9, 0}}));
}

// A point 2.8 m from the nearest corner is a pair at first, but not of the final fit.
TEST(AlignMap, IgnoresPointsThatAreNoCorners) {
  const std::vector<Vector3d> corners_W = {{20, 0, 0}, {0, 20, -10}, {-20, 0, 0}, {0, -20, -10}, {10, 10, -30}};
  std::vector<Vector3d> map_W;
  for (const Vector3d& p_W : corners_W) map_W.emplace_back(p_W + Vector3d(0.6, 0.0, 0.3));
  map_W[4].y() += 2.8;
  const auto X = align_map(corners_W, map_W, 1.0);
  ASSERT_TRUE(X);
  for (size_t i = 0; i < 4; ++i) EXPECT_LT((*X * map_W[i] - corners_W[i]).norm(), 1e-9) << i;
}

TEST(AlignMap, IsUnknownForAMapBeyondThreeTolerances) {
  const std::vector<Vector3d> corners_W = {{20, 0, 0}, {0, 20, -10}, {-20, 0, 0}};
  std::vector<Vector3d> map_W;
  for (const Vector3d& p_W : corners_W) map_W.emplace_back(p_W + Vector3d(0.0, 0.0, 3.1));
  EXPECT_FALSE(align_map(corners_W, map_W, 1.0));
}

}  // namespace
}  // namespace hedgehop::sim
