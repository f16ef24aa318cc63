#include "avoidance/flow_balance/zig_zag.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "tests/avoidance/flow_balance/point_flight.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

using std::numbers::pi;

// [Garratt2009] sec. 4: 8 m x 16 m.
const Walls kRoom = {wall(8, 0, pi), wall(-8, 0, 0), wall(0, 4, -0.5 * pi), wall(0, -4, 0.5 * pi)};
double clearance_m(const Eigen::Vector2d& p) { return std::min(8.0 - std::abs(p.x()), 4.0 - std::abs(p.y())); }

ZigZagConfig small_images() {
  ZigZagConfig config;
  config.flow = {.rows = 1, .cols = 8, .patch_px = 24, .margin_px = 6};
  return config;
}

TEST(ZigZag, PublishedLawReachesTheEndsAndSidesOfTheRoomWithoutCollision) {
  ZigZagConfig config = small_images();
  config.law = Law::published;
  for (const double heading : {0.0, pi / 8}) {
    const PointFlight flight =
        fly(*make_zig_zag(config), kRoom, heading, {{0, 0, -1}, heading}, {-5.0, 0.5}, 40.0, clearance_m);
    EXPECT_GT(flight.least_clearance_m, 0.4) << heading;
    double north = 0.0, east = 0.0;
    for (const Eigen::Vector2d& p : flight.path) {
      north = std::max(north, std::abs(p.x()));
      east = std::max(east, std::abs(p.y()));
    }
    EXPECT_GT(north, 5.0) << heading;
    EXPECT_GT(east, 1.5) << heading;
    EXPECT_EQ(flight.metrics.back().name, "reversals");
    EXPECT_GT(flight.metrics.back().value, 6.0);
    EXPECT_LT(flight.metrics.back().value, 60.0);
  }
}

TEST(ZigZag, ModifiedLawCoversTheRoomCloserToItsWalls) {
  ZigZagConfig config = small_images();
  config.range_threshold_m = 0.6;
  config.stray_rad = pi / 9;
  for (const double heading : {0.0, pi / 8}) {
    const PointFlight flight =
        fly(*make_zig_zag(config), kRoom, heading, {{0, 0, -1}, heading}, {-3.0, 0.5}, 120.0, clearance_m);
    EXPECT_GT(flight.least_clearance_m, 0.3) << heading;
    std::set<std::pair<int, int>> cells;
    for (const Eigen::Vector2d& p : flight.path) {
      cells.insert({static_cast<int>(std::floor(p.x() / 2.0)), static_cast<int>(std::floor(p.y() / 2.0))});
    }
    EXPECT_GE(cells.size(), 28u) << heading;  // of 8 x 4 squares of 2 m
  }
}

TEST(ZigZag, RejectsConfigsOutOfRange) {
  const auto refuse = [](auto change) {
    ZigZagConfig config = small_images();
    change(config);
    EXPECT_THROW(make_zig_zag(config), std::invalid_argument);
  };
  refuse([](auto& c) { c.forward_speed_mps = 0.0; });
  refuse([](auto& c) { c.range_threshold_m = 0.0; });
  refuse([](auto& c) { c.braking_mps2 = 0.0; });
  refuse([](auto& c) { c.reaction_s = std::nan(""); });
  refuse([](auto& c) { c.tail_m = -0.1; });
  refuse([](auto& c) { c.stray_rad = -0.1; });
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
