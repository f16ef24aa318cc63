#include "sim/verdict/floor_visited.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "sim/config/input_error.h"

namespace hedgehop::sim {
namespace {

TEST(VisitedShare, EqualsTheDefinitionOnRandomPaths) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 30; ++trial) {
    std::uniform_real_distribution<double> uniform(-6.0, 6.0), size(0.3, 2.0);
    const Eigen::AlignedBox2d plan(Eigen::Vector2d(-4.0, -5.0), Eigen::Vector2d(4.0, 5.0));
    const double radius_m = size(random);
    std::vector<Eigen::Vector2d> path;
    for (int i = 0; i < 8; ++i) path.emplace_back(uniform(random), uniform(random));
    int visited = 0;
    for (int row = 0; row < 8; ++row) {
      for (int col = 0; col < 10; ++col) {
        bool covered = false;
        for (const Eigen::Vector2d& p : path) {
          covered = covered || std::hypot(-3.5 + row - p.x(), -4.5 + col - p.y()) <= radius_m;
        }
        visited += covered;
      }
    }
    EXPECT_DOUBLE_EQ(visited_share(plan, 1.0, path, radius_m), visited / 80.0);
  }
}

/// 16.8 m / 1.2 m and 8.4 m / 1.2 m are whole numbers of cells that doubles exceed by a bit.
TEST(VisitedShare, CountsNoCellsOutsideThePlan) {
  const Eigen::AlignedBox2d plan(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(16.8, 8.4));
  EXPECT_DOUBLE_EQ(visited_share(plan, 1.2, {{0.6, 0.6}}, 0.1), 1.0 / (14 * 7));
}

TEST(FloorVisited, RefusesCellsThatAreTooManyForThePlan) {
  Scenario scenario;
  scenes::Scene scene;
  scene.bounds_NE_m = {Eigen::Vector2d(-50.0, -20.0), Eigen::Vector2d(50.0, 20.0)};  // 4000 m^2
  const auto fault_of = [&](double cell_m) {
    scenario.checks = {NoCollisionCheck{}, FloorVisitedCheck{.cell_m = cell_m}};
    try {
      require_floor_cells(scenario, scene);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(fault_of(1e-9), ::testing::HasSubstr("checks.1.cell"));
  EXPECT_THAT(fault_of(0.0199), ::testing::HasSubstr("0.0199 m gives 1.01e+07 cells"));
  EXPECT_EQ(fault_of(0.021), "");
}

}  // namespace
}  // namespace hedgehop::sim
