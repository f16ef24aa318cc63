#include "scenes/motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>

namespace hedgehop::scenes {
namespace {

using Eigen::Vector3d;
using Repeat = WaypointMotion::Repeat;

constexpr double kRoundingM = 1e-9;

// An L-shaped path: 3 m north, then 4 m east, at an altitude of 2 m.
WaypointMotion bent(Repeat repeat) {
  return {.points = {{0, 0, 2}, {3, 0, 2}, {3, 4, 2}}, .speed_mps = 0.5, .repeat = repeat, .start_s = 10.0};
}

void expect_at(const Motion& motion, double t_s, const Vector3d& p_W) {
  EXPECT_LT((p_WM(motion, t_s) - p_W).norm(), kRoundingM) << "at " << t_s << " s: " << p_WM(motion, t_s).transpose();
}

TEST(WaypointMotion, WaitsMovesAndStopsAtTheEnd) {
  const Motion motion = bent(Repeat::once);
  expect_at(motion, 0.0, {0, 0, -2});
  expect_at(motion, 10.0, {0, 0, -2});
  expect_at(motion, 12.0, {1, 0, -2});
  expect_at(motion, 18.0, {3, 1, -2});
  expect_at(motion, 24.0, {3, 4, -2});
  expect_at(motion, 1000.0, {3, 4, -2});
  EXPECT_EQ(v_WM(motion, 5.0), Vector3d::Zero());
  EXPECT_EQ(v_WM(motion, 24.0), Vector3d::Zero());
}

TEST(WaypointMotion, BackAndForthRetracesItsSteps) {
  const Motion motion = bent(Repeat::back_and_forth);
  for (double t_s = 10.0; t_s < 24.0; t_s += 0.7) {
    expect_at(motion, 48.0 - t_s, p_WM(motion, t_s));
    expect_at(motion, t_s + 28.0, p_WM(motion, t_s));
  }
}

TEST(WaypointMotion, RoundClosesTheTriangle) {
  const Motion motion = bent(Repeat::round);
  expect_at(motion, 10.0 + 2.0 * (3 + 4 + 2.5), {1.5, 2, -2});
  expect_at(motion, 10.0 + 2.0 * 12 + 2.0, {1, 0, -2});
}

TEST(WaypointMotion, IsAtRestForOnePointOrEqualPoints) {
  for (const Motion& motion : {Motion(WaypointMotion{.points = {{1, 2, 3}}, .repeat = Repeat::round}),
                               Motion(WaypointMotion{.points = {{1, 2, 3}, {1, 2, 3}}})}) {
    expect_at(motion, 7.0, {1, 2, -3});
    EXPECT_EQ(v_WM(motion, 7.0), Vector3d::Zero());
  }
}

TEST(OrbitMotion, QuarterTurnLeadsFromNorthToEast) {
  const double quarter_s = 0.5 * std::numbers::pi * 8.0 / 2.0;
  const Motion motion = OrbitMotion{.north_m = 100, .altitude_m = 5, .radius_m = 8, .speed_mps = 2, .start_s = 3};
  expect_at(motion, 1.0, {108, 0, -5});
  expect_at(motion, 3.0 + quarter_s, {100, 8, -5});
  const Motion other_way = OrbitMotion{.north_m = 100, .altitude_m = 5, .radius_m = 8, .speed_mps = -2, .start_s = 3};
  expect_at(other_way, 3.0 + quarter_s, {100, -8, -5});
}

Motion random_motion(std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-20.0, 20.0), speed(0.1, 3.0);
  if (random() % 3 == 0) {
    return OrbitMotion{.north_m = place(random),
                       .east_m = place(random),
                       .radius_m = speed(random) + 1.0,
                       .speed_mps = speed(random) - 1.5,
                       .bearing_rad = place(random),
                       .start_s = speed(random)};
  }
  WaypointMotion motion{
      .points = {}, .speed_mps = speed(random), .repeat = static_cast<Repeat>(random() % 3), .start_s = speed(random)};
  for (uint64_t k = random() % 5 + 1; k > 0; --k)
    motion.points.push_back({place(random), place(random), place(random)});
  return motion;
}

TEST(Motion, VelocityIsTheDerivativeOfThePosition) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> time(0.0, 100.0);
  constexpr double kStepS = 1e-5;
  int compared = 0;
  for (int k = 0; k < 3000; ++k) {
    const Motion motion = random_motion(random);
    const double t_s = time(random);
    const Vector3d before = (p_WM(motion, t_s) - p_WM(motion, t_s - kStepS)) / kStepS;
    const Vector3d after = (p_WM(motion, t_s + kStepS) - p_WM(motion, t_s)) / kStepS;
    if ((after - before).norm() > 1e-3) continue;  // a corner between the three
    ++compared;
    ASSERT_LT((v_WM(motion, t_s) - after).norm(), 1e-3);
  }
  EXPECT_GT(compared, 2950);
}

TEST(Motion, NeverLeavesItsPath) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> time(0.0, 100.0);
  for (int k = 0; k < 500; ++k) {
    const Motion motion = random_motion(random);
    const std::vector<Vector3d> way = path_W(motion);
    const Vector3d p_W = p_WM(motion, time(random));
    double nearest_m = (p_W - way.front()).norm();
    for (size_t i = 1; i < way.size(); ++i) {
      const Vector3d leg = way[i] - way[i - 1];
      const double share =
          leg.norm() > 0.0 ? std::clamp((p_W - way[i - 1]).dot(leg) / leg.squaredNorm(), 0.0, 1.0) : 0.0;
      nearest_m = std::min(nearest_m, (p_W - way[i - 1] - share * leg).norm());
    }
    // The 64 chords of an orbit are up to r (1 - cos(pi / 64)) inside the circle.
    const auto* orbit = std::get_if<OrbitMotion>(&motion);
    ASSERT_LE(nearest_m, orbit ? orbit->radius_m * (1.0 - std::cos(std::numbers::pi / 64)) + kRoundingM : kRoundingM);
  }
}

TEST(Motion, RejectsInvalidConfigs) {
  using E = std::invalid_argument;
  using testing::HasSubstr;
  using testing::ThrowsMessage;
  EXPECT_THAT([] { require_motion(WaypointMotion{.points = {}}); }, ThrowsMessage<E>(HasSubstr("motion.points")));
  EXPECT_THAT([] { require_motion(WaypointMotion{.speed_mps = -1}); },
              ThrowsMessage<E>(HasSubstr("motion.speed: must be >= 0 m/s, got -1")));
  EXPECT_THAT([] { require_motion(OrbitMotion{.radius_m = 0}); },
              ThrowsMessage<E>(HasSubstr("motion.radius: must be > 0 m, got 0")));
}

// A table whose frame moves north at 2 m/s and turns about the vertical at 0.5 rad/s, counter-clockwise from above.
TableMotion turning(TableMotion::Repeat repeat) {
  std::string text = "# header\n";
  for (int i = 0; i <= 50; ++i) {
    const double t_s = 0.02 * i, half_rad = 0.25 * t_s;
    text += std::to_string(t_s) + ", " + std::to_string(2.0 * t_s) + ",-3,4," + std::to_string(std::cos(half_rad)) +
            ",0,0," + std::to_string(std::sin(half_rad)) + "\n";
  }
  return {.repeat = repeat, .start_s = 5.0, .poses = std::make_shared<const PoseTable>(parse_pose_table(text))};
}

TEST(TableMotion, FollowsItsRowsAndTheLinesBetween) {
  constexpr double kTextM = 2e-6;  // six digits in the text
  const Motion motion = turning(TableMotion::Repeat::once);
  for (const double after_s : {0.0, 0.02, 0.031, 0.5, 0.999}) {
    const Eigen::Isometry3d X = X_WM(motion, 5.0 + after_s);
    EXPECT_LT((X.translation() - Vector3d(2.0 * after_s, 3, -4)).norm(), kTextM);
    EXPECT_LT((p_WM(motion, 5.0 + after_s) - X.translation()).norm(), kRoundingM);
    // Seen from above, the axis that points north turns to the west.
    const Vector3d north_M(std::cos(0.5 * after_s), -std::sin(0.5 * after_s), 0.0);
    EXPECT_LT((X.linear().col(0) - north_M).norm(), kTextM) << after_s;
    EXPECT_LT((X.linear().col(2) - Vector3d::UnitZ()).norm(), kTextM);
    EXPECT_LT((v_WM(motion, 5.0 + after_s) - Vector3d(2, 0, 0)).norm(), 1e-3);
    EXPECT_NEAR(max_speed_mps(motion, 4.0, 5.0 + after_s), 2.0 + 0.5 * 4.0, 1e-2);
  }
  expect_at(motion, 0.0, {0, 3, -4});
  expect_at(motion, 77.0, {2, 3, -4});
  EXPECT_EQ(max_speed_mps(motion, 4.0, 77.0), 0.0);
}

TEST(TableMotion, GoesBackOrRestarts) {
  const Motion back = turning(TableMotion::Repeat::back_and_forth), again = turning(TableMotion::Repeat::restart);
  for (const double after_s : {0.1, 0.33, 0.9}) {
    const Eigen::Isometry3d first = X_WM(back, 5.0 + after_s);
    EXPECT_LT((X_WM(back, 7.0 - after_s).matrix() - first.matrix()).norm(), kRoundingM);
    EXPECT_LT((X_WM(back, 7.0 + after_s).matrix() - first.matrix()).norm(), kRoundingM);
    EXPECT_LT((X_WM(again, 6.0 + after_s).matrix() - first.matrix()).norm(), kRoundingM);
    EXPECT_LT((v_WM(back, 7.0 - after_s) + Vector3d(2, 0, 0)).norm(), 1e-3);
  }
}

TEST(OtherMotions, DoNotRotate) {
  for (const Motion& motion : {Motion(bent(Repeat::round)), Motion(OrbitMotion{})}) {
    EXPECT_EQ(X_WM(motion, 13.7).linear(), Eigen::Matrix3d::Identity());
    EXPECT_EQ(X_WM(motion, 13.7).translation(), p_WM(motion, 13.7));
    EXPECT_EQ(max_speed_mps(motion, 9.0, 13.7), v_WM(motion, 13.7).norm());
  }
}

TEST(TableMotion, RefusesFaultyTables) {
  using testing::HasSubstr, testing::ThrowsMessage;
  using E = std::invalid_argument;
  const auto parse = [](const char* text) { return [text] { parse_pose_table(text); }; };
  EXPECT_THAT(parse("# empty\n"), ThrowsMessage<E>(HasSubstr("no rows")));
  EXPECT_THAT(parse("0,0,0,0,1,0,0\n"), ThrowsMessage<E>(HasSubstr("line 1: expected 8 values")));
  EXPECT_THAT(parse("0,0,0,0,1,0,0,0\n1,0,0,x,1,0,0,0\n"), ThrowsMessage<E>(HasSubstr("line 2: expected a number")));
  EXPECT_THAT(parse("0,0,0,0,1,0,0,nan\n"), ThrowsMessage<E>(HasSubstr("line 1: expected a number")));
  EXPECT_THAT(parse("0,0,0,0,1,1,0,0\n"), ThrowsMessage<E>(HasSubstr("quaternion")));
  EXPECT_THAT(parse("1,0,0,0,1,0,0,0\n# t, x\n0.5,0,0,0,1,0,0,0\n"),
              ThrowsMessage<E>(HasSubstr("line 3: the time 0.5 s is not after that of line 1")));
  Motion absent = TableMotion{.file = "absent.csv"};
  EXPECT_THAT([&] { load_motion(absent); },
              ThrowsMessage<E>(HasSubstr("motion.file: 'absent.csv': there is no such file")));
  EXPECT_THAT([&] { require_motion(absent); }, ThrowsMessage<E>(HasSubstr("not loaded")));
}

}  // namespace
}  // namespace hedgehop::scenes
