// Properties of a world that the seed may vary, and those that it must not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "scenes/generators.h"

namespace hedgehop::scenes::worlds {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr int64_t kVariedTexturePx = 64;
constexpr uint64_t kSeeds = 300;
constexpr double kRounding = 1e-9;

constexpr double kDeg = std::numbers::pi / 180.0;

// In the skyline's order, each tower has the 8 corners of its box and, except the first, the top of its spire.
std::vector<Eigen::AlignedBox3d> tower_boxes(const std::vector<Vector3d>& corners) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (size_t first = 0, tower = 0; tower < 4; first += tower == 0 ? 8 : 9, ++tower) {
    Eigen::AlignedBox3d& box = boxes.emplace_back();
    for (size_t k = first; k < first + 8; ++k) box.extend(corners.at(k));
  }
  return boxes;
}

TEST(VariedSkyline, KeepsGapsExtentAndThirtyFiveCorners) {
  Eigen::AlignedBox3d extent;
  for (const Vector3d& corner : highrise_corners({}, 0)) extent.extend(corner);
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::vector<Vector3d> corners = highrise_corners({.vary = 0.3}, seed);
    ASSERT_EQ(corners.size(), 35u);
    for (const Vector3d& corner : corners) {
      EXPECT_LE(extent.exteriorDistance(corner), kRounding) << "seed " << seed << ": " << corner.transpose();
    }
    const std::vector<Eigen::AlignedBox3d> boxes = tower_boxes(corners);
    for (size_t i = 0; i < boxes.size(); ++i) {
      for (size_t k = 0; k < i; ++k) EXPECT_GE(boxes[i].exteriorDistance(boxes[k]), 4.0 - kRounding) << "seed " << seed;
    }
  }
}

TEST(VariedSkyline, KeepsEverySideAndHeightWithinItsShare) {
  constexpr double kShare = 0.3;
  const std::vector<Eigen::AlignedBox3d> plain = tower_boxes(highrise_corners({}, 0));
  Vector3d least = Vector3d::Constant(1.0), most = least;  // sizes relative to the plain ones
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::vector<Eigen::AlignedBox3d> boxes = tower_boxes(highrise_corners({.vary = kShare}, seed));
    for (size_t k = 0; k < boxes.size(); ++k) {
      const Vector3d ratio = boxes[k].sizes().cwiseQuotient(plain[k].sizes());
      least = least.cwiseMin(ratio);
      most = most.cwiseMax(ratio);
    }
  }
  // Nearly the complete range is used. Towers above 40 m are lowered, but never below their share.
  EXPECT_GE(least.minCoeff(), 1.0 - kShare - kRounding);
  EXPECT_LE(most.maxCoeff(), 1.0 + kShare + kRounding);
  EXPECT_LT(least.maxCoeff(), 1.0 - 0.9 * kShare);
  EXPECT_GT(most.minCoeff(), 1.0 + 0.8 * kShare);
}

// The lateral flight of [Shah2009] table 4.1 as in configs/shah2009_highrise_lateral.yaml: each corner, ignoring
// occlusion, must be in the camera's view for some time.
TEST(VariedSkyline, IsInViewOfTheLateralFlight) {
  constexpr double kRadiusM = 42.672, kPitchRad = -36.0 * kDeg, kHalfFieldRad = 15.0 * kDeg;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::vector<Vector3d> corners = highrise_corners({.scale = 0.5, .vary = 0.3}, seed);
    std::vector<int> seconds(corners.size(), 0);
    for (int t_s = 0; t_s <= 100; ++t_s) {
      const double bearing = std::numbers::pi + 0.36 * kDeg * t_s;
      const Vector3d p_WC(kRadiusM * std::cos(bearing), kRadiusM * std::sin(bearing), -kRadiusM);
      const Vector3d level(-std::cos(bearing), -std::sin(bearing), 0.0), right(-level.y(), level.x(), 0.0);
      const Vector3d along = std::cos(kPitchRad) * level - std::sin(kPitchRad) * Vector3d::UnitZ();
      const Vector3d down = along.cross(right);
      for (size_t k = 0; k < corners.size(); ++k) {
        const Vector3d ray = corners[k] - p_WC;
        const double u = right.dot(ray) / along.dot(ray), v = down.dot(ray) / along.dot(ray);
        seconds[k] += std::max(std::abs(u), std::abs(v)) < std::tan(kHalfFieldRad);
      }
    }
    EXPECT_GE(std::ranges::min(seconds), 30) << "seed " << seed;
  }
}

TEST(VariedSkyline, DoesNotChangeTheCube) {
  const auto cube = [](double vary, uint64_t seed) {
    return highrise_corners({.layout = HighriseConfig::Layout::cube, .vary = vary}, seed);
  };
  EXPECT_EQ(cube(0.3, 1), cube(0.0, 2));
  EXPECT_EQ(highrise_corners({}, 1), highrise_corners({}, 2));
  EXPECT_NE(highrise_corners({.vary = 0.3}, 1), highrise_corners({.vary = 0.3}, 2));
}

// A corridor with all features.
CorridorConfig rich_corridor() {
  CorridorConfig corridor{.vary = 0.3, .texture_size_px = kVariedTexturePx};
  corridor.sections = {{.length_m = 8.0},
                       {.length_m = 6.0, .bend_rad = 30.0 * kDeg, .doorway_m = 1.1},
                       {.length_m = 4.0, .bend_rad = -20.0 * kDeg, .width_m = 1.75},
                       {.length_m = 7.0, .bend_rad = 40.0 * kDeg, .width_m = 2.5, .obstacle_m = -0.6},
                       {.length_m = 9.0, .bend_rad = -10.0 * kDeg}};
  return corridor;
}

TEST(VariedCorridor, KeepsItsInitialWidthAndTheStartOfItsLastSection) {
  CorridorConfig plain = rich_corridor();
  plain.vary = 0.0;
  const CorridorPlan as_written = plan_corridor(plain, 0);
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    const CorridorPlan plan = plan_corridor(rich_corridor(), seed);
    EXPECT_NEAR((plan.rights_NE.front() - plan.lefts_NE.front()).norm(), 2.5, kRounding);
    const Vector2d begin = plan.middles_NE.end()[-2], written_begin = as_written.middles_NE.end()[-2];
    EXPECT_LT((begin - written_begin).norm(), kRounding);
    const Vector2d last = plan.middles_NE.back() - begin, written = as_written.middles_NE.back() - written_begin;
    EXPECT_LT((last.normalized() - written.normalized()).norm(), kRounding);
    EXPECT_GE(last.norm(), written.norm() - kRounding);
    EXPECT_LE(last.norm(), 1.3 * written.norm() + kRounding);
    EXPECT_GT((plan.middles_NE[2] - as_written.middles_NE[2]).norm(), 1e-3) << "seed " << seed;
  }
}

TEST(VariedCorridor, KeepsDoorwaysPillarsAndWidthsWithinTheirShare) {
  const CorridorConfig written = rich_corridor();
  double narrowest_door_m = 9.0, widest_door_m = 0.0;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    const CorridorConfig drawn = draw_corridor(written, seed);
    EXPECT_EQ(drawn.vary, 0.0);
    EXPECT_NEAR(drawn.sections[2].width_m, 1.75, 0.3 * 0.75);
    EXPECT_EQ(drawn.sections[3].width_m, 2.5);
    EXPECT_NEAR(drawn.sections[3].obstacle_m, -0.6, 0.3 * 0.6);
    narrowest_door_m = std::min(narrowest_door_m, drawn.sections[1].doorway_m);
    widest_door_m = std::max(widest_door_m, drawn.sections[1].doorway_m);
  }
  EXPECT_NEAR(narrowest_door_m, 0.7 * 1.1, 0.02);
  EXPECT_NEAR(widest_door_m, 1.3 * 1.1, 0.02);
}

TEST(VariedCorridor, KeepsStraightSectionsStraight) {
  CorridorConfig config{.vary = 0.2};
  config.sections = {{9.0}, {.length_m = 2.0, .doorway_m = 1.1}, {5.0}, {4.0}};
  double nearest_m = 99.0, farthest_m = 0.0;  // the doorway's
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    const CorridorPlan plan = plan_corridor(config, seed);
    for (const Vector2d& left : plan.lefts_NE) ASSERT_EQ(left.y(), -1.25) << "seed " << seed;
    const double doorway_m = 0.5 * (plan.middles_NE[1].x() + plan.middles_NE[2].x());
    nearest_m = std::min(nearest_m, doorway_m);
    farthest_m = std::max(farthest_m, doorway_m);
  }
  EXPECT_GT(farthest_m - nearest_m, 1.5);
}

// There is a wall just outside every corner of the varied plan.
TEST(VariedCorridor, IsClosedAtItsBends) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    const Scene scene = make_corridor(rich_corridor(), seed);
    const CorridorPlan plan = plan_corridor(rich_corridor(), seed);
    for (const std::vector<Vector2d>& wall : {plan.lefts_NE, plan.rights_NE}) {
      for (size_t k = 0; k < wall.size(); ++k) {
        const Vector2d p = wall[k] + 0.01 * (wall[k] - plan.middles_NE[k]).normalized();
        EXPECT_TRUE(std::ranges::any_of(scene.solids,
                                        [&](const Solid& solid) {
                                          const Vector3d p_S = solid.X_WS.inverse() * Vector3d(p.x(), p.y(), -1.0);
                                          return (p_S.cwiseAbs().array() < solid.half_extents_m.array()).all();
                                        }))
            << "seed " << seed << ", corner " << k;
      }
    }
  }
}

TEST(VariedCorridor, RejectsConfigsThatASeedCouldMakeInvalid) {
  const auto make = [](CorridorSection section, double vary) {
    CorridorConfig config{.vary = vary};
    config.sections = {section, {5.0}};
    return [config] { plan_corridor(config, 1); };
  };
  EXPECT_NO_THROW(make({.doorway_m = 2.2}, 0.0)());
  EXPECT_THAT(make({.doorway_m = 2.2}, 0.2), ThrowsMessage<std::invalid_argument>(HasSubstr("sections.doorway: 2.2")));
  EXPECT_THAT(make({.doorway_m = 0.35}, 0.2),
              ThrowsMessage<std::invalid_argument>(HasSubstr("sections.doorway: 0.35")));
  EXPECT_THAT(make({.obstacle_m = -2.2}, 0.2),
              ThrowsMessage<std::invalid_argument>(HasSubstr("sections.obstacle: -2.2")));
  EXPECT_THAT(make({.width_m = 0.7}, 0.2), ThrowsMessage<std::invalid_argument>(HasSubstr("sections.width")));
  CorridorConfig back{.vary = 0.1};
  back.sections = {{5.0}, {5.0, 60 * kDeg}, {5.0, 60 * kDeg}, {5.0, 60 * kDeg}, {5.0, 60 * kDeg}, {5.0}};
  EXPECT_THAT([&] { plan_corridor(back, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("vary: 0.1; valid: 0 if")));
}

TEST(VariedWall, MovesAndResizesItsOpeningInsideIt) {
  const WallConfig config{.opening = WallOpening{.middle_m = 5.0, .bottom_m = 2.0, .width_m = 4.0, .height_m = 5.0},
                          .vary = 0.2,
                          .texture_size_px = kVariedTexturePx};
  std::array<std::vector<double>, 4> drawn;  // distance; opening's west and east edge, its top
  for (uint64_t seed = 0; seed < 60; ++seed) {
    const Scene scene = make_wall(config, seed);
    ASSERT_EQ(scene.solids.size(), 4u);
    const auto box = [&](size_t k) { return bounds_W(scene.solids[k]); };  // west, east, below, above
    drawn[0].push_back(box(0).min().x());
    drawn[1].push_back(box(0).max().y());
    drawn[2].push_back(box(1).min().y());
    drawn[3].push_back(-box(3).max().z());
    EXPECT_EQ(box(0).min().y(), -15.0);
    EXPECT_EQ(box(1).max().y(), 15.0);
  }
  const double written[] = {20.0, 3.0, 7.0, 7.0}, reach_m[] = {4.0, 1.4, 1.4, 1.4};
  for (size_t k = 0; k < drawn.size(); ++k) {
    const auto [least, most] = std::ranges::minmax(drawn[k]);
    EXPECT_GE(least, written[k] - reach_m[k]) << k;
    EXPECT_LE(most, written[k] + reach_m[k]) << k;
    EXPECT_GT(most - least, reach_m[k]) << k;
  }
  WallConfig too_high = config;
  too_high.opening->bottom_m = 3.5;
  EXPECT_THAT([&] { make_wall(too_high, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("opening.bottom: 3.5")));
}

}  // namespace
}  // namespace hedgehop::scenes::worlds
