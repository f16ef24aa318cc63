#include <gtest/gtest.h>

#include <array>
#include <span>

#include "tests/vision/mapping/mapped_world.h"
#include "vision/mapping/occupancy_map.h"

namespace hedgehop::vision::mapping {
namespace {

using State = OccupancyMap::State;

constexpr OccupancyMapConfig kSmall{.voxel_m = 0.3, .across = 100, .layers = 10};

/// A camera that looks north, a map around it, and its image of free space.
struct NorthView {
  NorthView() {
    map.reset(p_WC);
    free.build(cv::Mat(world.height_px, world.width_px, CV_16SC1, cv::Scalar(0)), {}, 0);
  }
  void integrate(const DepthBlocks& blocks, OccupancyMap::Instant instant = OccupancyMap::Instant::next) {
    map.integrate(blocks, world.geometry, X_WC, {}, instant);
  }
  /// Row and column of the block straight ahead.
  int row() const { return static_cast<int>(world.geometry.center_v_px) / 8; }
  int col() const { return static_cast<int>(world.geometry.center_u_px) / 8; }

  MappedWorld world;
  OccupancyMap map{kSmall};
  Eigen::Vector3d p_WC{0.15, 0.15, -1.35};
  Eigen::Isometry3d X_WC = MappedWorld::looking(p_WC, 0.0);
  DepthBlocks free;
};

// Free voxels behind a line become unknown beyond 4 m after three images, never occupied; others do not change.
TEST(ThinObjects, InFrontOfSkyMakesItsRayUnknown) {
  NorthView view;
  DepthBlocks blocks = view.free;
  const auto look = [&](DepthBlock::Kind ahead) {
    blocks.at(view.row(), view.col()).kind = ahead;
    view.integrate(blocks);
  };
  const auto at = [&](double north_m, double east_m) {
    return view.map.state(view.map.index({north_m, east_m, view.p_WC.z()}));
  };
  for (int i = 0; i < 5; ++i) look(DepthBlock::Kind::sky);
  for (double north_m = 2.0; north_m < 12.0; north_m += 0.3) ASSERT_EQ(at(north_m, 0.15), State::free) << north_m;
  for (int i = 0; i < 3; ++i) look(DepthBlock::Kind::line);
  for (int i = 0; i < 20; ++i) {
    for (double north_m = 2.0; north_m < 12.0; north_m += 0.3) {
      // From the first voxel completely beyond 4 m.
      const State ahead = at(north_m, 0.15), expected = north_m > 4.45 ? State::unknown : State::free;
      EXPECT_TRUE(ahead == expected || (north_m >= 4.0 && north_m <= 4.45)) << north_m;
      EXPECT_TRUE(north_m < 3.0 || at(north_m, -1.65) == State::free) << north_m;
    }
    look(DepthBlock::Kind::line);
  }
}

// A line 7 m ahead, too far to place a surface.
struct LineAhead : NorthView {
  static constexpr double kLineM = 7.0;

  LineAhead() : line(free) {
    cv::Mat lines16(line.rows(), line.cols(), CV_16SC1, cv::Scalar(stereo::kNoDisparity));
    lines16.at<int16_t>(row(), col()) = static_cast<int16_t>(units / kLineM);
    line.add_lines(lines16);
  }
  void look(const DepthBlocks& blocks, int images, std::span<const OccupancyMap::MovingDisc> moving = {}) {
    for (int i = 0; i < images; ++i) map.integrate(blocks, world.geometry, X_WC, moving);
  }
  /// Compares the voxels on the line's ray, except for those at the ends of its two-sigma range.
  void expect(State at_line, State elsewhere) const {
    const double two_sigma16 = 2.0 * map.config().noise_px * stereo::kDisparityUnits;
    const double from_m = units / (units / kLineM + two_sigma16), to_m = units / (units / kLineM - two_sigma16);
    for (double north_m = 2.1; north_m < 14.0; north_m += 0.3) {
      const double z_m = north_m - p_WC.x();
      if (std::min(std::abs(z_m - from_m), std::abs(z_m - to_m)) < 0.3) continue;
      const State expected = z_m > from_m && z_m < to_m ? at_line : elsewhere;
      EXPECT_EQ(map.state(map.index({north_m, 0.15, p_WC.z()})), expected) << north_m;
    }
  }

  double units = stereo::kDisparityUnits * world.geometry.baseline_m * world.geometry.focal_px;
  DepthBlocks line;
};

// Free voxels within two sigma of a line become unknown after two images, and occupied after four; those in front of it
// stay free. It is not reported as a surface that may move.
TEST(ThinObjects, MatchedLineOccupiesFreeSpaceWithinItsError) {
  LineAhead test;
  test.look(test.free, 5);
  test.expect(State::free, State::free);
  test.look(test.line, 1);
  test.expect(State::free, State::free);
  test.look(test.line, 1);
  test.expect(State::unknown, State::free);
  EXPECT_TRUE(test.map.hits().empty());
  test.look(test.line, 2);
  test.expect(State::occupied, State::free);
  EXPECT_TRUE(test.map.hits().empty());
  // Space that is seen to be free again is free after five images.
  test.look(test.free, 5);
  test.expect(State::free, State::free);
}

// A wrong match in space that was never seen would not be corrected.
TEST(ThinObjects, MatchedLineOccupiesUnknownSpaceOnlyAfterThreeImages) {
  LineAhead test;
  const OccupancyMap::Index ahead = test.map.index({7.05, 0.15, test.p_WC.z()});
  test.look(test.line, 2);
  EXPECT_EQ(test.map.state(ahead), State::unknown);
  test.look(test.line, 1);
  EXPECT_EQ(test.map.state(ahead), State::occupied);
}

TEST(ThinObjects, MatchedLineOfAMovingObstacleLeavesNoTrail) {
  LineAhead test;
  test.look(test.free, 5);
  const std::array<OccupancyMap::MovingDisc, 1> moving = {{{{7.0, 0.15}, 3.0}}};
  test.look(test.line, 20, moving);
  test.expect(State::unknown, State::free);
}

// A second image of the same instant that shows free space, such as that of a pair that cannot match the line.
TEST(ThinObjects, FreeSpaceInAnotherImageDoesNotOutweighALine) {
  NorthView view;
  const auto ahead = [&] { return view.map.state(view.map.index({7.05, 0.15, -1.35})); };
  DepthBlocks line = view.free;
  const auto line16 = static_cast<int16_t>(view.world.geometry.disparity16(7.0));
  line.add_lines(cv::Mat(line.rows(), line.cols(), CV_16SC1, cv::Scalar(line16)));
  for (int i = 0; i < 5; ++i) view.integrate(view.free);
  EXPECT_EQ(ahead(), State::free);
  for (int i = 0; i < 3; ++i) {
    view.integrate(line);
    view.integrate(view.free, OccupancyMap::Instant::same);
  }
  EXPECT_EQ(ahead(), State::unknown);
  for (int i = 0; i < 5; ++i) view.integrate(view.free);
  EXPECT_EQ(ahead(), State::free);
}

}  // namespace
}  // namespace hedgehop::vision::mapping
