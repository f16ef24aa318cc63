#include "sim/verdict/floor_visited.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "sim/config/input_error.h"

namespace hedgehop::sim {
namespace {

/// Returns the cells along north and east.
Eigen::Vector2d cell_counts(const Eigen::Vector2d& size_m, double cell_m) {
  constexpr double kRoundOff = 1e-9;  // of a cell: 16.8 m / 1.2 m are 14 cells
  return ((size_m / cell_m).array() - kRoundOff).ceil();
}

}  // namespace

double visited_share(const Eigen::AlignedBox2d& plan_NE_m, double cell_m, const std::vector<Eigen::Vector2d>& path_NE_m,
                     double disc_radius_m) {
  const Eigen::Vector2i cells = cell_counts(plan_NE_m.sizes(), cell_m).cast<int>();
  const auto row_length = static_cast<size_t>(cells.y());
  std::vector<char> visited(static_cast<size_t>(cells.x()) * row_length, 0);
  const auto cell_range = [&](double center_m, double origin_m, int count) {
    const int first = static_cast<int>(std::floor((center_m - disc_radius_m - origin_m) / cell_m));
    const int last = static_cast<int>(std::ceil((center_m + disc_radius_m - origin_m) / cell_m));
    return std::pair{std::clamp(first, 0, count), std::clamp(last, 0, count)};
  };
  for (const Eigen::Vector2d& p : path_NE_m) {
    const auto [row_begin, row_end] = cell_range(p.x(), plan_NE_m.min().x(), cells.x());
    const auto [col_begin, col_end] = cell_range(p.y(), plan_NE_m.min().y(), cells.y());
    for (int row = row_begin; row < row_end; ++row) {
      for (int col = col_begin; col < col_end; ++col) {
        const Eigen::Vector2d center = plan_NE_m.min() + cell_m * Eigen::Vector2d(row + 0.5, col + 0.5);
        if ((center - p).norm() <= disc_radius_m)
          visited[static_cast<size_t>(row) * row_length + static_cast<size_t>(col)] = 1;
      }
    }
  }
  const auto count = std::count(visited.begin(), visited.end(), 1);
  return visited.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(visited.size());
}

void require_floor_cells(const Scenario& scenario, const scenes::Scene& scene) {
  constexpr double kMaxCells = 1e7;  // one byte each
  std::vector<FieldError> errors;
  for (size_t i = 0; i < scenario.checks.size(); ++i) {
    const auto* const check = std::get_if<FloorVisitedCheck>(&scenario.checks[i]);
    if (!check) continue;
    const Eigen::Vector2d size_m = scene.bounds_NE_m.sizes();
    const double cells = cell_counts(size_m, check->cell_m).prod();
    if (cells <= kMaxCells) continue;
    errors.push_back(
        {fmt::format("checks.{}.cell", i),
         fmt::format("{:g} m gives {:.3g} cells in the plan of {:.6g} m by {:.6g} m; a check has at most {:g}",
                     check->cell_m, cells, size_m.x(), size_m.y(), kMaxCells)});
  }
  if (!errors.empty()) throw InputError(std::move(errors));
}

}  // namespace hedgehop::sim
