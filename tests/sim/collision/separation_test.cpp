#include "sim/collision/convex_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hedgehop::sim {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using Shape = ConvexBody::Shape;

constexpr double kSeparationM = 2e-7;   // separate() has 1e-7; the closed forms add rounding
constexpr double kBulletDepthM = 1e-4;  // accuracy of depths of overlap

const Eigen::Quaterniond kLevel = Eigen::Quaterniond::Identity();

Isometry3d at(const Vector3d& p, const Eigen::Quaterniond& q = kLevel) { return Eigen::Translation3d(p) * q; }

Eigen::Quaterniond random_turn(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
}

Vector3d random_point(std::mt19937_64& random, double below) {
  std::uniform_real_distribution<double> uniform(-below, below);
  return {uniform(random), uniform(random), uniform(random)};
}

// Alternating projections converge to a common point of two convex bodies if there is one, slowly for a small overlap.
bool share_a_point(const PlacedBody& first, const PlacedBody& second) {
  Vector3d p = first.X_WS.translation();
  for (int i = 0; i < 1000; ++i) p = first.nearest(second.nearest(p));
  return (second.nearest(p) - p).norm() < 0.01;
}

TEST(Separation, OfBoxesAcrossAFaceAnEdgeAndACorner) {
  const ConvexBody small(Shape::box, {1.0, 2.0, 3.0}), large(Shape::box, {4.0, 5.0, 6.0});
  const PlacedBody origin(large, Isometry3d::Identity());
  const auto distance = [&](const Vector3d& p) { return separate(PlacedBody(small, at(p)), origin).distance_m; };
  EXPECT_NEAR(distance({8.0, 1.0, -2.0}), 3.0, kSeparationM);
  EXPECT_NEAR(distance({0.5, -8.5, 2.0}), 1.5, kSeparationM);
  EXPECT_NEAR(distance({8.0, 11.0, 1.0}), 5.0, kSeparationM);    // 3 and 4
  EXPECT_NEAR(distance({-7.0, 10.0, 15.0}), 7.0, kSeparationM);  // 2, 3 and 6
}

TEST(Separation, OfCrossedEdgesIsTheLengthOfTheirCommonNormal) {
  // Two square bars, each on its edge, along x above y: their edges cross at a distance of `gap`.
  const ConvexBody bar(Shape::box, {10.0, 1.0, 1.0});
  const double half_diagonal_m = std::numbers::sqrt2, gap_m = 0.75;
  const Eigen::Quaterniond on_edge(AngleAxisd(std::numbers::pi / 4, Vector3d::UnitX()));
  const Eigen::Quaterniond across(AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()));
  const PlacedBody lower(bar, at(Vector3d::Zero(), on_edge));
  const PlacedBody upper(bar, at({0.3, -0.4, -2.0 * half_diagonal_m - gap_m}, across * on_edge));
  EXPECT_NEAR(separate(upper, lower).distance_m, gap_m, kSeparationM);
}

// A disc of radius R and half thickness h, tilted by theta from the wall's normal, extends R sin(theta) + h cos(theta).
TEST(Separation, OfATiltedDiscFromAWallFollowsSineAndCosine) {
  const double radius_m = 0.9, half_thickness_m = 0.05, wall_m = 5.0;
  const ConvexBody disc(Shape::cylinder, {radius_m, radius_m, half_thickness_m});
  const ConvexBody slab(Shape::box, {1.0, 40.0, 40.0});
  const PlacedBody wall(slab, at({wall_m + 1.0, 0.0, 0.0}));
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  for (int i = 0; i < 2000; ++i) {
    const double yaw = angle(random), tilt = angle(random);
    const Vector3d axis_W(std::cos(tilt), std::sin(tilt) * std::cos(yaw), std::sin(tilt) * std::sin(yaw));
    const PlacedBody placed(disc, at({0, 1, 2}, Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis_W)));
    const double reach_m = radius_m * std::abs(std::sin(tilt)) + half_thickness_m * std::abs(std::cos(tilt));
    EXPECT_NEAR(separate(placed, wall).distance_m, wall_m - reach_m, kSeparationM) << "tilt " << tilt;
  }
}

// Independent oracle: the minimum over many points of one body, each with its closed-form distance to the other.
TEST(Separation, BelowAWideCeilingIsThatOfTheHighestPointForAnyTilt) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> exponent(-9.0, -0.5), turn(-4.0, 4.0), gap(0.01, 4.0);
  const ConvexBody slab(Shape::box, {8.2, 4.2, 0.1});
  for (const ConvexBody& body : {ConvexBody(Shape::cylinder, {0.775, 0.775, 0.02}),
                                 ConvexBody(Shape::box, {0.13, 0.02, 0.13}), ConvexBody(Shape::box, {0.3, 0.1, 0.2})}) {
    for (int trial = 0; trial < 100000; ++trial) {
      const double roll = std::pow(10.0, exponent(random)), pitch = std::pow(10.0, exponent(random));
      const Eigen::Quaterniond q(AngleAxisd(turn(random), Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
                                 AngleAxisd(roll, Vector3d::UnitX()));
      const PlacedBody below(body, at({0.4, -0.2, 0.0}, q));
      const double gap_m = gap(random);
      const PlacedBody ceiling(slab, at({0.0, 0.0, -below.extent(-Vector3d::UnitZ()) - gap_m - 0.1}));
      ASSERT_NEAR(separate(below, ceiling).distance_m, gap_m, kSeparationM) << "roll " << roll << " pitch " << pitch;
    }
  }
}

TEST(Separation, IsBelowEverySampledDistanceAndNearTheMinimum) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> turn(0.0, 2.0 * std::numbers::pi), share(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const double radius_m = 0.3 + share(random), half_height_m = 0.02 + 0.3 * share(random);
    const ConvexBody cylinder(Shape::cylinder, {radius_m, radius_m, half_height_m});
    const ConvexBody box(Shape::box, Vector3d(1.0, 1.0, 1.0) + random_point(random, 0.9));
    const PlacedBody first(cylinder, at(random_point(random, 4.0) + Vector3d(6, 0, 0), random_turn(random)));
    const PlacedBody second(box, at(random_point(random, 1.0), random_turn(random)));
    double best_m = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4000; ++k) {  // the nearest point is on one of the two rims or on a flat end
      const double angle = turn(random), r = radius_m * (k % 2 ? 1.0 : std::sqrt(share(random)));
      const Vector3d p_S(r * std::cos(angle), r * std::sin(angle), k % 4 < 2 ? half_height_m : -half_height_m);
      const Vector3d p_2 = second.X_SW * (first.X_WS * p_S);
      best_m = std::min(best_m, (p_2.cwiseAbs() - box.half_extents_m).cwiseMax(0.0).norm());
    }
    const double distance_m = separate(first, second).distance_m;
    EXPECT_LE(distance_m, best_m + kSeparationM);
    EXPECT_GT(distance_m, best_m - 0.06);  // sampling leaves gaps of about a 20th of the radius
  }
}

// Certificate of the distance: a slab of that thickness between the bodies is a lower bound.
TEST(Separation, IsCertifiedByASlabBetweenTheBodies) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int apart = 0;
  for (int i = 0; i < 100000; ++i) {
    const double radius_m = 0.1 + 2.0 * share(random);
    const ConvexBody part = i % 2 ? ConvexBody(Shape::box, Vector3d(1.1, 1.1, 1.1) + random_point(random, 1.0))
                                  : ConvexBody(Shape::cylinder, {radius_m, radius_m, 0.02 + share(random)});
    const ConvexBody building(Shape::box, Vector3d(8, 8, 30) + random_point(random, 7.0));
    const PlacedBody first(part, at(random_point(random, 40.0), i % 5 ? random_turn(random) : kLevel));
    const PlacedBody second(building, at(Vector3d::Zero(), i % 3 ? kLevel : random_turn(random)));
    const Separation found = separate(first, second);
    if (found.distance_m <= 0.0) {
      ASSERT_TRUE(share_a_point(first, second)) << "pair " << i;
      continue;
    }
    ++apart;
    const Vector3d &a = found.on_first_W, &b = found.on_second_W, n = (b - a).normalized();
    ASSERT_NEAR((first.nearest(a) - a).norm(), 0.0, 1e-9) << "pair " << i;
    ASSERT_NEAR((second.nearest(b) - b).norm(), 0.0, 1e-9) << "pair " << i;
    ASSERT_NEAR((b - a).norm(), found.distance_m, 1e-9) << "pair " << i;
    ASSERT_NEAR(-second.extent(-n) - first.extent(n), found.distance_m, kSeparationM) << "pair " << i;
  }
  EXPECT_GT(apart, 50000);
}

TEST(Separation, DepthOfAnOverlapAcrossTheNearestFace) {
  const ConvexBody small(Shape::box, {1.0, 1.0, 1.0}), large(Shape::box, {10.0, 10.0, 10.0});
  const ConvexBody disc(Shape::cylinder, {2.0, 2.0, 0.5});
  const PlacedBody origin(large, Isometry3d::Identity());
  EXPECT_NEAR(separate(PlacedBody(small, at({10.6, 0.3, -0.2})), origin).distance_m, -0.4, kBulletDepthM);
  EXPECT_NEAR(separate(PlacedBody(small, at({8.0, 0.3, -0.2})), origin).distance_m, -3.0, kBulletDepthM);
  EXPECT_NEAR(separate(PlacedBody(disc, at({11.7, 0.3, -0.2})), origin).distance_m, -0.3, kBulletDepthM);
  EXPECT_NEAR(separate(PlacedBody(disc, at({0.1, 0.3, -10.4})), origin).distance_m, -0.1, kBulletDepthM);
}

TEST(Separation, ChangesSignWhenADiscTouchesAWall) {
  const ConvexBody disc(Shape::cylinder, {0.9, 0.9, 0.05}), slab(Shape::box, {1.0, 40.0, 40.0});
  const PlacedBody wall(slab, at({1.0, 0.0, 0.0}));
  for (const double gap_m : {1e-3, 1e-4, 1e-5, 1e-6}) {
    EXPECT_NEAR(separate(PlacedBody(disc, at({-0.9 - gap_m, 3.0, 5.0})), wall).distance_m, gap_m, kSeparationM);
    EXPECT_LE(separate(PlacedBody(disc, at({-0.9 + gap_m, 3.0, 5.0})), wall).distance_m, 0.0);
  }
}

}  // namespace
}  // namespace hedgehop::sim
