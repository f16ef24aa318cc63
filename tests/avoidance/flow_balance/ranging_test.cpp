#include "avoidance/flow_balance/ranging.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Measurement = RangeMemory::Measurement;

double update(RangeMemory& memory, const Measurement& measurement, double dt_s) {
  return memory.update(std::vector<Measurement>{measurement}, dt_s).front();
}

TEST(RangeMemory, ReturnsAWellMeasuredRangeUnchanged) {
  RangeMemory memory(1.0);
  EXPECT_EQ(update(memory, {0.5, 1.0, 2.0}, 0.02), 0.5);
  EXPECT_EQ(update(memory, {0.1, 1.0, 2.0}, 0.02), 0.1);
}

TEST(RangeMemory, PredictsTheRangeOfAWallFromTheClosingSpeed) {
  // From 4 m at 1.5 m/s for 1.2 s without measurement: 2.2 m remain.
  RangeMemory memory(1e6);
  constexpr double kStepS = 1e-4;
  double inverse_per_m = update(memory, {0.25, 1.0, 1.5}, kStepS);
  for (int i = 0; i < 12000; ++i) inverse_per_m = update(memory, {0.0, 0.0, 1.5}, kStepS);
  EXPECT_NEAR(1.0 / inverse_per_m, 2.2, 2e-3);
}

TEST(RangeMemory, DecaysWithItsTimeConstant) {
  RangeMemory memory(0.8);
  update(memory, {0.5, 1.0, 0.0}, 0.1);
  double inverse_per_m = 0.0;
  for (int i = 0; i < 8; ++i) inverse_per_m = update(memory, {kNan, 0.0, 0.0}, 0.1);
  EXPECT_NEAR(inverse_per_m, 0.5 * std::exp(-1.0), 1e-12);
}

TEST(RangeMemory, CompletesAMeasurementOfPartialWeight) {
  // A true inverse range of 0.4 with weight 0.3 is measured as 0.12; the stored range completes it.
  RangeMemory memory(1e9);
  update(memory, {0.4, 1.0, 0.0}, 0.02);
  EXPECT_NEAR(update(memory, {0.3 * 0.4, 0.3, 0.0}, 0.02), 0.4, 1e-9);
}

TEST(RangeMemory, ZeroTimeConstantDisablesTheMemory) {
  RangeMemory memory(0.0);
  update(memory, {0.5, 1.0, 0.0}, 0.02);
  EXPECT_EQ(update(memory, {0.01, 0.1, 0.0}, 0.02), 0.01);
  EXPECT_TRUE(std::isnan(update(memory, {kNan, 0.0, 0.0}, 0.02)));
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

TEST(LastingRanges, OneWrongImageCreatesNoNearObstacle) {
  LastingRanges ranges(3);
  for (const double near : {0.1, 0.9, 0.1}) ranges.add({near});
  EXPECT_EQ(ranges.lasting_per_m(), std::vector<double>{0.1});
}

TEST(LastingRanges, WallRemainsWithOneMissingVector) {
  LastingRanges ranges(3);
  for (const double near : {0.5, kUnknown, 0.4}) ranges.add({near});
  EXPECT_EQ(ranges.lasting_per_m(), std::vector<double>{0.4});
}

TEST(LastingRanges, MostlyUnknownPatchCountsAsFar) {
  LastingRanges ranges(3);
  EXPECT_TRUE(ranges.lasting_per_m().empty());
  ranges.add({0.5});
  EXPECT_EQ(ranges.lasting_per_m(), std::vector<double>{0.0});
  ranges.add({kUnknown});
  ranges.add({kUnknown});
  EXPECT_EQ(ranges.lasting_per_m(), std::vector<double>{0.0});
}

TEST(LastingRanges, OldImagesAreDeleted) {
  LastingRanges ranges(2);
  for (const double near : {0.1, 0.6, 0.7}) ranges.add({near});
  EXPECT_EQ(ranges.lasting_per_m(), std::vector<double>{0.6});
}

TEST(InverseRangeLeft, IsTheInverseOfTheRangeMinusTheDistance) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> range(0.5, 20.0), stopping(0.0, 3.0);
  for (int i = 0; i < 1000; ++i) {
    const double range_m = range(random), distance_m = stopping(random), left_m = range_m - distance_m;
    const double left_per_m = inverse_range_left_per_m(1.0 / range_m, distance_m);
    if (left_m > 1e-3) {
      EXPECT_NEAR(left_per_m * left_m, 1.0, 1e-9);
    } else {
      EXPECT_EQ(left_per_m, 1000.0);
    }
  }
}

TEST(InverseRangeLeft, OfInfiniteRangeIsZero) { EXPECT_EQ(inverse_range_left_per_m(0.0, 3.0), 0.0); }

// A point whose whole velocity is reversed by a constant acceleration, integrated in small steps.
TEST(StoppingDistance, EqualsThePathOfAPointThatReverses) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> speed(0.2, 3.0), angle(-1.5, 1.5), braking(0.3, 4.0), reaction(0.0, 1.0);
  for (int i = 0; i < 50; ++i) {
    const double speed_mps = speed(random), angle_rad = angle(random);
    const Stopping stopping{reaction(random), braking(random)};
    const Eigen::Vector2d v0 = speed_mps * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    constexpr double kStepS = 1e-4;
    Eigen::Vector2d v = v0;
    double covered_m = 0.0;
    for (double t_s = 0.0; v.x() > 0.0; t_s += kStepS) {
      if (t_s >= stopping.reaction_s) v -= kStepS * stopping.braking_mps2 * v0.normalized();
      covered_m += kStepS * v.x();
    }
    EXPECT_NEAR(stopping_distance_m(v0.x(), speed_mps, stopping), covered_m, 2e-3);
    EXPECT_EQ(stopping_distance_m(-v0.x(), speed_mps, stopping), 0.0);
  }
}

constexpr int kRangedImagePx = 200;
constexpr double kImageS = 0.04;
constexpr double kNorthM = 4.0, kEastM = 2.5, kSouthM = 5.0, kWestM = 3.0;  // of the walls from the origin

/// The room, and images of it.
const std::vector<vision::TexturedPlane> kRangedRoom = {wall(kNorthM, 0.0, M_PI), wall(0.0, kEastM, -0.5 * M_PI),
                                                        wall(-kSouthM, 0.0, 0.0), wall(0.0, -kWestM, 0.5 * M_PI)};
const vision::WaveTexture kRangedTexture(7, 0.05, 0.8, 24);
const vision::flow::ImageInterpolationConfig kRangedFlow{
    .rows = 1, .cols = 8, .patch_px = 32, .margin_px = 14, .levels = 2};

// Rendered images of a room with walls across the heading, for diagonal paths and for a path straight to a wall.
TEST(FitWalls, MeasuresARoomFromTwoImagesOfFourCameras) {
  for (const Eigen::Vector2d& v_mps :
       {Eigen::Vector2d(0.9, 0.9), Eigen::Vector2d(-0.4, 1.2), Eigen::Vector2d(0.0, 1.4)}) {
    const auto setup = four_cameras(kRangedImagePx, 1.0 / kImageS);
    CameraFlow::Options options;
    options.flow = kRangedFlow;
    options.derotate = true;
    options.missing = vision::flow::Missing::skip;
    std::vector<CameraFlow> cameras;
    for (const MountedCamera& camera : setup.cameras) cameras.emplace_back(camera, options);
    NavigationState navigation;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d at_m = k * kImageS * v_mps;
      navigation = level_flight({at_m.x(), at_m.y(), -1.0}, 0.0, v_mps);
      const auto frames = see(setup, navigation, k * 40'000'000, kRangedRoom, kRangedTexture);
      for (size_t i = 0; i < cameras.size(); ++i) cameras[i].update(frames[i], Eigen::Vector3d::Zero());
    }
    const auto walls = fit_walls(cameras, navigation, 40'000'000);
    const Eigen::Vector2d moved_m = kImageS * v_mps;
    for (const Eigen::Vector2d& to_wall_m :
         {Eigen::Vector2d(kNorthM - moved_m.x(), 0.0), Eigen::Vector2d(0.0, kEastM - moved_m.y()),
          Eigen::Vector2d(-kSouthM - moved_m.x(), 0.0), Eigen::Vector2d(0.0, -kWestM - moved_m.y())}) {
      const vision::flow::WallEstimate* nearest = nullptr;
      double least = INFINITY;
      for (const vision::flow::WallEstimate& found : walls) {
        const double error = (found.inverse_range_per_m * to_wall_m.norm() - to_wall_m.normalized()).norm();
        if (error >= least) continue;
        least = error;
        nearest = &found;
      }
      ASSERT_NE(nearest, nullptr);
      // Near walls are accurate; the error of all walls is within that of the fit.
      if (to_wall_m.norm() < 3.5) {
        EXPECT_LT(least, 0.1) << v_mps.transpose() << " to " << to_wall_m.transpose();
      }
      EXPECT_LT(std::abs(nearest->inverse_range_per_m.norm() * to_wall_m.norm() - 1.0), 3.0 * nearest->relative_error)
          << v_mps.transpose() << " to " << to_wall_m.transpose();
    }
  }
}

// A vehicle that flies east reverses to west: the west wall counts only when the vehicle approaches it.
TEST(WallRanging, CountsAWallOnlyWhenTheVehicleNoLongerLeavesIt) {
  const auto setup = four_cameras(kRangedImagePx, 1.0 / kImageS);
  SideCameras cameras(setup, kRangedFlow, /*derotate=*/true);
  WallRanging ranging(PatchRanging::Options{});
  const Eigen::Vector2d v_mps(0.9, 0.9), west_mps(0.9, -0.9);
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d at_m = k * kImageS * v_mps;
    const NavigationState navigation = level_flight({at_m.x(), at_m.y(), -1.0}, 0.0, v_mps);
    const auto frames = see(setup, navigation, k * 40'000'000, kRangedRoom, kRangedTexture);
    cameras.update({k * 40'000'000, frames, navigation, {}});
    ranging.update(cameras, navigation);
  }
  const auto range_to_west_m = [&](double v_east_mps) {
    const Approach approach{.v_H = {0.9, v_east_mps}, .v_cmd_H = west_mps, .stopping = {0.3, 1.5}};
    return 1.0 / ranging.left_once_stopped_per_m(approach)[0];
  };
  const double stop_m = 0.9 * 0.3 + 0.9 * 0.9 / (2.0 * 1.5), west_m = kWestM + kImageS * 0.9;
  EXPECT_EQ(range_to_west_m(0.9), INFINITY);
  EXPECT_EQ(range_to_west_m(0.3), INFINITY);
  EXPECT_NEAR(range_to_west_m(0.0), west_m - stop_m, 0.1 * west_m);
  EXPECT_NEAR(range_to_west_m(-0.9), west_m - stop_m, 0.1 * west_m);
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
