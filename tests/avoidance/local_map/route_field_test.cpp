#include "avoidance/local_map/route_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <queue>
#include <random>
#include <tuple>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kCellM = 0.5;

/// A map of one layer with given free cells.
struct Grid {
  int side = 24;
  std::vector<uint8_t> blocked;
  LevelSlice slice;

  static Grid random(uint64_t seed) {
    std::mt19937_64 generator(seed);
    Grid grid;
    grid.blocked.assign(static_cast<size_t>(grid.side * grid.side), 0);
    for (int wall = 0; wall < 6; ++wall) {
      const int row = static_cast<int>(generator() % 24), col = static_cast<int>(generator() % 24);
      const bool along = generator() % 2 == 0;
      for (int i = 0; i < 9; ++i) {
        const int r = std::min(23, along ? row + i : row), c = std::min(23, along ? col : col + i);
        grid.blocked[static_cast<size_t>(r * 24 + c)] = 1;
      }
    }
    grid.build();
    return grid;
  }
  void build() {
    vision::mapping::OccupancyMap map({.voxel_m = kCellM, .across = side, .layers = 1});
    map.reset(Eigen::Vector3d::Zero());
    ClosedCells closed(kCellM);
    for (int r = 0; r < side; ++r) {
      for (int c = 0; c < side; ++c) {
        const Eigen::Vector3d center_W = map.center(map.first() + vision::mapping::OccupancyMap::Index(r, c, 0));
        if (is_blocked(r, c)) {
          closed.close(center_W, 0.1, 0.0);  // unknown and closed: an obstacle
        } else {
          map.clear_cylinder(center_W, 0.1, 0.1);
        }
      }
    }
    slice.build(map, {0.1, 0.4}, closed);
  }
  bool is_blocked(int row, int col) const { return blocked[static_cast<size_t>(row * side + col)]; }

  /// Whether a disc can pass from cell to cell: flood fill with brute-force distances to all blocked cells.
  bool may_enter(int row, int col, double need_m) const { return away_m(row, col) >= need_m; }
  /// Distance from the center of a cell to the edge of the nearest blocked cell.
  double away_m(int row, int col) const {
    double least_m = 1e6;
    for (int r = 0; r < side; ++r) {
      for (int c = 0; c < side; ++c) {
        if (is_blocked(r, c)) least_m = std::min(least_m, kCellM * (std::hypot(r - row, c - col) - 0.5));
      }
    }
    return least_m;
  }
  std::vector<uint8_t> reachable(int goal_row, int goal_col, double need_m) const {
    std::vector<uint8_t> seen(blocked.size(), 0);
    std::queue<std::pair<int, int>> open;
    if (may_enter(goal_row, goal_col, need_m)) open.emplace(goal_row, goal_col);
    while (!open.empty()) {
      const auto [row, col] = open.front();
      open.pop();
      if (row < 0 || col < 0 || row >= side || col >= side || seen[static_cast<size_t>(row * side + col)]) continue;
      if (!may_enter(row, col, need_m)) continue;
      seen[static_cast<size_t>(row * side + col)] = 1;
      for (const auto& [dr, dc] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) open.emplace(row + dr, col + dc);
    }
    return seen;
  }
};

double beyond(const Eigen::Vector2d&) { return 0.0; }

TEST(RouteField, FindsARouteExactlyIfFloodFillFindsOne) {
  constexpr double kNeedM = 0.7;
  int reached = 0, cut_off = 0;
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    const Grid grid = Grid::random(seed);
    const int goal_row = static_cast<int>(seed * 7 % 24), goal_col = static_cast<int>(seed * 5 % 24);
    if (!grid.may_enter(goal_row, goal_col, kNeedM)) continue;
    RouteField field;
    field.build(grid.slice, {kNeedM, kNeedM}, grid.slice.center(goal_row, goal_col), beyond);
    const std::vector<uint8_t> expected = grid.reachable(goal_row, goal_col, kNeedM);
    for (int row = 0; row < grid.side; ++row) {
      for (int col = 0; col < grid.side; ++col) {
        if (!grid.may_enter(row, col, kNeedM)) continue;
        const bool expect = expected[static_cast<size_t>(row * grid.side + col)];
        const auto route_W = field.route_W(grid.slice.center(row, col), 1e3);
        const bool arrives = (route_W.back() - grid.slice.center(goal_row, goal_col)).norm() < 1e-9;
        ASSERT_EQ(arrives, expect) << seed << " " << row << " " << col;
        ++(expect ? reached : cut_off);
      }
    }
  }
  EXPECT_GT(reached, 2000);
  EXPECT_GT(cut_off, 20);
}

/// An east-west wall of five rows with two gaps, 1 and 6 cells wide.
Grid two_gaps(int narrow_col, int wide_col) {
  Grid grid;
  grid.blocked.assign(static_cast<size_t>(grid.side * grid.side), 0);
  constexpr int kFirstRow = 10, kLastRow = 14, kWide = 6;
  for (int row = kFirstRow; row <= kLastRow; ++row) {
    for (int col = 0; col < grid.side; ++col) {
      grid.blocked[static_cast<size_t>(row * grid.side + col)] =
          col != narrow_col && (col < wide_col || col >= wide_col + kWide);
    }
  }
  grid.build();
  return grid;
}

// The passage with the preferred width if its detour is short; otherwise the narrow passage.
TEST(RouteField, LeadsThroughANarrowPassageOnlyIfTheDetourIsLong) {
  const RouteClearance route_clearance{0.7, 0.2};
  for (const auto& [narrow_col, wide_col, narrow] : {std::tuple{9, 11, false}, {2, 18, true}}) {
    const Grid grid = two_gaps(narrow_col, wide_col);
    const Eigen::Vector2d from_W = grid.slice.center(7, narrow_col);
    RouteField field;
    field.build(grid.slice, route_clearance, grid.slice.center(17, narrow_col), beyond);
    const double nearest_m = field.nearest_m(from_W, 1e3);
    EXPECT_EQ(nearest_m < route_clearance.preferred_m, narrow) << narrow_col;
    EXPECT_GE(nearest_m, route_clearance.least_m);
    double by_hand_m = 1e3;
    for (const Eigen::Vector2d& at_W : field.route_W(from_W, 1e3)) {
      const Eigen::Vector2i cell = grid.slice.cell(at_W);
      by_hand_m = std::min(by_hand_m, grid.away_m(cell.x(), cell.y()));
    }
    EXPECT_NEAR(nearest_m, by_hand_m, 1e-6);
    field.build(grid.slice, {route_clearance.preferred_m, route_clearance.preferred_m},
                grid.slice.center(17, narrow_col), beyond);
    EXPECT_GE(field.nearest_m(from_W, 1e3), route_clearance.preferred_m);
  }
}

TEST(RouteField, PrefersLongDetoursOrOnlyShortOnesToANarrowPassage) {
  using enum RouteClearance::Detours;
  RouteClearance route_clearance{0.7, 0.2};
  for (const auto& [narrow_col, wide_col, shorter, longer] :
       {std::tuple{6, 11, short_ones, usual}, {2, 18, usual, long_ones}}) {
    const Grid grid = two_gaps(narrow_col, wide_col);
    const auto is_narrow = [&](RouteClearance::Detours detours) {
      route_clearance.detours = detours;
      RouteField field;
      field.build(grid.slice, route_clearance, grid.slice.center(17, narrow_col), beyond);
      return field.nearest_m(grid.slice.center(7, narrow_col), 1e3) < route_clearance.preferred_m;
    };
    EXPECT_TRUE(is_narrow(shorter)) << narrow_col;
    EXPECT_FALSE(is_narrow(longer)) << narrow_col;
  }
}

TEST(RouteField, RoutesKeepTheirDistanceFromObstacles) {
  constexpr double kNeedM = 0.7;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const Grid grid = Grid::random(seed);
    if (!grid.may_enter(2, 2, kNeedM)) continue;
    RouteField field;
    field.build(grid.slice, {kNeedM, kNeedM}, grid.slice.center(2, 2), beyond);
    for (int row = 0; row < grid.side; row += 3) {
      for (int col = 0; col < grid.side; col += 3) {
        if (!grid.may_enter(row, col, kNeedM)) continue;
        const std::vector<Eigen::Vector2d> route_W = field.route_W(grid.slice.center(row, col), 1e3);
        for (size_t i = 0; i + 1 < route_W.size(); ++i) {
          for (const double way : {0.0, 0.3, 0.49, 0.51, 0.7, 1.0}) {  // also between cell centers
            const Eigen::Vector2i cell = grid.slice.cell(route_W[i] + way * (route_W[i + 1] - route_W[i]));
            EXPECT_TRUE(grid.may_enter(cell.x(), cell.y(), kNeedM)) << seed;
          }
        }
      }
    }
  }
}

TEST(RouteField, DistancesInOpenSpaceAreThoseOfAnEightConnectedGrid) {
  Grid grid;
  grid.blocked.assign(static_cast<size_t>(grid.side * grid.side), 0);
  vision::mapping::OccupancyMap map({.voxel_m = kCellM, .across = grid.side, .layers = 1});
  map.reset(Eigen::Vector3d::Zero());
  map.clear_cylinder(Eigen::Vector3d::Zero(), 100.0, 1.0);
  grid.slice.build(map, {-0.1, 0.1}, ClosedCells(kCellM));
  RouteField field;
  field.build(grid.slice, {0.5, 0.5}, grid.slice.center(3, 4), beyond);
  constexpr double kRounding = 0.02;  // diagonal steps count 1.4 cells
  for (int row = 0; row < grid.side; ++row) {
    for (int col = 0; col < grid.side; ++col) {
      const int a = std::abs(row - 3), b = std::abs(col - 4);
      const double octile_m = kCellM * (std::max(a, b) + (std::sqrt(2.0) - 1.0) * std::min(a, b));
      EXPECT_NEAR(field.to_goal_m(grid.slice.center(row, col)).value(), octile_m, kRounding * octile_m + 1e-9);
    }
  }
}

TEST(RouteField, RouteToAGoalOutsideCrossesTheNearestEdge) {
  Grid grid;
  vision::mapping::OccupancyMap map({.voxel_m = kCellM, .across = grid.side, .layers = 1});
  map.reset(Eigen::Vector3d::Zero());
  map.clear_cylinder(Eigen::Vector3d::Zero(), 100.0, 1.0);
  grid.slice.build(map, {-0.1, 0.1}, ClosedCells(kCellM));
  const Eigen::Vector2d goal_W(40.0, 0.0);
  RouteField field;
  field.build(grid.slice, {0.5, 0.5}, goal_W, [&](const Eigen::Vector2d& p_W) { return (goal_W - p_W).norm(); });
  const Eigen::Vector2d end_W = field.route_W({-4.0, 0.2}, 100.0).back();
  EXPECT_GT(end_W.x(), 5.0);
  EXPECT_NEAR(end_W.y(), 0.2, 1.0);
}

constexpr double kNeedM = 0.5;
const Eigen::Vector3d goal_W(40.0, 0.0, 0.0);

/// A map of 24 m of open space, or with a wall across it north of the vehicle; it owns the field and the slice.
struct Known {
  explicit Known(bool walled, const LearnedDistances& learned) {
    vision::mapping::OccupancyMap map({.voxel_m = kCellM, .across = 48, .layers = 1});
    map.reset(Eigen::Vector3d::Zero());
    ClosedCells closed(kCellM);
    if (walled) {
      for (double east_m = -11.9; east_m < 12.0; east_m += kCellM) closed.remember({4.1, east_m, 0.1}, 0.0);
      map.clear_cylinder({-8.0, 0.0, 0.0}, 11.5, 1.0);
    } else {
      map.clear_cylinder(Eigen::Vector3d::Zero(), 100.0, 1.0);
    }
    slice.build(map, {-0.1, 0.3}, closed);
    field.build(slice, {kNeedM, kNeedM}, goal_W.head<2>(), learned.beyond_m(goal_W.head<2>(), 0.0));
  }
  LevelSlice slice;
  RouteField field;
};

TEST(LearnedDistances, EqualTheStraightLineInOpenSpace) {
  LearnedDistances learned;
  const Known open(false, learned);
  learned.learn(open.field, open.slice, Eigen::Vector3d::Zero(), goal_W);
  for (const Eigen::Vector2d& at_W :
       {Eigen::Vector2d(1.5, 1.5), Eigen::Vector2d(-4.5, 4.5), Eigen::Vector2d(7.5, -7.5)}) {
    const double straight_m = (goal_W.head<2>() - at_W).norm();
    constexpr double kOctile = 1.09;  // maximum excess length on an eight-connected grid
    EXPECT_GE(learned.at_least_m(at_W, 0.0), straight_m - kCellM);
    EXPECT_LE(learned.at_least_m(at_W, 0.0), kOctile * straight_m);
  }
  EXPECT_EQ(learned.at_least_m({100.0, 0.0}, 0.0), 0.0);
}

TEST(LearnedDistances, NeverDecreaseWhenTheMapFades) {
  LearnedDistances learned;
  const Known walled(true, learned);
  learned.learn(walled.field, walled.slice, Eigen::Vector3d::Zero(), goal_W);
  const Eigen::Vector2d at_W(1.5, 1.5);
  const double found_m = learned.at_least_m(at_W, 0.0);
  EXPECT_GT(found_m, (goal_W.head<2>() - at_W).norm() + 8.0);  // around an end of the wall, 10 m to the side
  const Known forgotten(false, learned);
  learned.learn(forgotten.field, forgotten.slice, Eigen::Vector3d::Zero(), goal_W);
  EXPECT_EQ(learned.at_least_m(at_W, 0.0), found_m);
}

TEST(LearnedDistances, CountAtOtherAltitudesMinusTheClimbAndForNoOtherGoal) {
  LearnedDistances learned;
  const Known walled(true, learned);
  learned.learn(walled.field, walled.slice, Eigen::Vector3d::Zero(), goal_W);
  const Eigen::Vector2d at_W(1.5, 1.5);
  const double here_m = learned.at_least_m(at_W, 0.0), above_m = learned.at_least_m(at_W, -2.4);
  EXPECT_LT(above_m, here_m);
  EXPECT_GT(above_m, 0.0);
  const Known open(false, {});
  learned.learn(open.field, open.slice, Eigen::Vector3d::Zero(), goal_W + Eigen::Vector3d(1.0, 0.0, 0.0));
  EXPECT_LT(learned.at_least_m(at_W, 0.0), here_m);
}

}  // namespace
}  // namespace hedgehop::avoidance::local_map
