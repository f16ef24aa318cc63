#include <gtest/gtest.h>

#include <random>

#include "tests/avoidance/section_grid/section_world.h"

namespace hedgehop::avoidance::section_grid {
namespace {

constexpr double kVehicleRadiusM = 0.64;  // of the hexacopter
constexpr double kWallM = 15.0, kThicknessM = 0.4;

struct Opening {
  double middle_m, bottom_m, width_m, height_m;
};

/// A wall across the path, with one opening.
std::vector<Eigen::AlignedBox3d> wall_with(const Opening& o, double north_m, double height_m) {
  constexpr double kEndM = 40.0;
  const auto part = [&](double west_m, double east_m, double low_m, double high_m) {
    return Eigen::AlignedBox3d(Eigen::Vector3d(north_m, west_m, -high_m),
                               Eigen::Vector3d(north_m + kThicknessM, east_m, -low_m));
  };
  const double west_m = o.middle_m - 0.5 * o.width_m, east_m = o.middle_m + 0.5 * o.width_m;
  return {part(-kEndM, west_m, 0.0, height_m), part(east_m, kEndM, 0.0, height_m),
          part(west_m, east_m, 0.0, o.bottom_m), part(west_m, east_m, o.bottom_m + o.height_m, height_m)};
}

TEST(SectionFlight, FindsAnOpeningOnEitherSideOfTheStraightPath) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> off_m(5.0, 12.0), beside_m(-1.5, 1.5);
  for (int trial = 0; trial < 4; ++trial) {
    SectionWorld world;
    world.boxes_W = wall_with({trial % 2 == 0 ? off_m(random) : -off_m(random), 1.0, 12.0, 7.0}, kWallM, 12.0);
    world.start_W = {0.0, beside_m(random), -4.0};
    world.goal_W = {40.0, 0.0, -4.0};
    const SectionWorld::Flown flown = world.fly({});
    EXPECT_TRUE(flown.reached) << trial;
    EXPECT_GT(flown.clearance_m, kVehicleRadiusM) << trial;
  }
}

// [Perez2018] fig. 14.
TEST(SectionFlight, ChosenSectionMovesDownToTheCenterDuringTheClimb) {
  SectionWorld world;
  world.boxes_W = wall_with({0.0, 9.0, 1.0, 0.0}, 9.0, 9.0);
  world.goal_W = {40.0, 0.0, -12.0};
  SectionGridConfig config;
  config.answer = Answer::climb;
  const SectionWorld::Flown flown = world.fly(config);
  EXPECT_TRUE(flown.reached);
  int rows_above = 0, most = 0;
  for (const SectionWorld::Moment& moment : flown.moments) {
    if (moment.rows_above_center > most) most = rows_above = moment.rows_above_center;
    EXPECT_LE(moment.rows_above_center, rows_above);
    rows_above = moment.rows_above_center;
  }
  EXPECT_GE(most, 4);
  EXPECT_EQ(rows_above, 0);
}

// [Perez2018] fig. 16 and 17: an opening along the top across the boundaries of 3 x 3 sections.
TEST(SectionFlight, PassesAnOpeningAlongTheTopWithSeventeenRowsButNotWithThree) {
  SectionWorld world;
  world.boxes_W = wall_with({0.25, 5.5, 6.0, 2.4}, 6.0, 12.0);
  world.start_W = {0.0, 0.0, -5.0};
  world.goal_W = {30.0, 0.0, -5.0};
  world.duration_s = 60.0;
  const SectionWorld::Flown fine = world.fly({});
  EXPECT_TRUE(fine.reached);
  EXPECT_GE(fine.moments.front().rows_above_center, 5);
  SectionGridConfig coarse;
  coarse.sections = 3;
  coarse.overlapping = false;
  const SectionWorld::Flown missed = world.fly(coarse);
  EXPECT_EQ(missed.moments.front().section, -1);
  EXPECT_EQ(missed.moments.front().status, "hover_and_yaw");
}

TEST(SectionFlight, PassesRandomPillarsByMoreThanItsRadius) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> east_m(-12.0, 12.0), half_m(0.1, 0.8);
  for (int trial = 0; trial < 3; ++trial) {
    SectionWorld world;
    world.speed_mps = 2.235;
    for (double north_m = 12.0; north_m < 60.0; north_m += 6.0) {
      for (int k = 0; k < 2; ++k) {
        const double half = half_m(random), at_m = east_m(random);
        world.boxes_W.push_back(
            {Eigen::Vector3d(north_m - half, at_m - half, -15.0), Eigen::Vector3d(north_m + half, at_m + half, 0.0)});
      }
    }
    world.goal_W = {70.0, 0.0, -5.0};
    const SectionWorld::Flown flown = world.fly({});
    EXPECT_TRUE(flown.reached) << trial;
    EXPECT_GT(flown.clearance_m, kVehicleRadiusM) << trial;
  }
}

// It flies over two hedges and descends to a goal close behind them. They are below the image while it is above them.
TEST(SectionFlight, DoesNotDescendOntoObstaclesThatAreBelowItsImage) {
  constexpr double kClearM = 0.5;
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> height_m(3.5, 5.5), deep_m(0.5, 3.0), gap_m(1.0, 6.0), beyond_m(6.0, 12.0);
  for (int trial = 0; trial < 12; ++trial) {
    constexpr double kEndM = 40.0, kFirstM = 12.0, kStartM = 7.0, kGoalM = 3.0;
    SectionWorld world;
    double north_m = kFirstM;
    for (int hedge = 0; hedge < 2; ++hedge) {
      const double to_m = north_m + deep_m(random);
      world.boxes_W.push_back({Eigen::Vector3d(north_m, -kEndM, -height_m(random)), Eigen::Vector3d(to_m, kEndM, 0.0)});
      north_m = to_m + gap_m(random);
    }
    world.start_W = {0.0, 0.0, -kStartM};
    world.goal_W = {north_m + beyond_m(random), 0.0, -kGoalM};
    world.speed_mps = 2.235;
    SectionGridConfig config;
    config.threshold_time_s = 4.5;
    const SectionWorld::Flown flown = world.fly(config);
    EXPECT_TRUE(flown.reached) << trial;
    EXPECT_GT(flown.clearance_m, kVehicleRadiusM + kClearM) << trial;
  }
}

// [Perez2018] fig. 20, from any bearing in the image; half of the obstacles then turn at a right angle to either side.
TEST(SectionFlight, HoveringVehicleEvadesAnObstacleFromAnyBearingInView) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> bearing_rad(-0.65, 0.65), beside_m(-1.0, 1.0), turns_s(7.0, 10.0);
  constexpr double kStartM = 9.0, kSpeedMps = 0.7, kHalfM = 0.5;
  for (int trial = 0; trial < 16; ++trial) {
    const Eigen::AngleAxisd turn(bearing_rad(random), Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d from_W = turn * Eigen::Vector3d(kStartM, beside_m(random), 0.0);
    const Eigen::Vector3d v_W = kSpeedMps * (turn * -Eigen::Vector3d::UnitX());
    const Eigen::Vector3d later_W = kSpeedMps * (turn * Eigen::Vector3d(0.0, trial % 4 < 2 ? 1.0 : -1.0, 0.0));
    const double turns_at_s = trial % 2 == 0 ? 1e9 : turns_s(random);
    SectionWorld world;
    world.hovers = true;
    world.duration_s = 25.0;
    world.goal_W = world.start_W;
    world.movers_W = [&](double t_s) {
      const Eigen::Vector3d middle_W =
          world.start_W + from_W + std::min(t_s, turns_at_s) * v_W + std::max(0.0, t_s - turns_at_s) * later_W;
      const Eigen::Vector3d half_W = Eigen::Vector3d::Constant(kHalfM);
      return SectionWorld::Boxes{{middle_W - half_W, middle_W + half_W}};
    };
    SectionGridConfig config;
    config.threshold_m = 3.048;
    config.answer = Answer::sideways;
    EXPECT_GT(world.fly(config).clearance_m - kVehicleRadiusM, 2.0) << trial;
  }
}

}  // namespace
}  // namespace hedgehop::avoidance::section_grid
