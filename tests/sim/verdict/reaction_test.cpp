#include "sim/verdict/field_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hedgehop::sim {
namespace {

constexpr double kTouchM = 1e-3;  // contact distance
constexpr double kRadiusM = 0.5, kHorizonS = 20.0;

const std::vector<dynamics::HullPart> kDisc = {
    {.shape = dynamics::HullPart::Shape::cylinder, .half_extents_m = {kRadiusM, kRadiusM, 0.05}}};

scenes::Solid pole(double north_m, double east_m) {
  scenes::Solid solid;
  solid.name = "pole";
  solid.shape = scenes::Solid::Shape::cylinder;
  solid.half_extents_m = {0.1, 0.1, 10.0};
  solid.X_WS.translation() = Eigen::Vector3d(north_m, east_m, -10.0);
  return solid;
}

Eigen::Isometry3d at(const Eigen::Vector3d& p_W) { return Eigen::Isometry3d(Eigen::Translation3d(p_W)); }

// Circles of disc and pole, one of which moves: a quadratic equation.
TEST(TimeToCollision, OfADiscAndAPoleIsTheContactOfTheirCircles) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place_m(-8.0, 8.0), speed_mps(0.5, 3.0), aside_rad(-0.3, 0.3);
  int hits = 0;
  for (int trial = 0; trial < 300; ++trial) {
    scenes::Scene scene;
    const Eigen::Vector2d pole_NE(place_m(random), place_m(random));
    const Eigen::Vector2d v = Eigen::Rotation2Dd(aside_rad(random)) * pole_NE.normalized() * speed_mps(random);
    const double together_m = kRadiusM + 0.1;
    if (pole_NE.norm() < together_m + 0.1) continue;
    scene.solids = {pole(pole_NE.x(), pole_NE.y())};
    const double half_b = -v.dot(pole_NE), c = pole_NE.squaredNorm() - together_m * together_m;
    const double root2 = half_b * half_b - v.squaredNorm() * c;
    const auto found = time_to_collision_s(scene, kDisc, at({0.0, 0.0, -5.0}), {v.x(), v.y(), 0.0}, 0.0, kHorizonS);
    const double expected_s = (-half_b - std::sqrt(root2)) / v.squaredNorm();
    if (root2 < 0.01 || half_b > 0.0 || expected_s > kHorizonS - 0.1) {
      if (root2 < -0.01) {
        EXPECT_FALSE(found);
      }
      continue;
    }
    ++hits;
    ASSERT_TRUE(found);
    // A grazing contact starts earlier by a length that grows with the square root of the contact distance.
    EXPECT_NEAR(*found, expected_s, 2.0 * kTouchM * together_m / std::sqrt(root2) + 1e-3);
  }
  EXPECT_GT(hits, 50);
}

TEST(TimeToCollision, OfAHoveringVehicleFollowsFromTheMoversMotion) {
  scenes::Scene scene;
  scenes::Mover mover;
  mover.solids = {pole(0.0, 0.0)};
  mover.motion =
      scenes::WaypointMotion{.points = {{10.0, 0.0, 0.0}, {-10.0, 0.0, 0.0}}, .speed_mps = 2.0, .start_s = 4.0};
  scene.movers = {mover};
  const auto found = time_to_collision_s(scene, kDisc, at({0.0, 0.0, -5.0}), {0.0, 0.0, 0.0}, 1.0, kHorizonS);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, (4.0 - 1.0) + (10.0 - kRadiusM - 0.1) / 2.0, 0.01);
}

/// Flight north at 2 m/s towards a pole at 30 m, with contact after 14.7 s.
struct PoleFlight {
  static constexpr double kTouchS = (30.0 - kRadiusM - 0.1) / 2.0;
  scenes::Scene scene;
  Flight flight;

  explicit PoleFlight(double end_s, Outcome outcome = Outcome::timeout) {
    scene.solids = {pole(30.0, 0.0)};
    for (int i = 0; i <= static_cast<int>(100.0 * end_s + 0.5); ++i) {
      TrajectoryRow row;
      row.t_s = 0.01 * i;
      row.p_WB_true = {2.0 * row.t_s, 0.0, -5.0};
      row.v_WB_W_true = {2.0, 0.0, 0.0};
      row.rpy_true.setZero();
      flight.trajectory.push_back(row);
    }
    flight.result.outcome = outcome;
    flight.result.flight_time_s = end_s;
  }
  void decide(double t_s, const char* status) {
    DecisionRow row;
    row.t_s = t_s;
    row.status = status;
    flight.decisions.push_back(row);
  }
  std::optional<double> left_s() const { return time_to_collision_at_reaction_s(flight, scene, kDisc); }
};

TEST(TimeToCollision, AtReactionIsTheMinimumOverAllReactions) {
  PoleFlight f(13.0);
  f.decide(0.0, "avoid");
  f.decide(9.0, "cruise");
  EXPECT_FALSE(f.left_s());
  f.decide(10.0, "avoid");
  EXPECT_NEAR(*f.left_s(), PoleFlight::kTouchS - 10.0, 0.001);
  f.decide(10.5, "avoid");  // the status is unchanged
  EXPECT_NEAR(*f.left_s(), PoleFlight::kTouchS - 10.0, 0.001);
  f.decide(11.0, "hover");
  EXPECT_NEAR(*f.left_s(), PoleFlight::kTouchS - 11.0, 0.001);
  f.decide(12.0, "cruise");
  EXPECT_NEAR(*f.left_s(), PoleFlight::kTouchS - 11.0, 0.001);
}

TEST(TimeToCollision, AtReactionCountsFromTheEffectOfTheCommand) {
  PoleFlight f(13.0);
  f.flight.command_latency_s = 0.4;
  f.decide(9.0, "cruise");
  f.decide(10.0, "avoid");
  EXPECT_NEAR(*f.left_s(), PoleFlight::kTouchS - 10.4, 0.001);
  f.decide(12.8, "hover");  // takes effect at 13.2 s, after the end of the flight
  EXPECT_NEAR(*f.left_s(), PoleFlight::kTouchS - 10.4, 0.001);
}

TEST(TimeToCollision, IsZeroForACollisionWithoutReaction) {
  PoleFlight f(14.7, Outcome::collided);
  EXPECT_EQ(f.left_s(), std::optional(0.0));
  f.decide(9.0, "cruise");
  EXPECT_EQ(f.left_s(), std::optional(0.0));
  f.flight.command_latency_s = 0.2;
  f.decide(14.6, "avoid");  // too late to take effect
  EXPECT_EQ(f.left_s(), std::optional(0.0));
  f.flight.command_latency_s = 0.1;
  f.decide(14.6, "avoid");
  f.flight.decisions.erase(f.flight.decisions.begin() + 1);
  EXPECT_NEAR(*f.left_s(), 0.0, 0.01);
}

TEST(TimeToCollision, ReactionLongBeforeTheContactDoesNotCount) {
  PoleFlight f(14.7, Outcome::collided);
  f.scene.solids.push_back(pole(8.0, 0.0));  // the flight passes through it
  f.decide(0.0, "cruise");
  f.decide(1.0, "avoid");
  EXPECT_EQ(f.left_s(), std::optional(0.0));
  f.decide(9.7, "hover");
  EXPECT_NEAR(*f.left_s(), (8.0 - 0.6) / 2.0 - 1.0, 0.001);
}

TEST(TimeToCollision, ReactionWithoutAPredictedCollisionDoesNotCount) {
  PoleFlight f(14.7, Outcome::collided);
  f.scene.solids = {pole(30.0, 20.0)};  // the collision was with something else, such as the ground
  f.decide(9.0, "cruise");
  f.decide(10.0, "avoid");
  EXPECT_EQ(f.left_s(), std::optional(0.0));
  f.flight.result.outcome = Outcome::reached;
  EXPECT_FALSE(f.left_s());
}

}  // namespace
}  // namespace hedgehop::sim
