#include "scenes/map/ground.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace hedgehop::scenes::map {
namespace {

/// Orders the rows of a grid from north to south and its columns from west to east, for any file.
void orient(terrain::SurfaceGrid& grid) {
  const auto swap_axes = [&] {
    terrain::SurfaceGrid turned{.rows = grid.columns, .columns = grid.rows, .points_W = {}};
    turned.points_W.reserve(grid.points_W.size());
    for (int row = 0; row < turned.rows; ++row) {
      for (int column = 0; column < turned.columns; ++column) turned.points_W.push_back(grid.p_W(column, row));
    }
    grid = std::move(turned);
  };
  const Eigen::Vector3d down = grid.p_W(grid.rows - 1, 0) - grid.p_W(0, 0);
  if (std::abs(down.y()) > std::abs(down.x())) swap_axes();
  if (grid.p_W(grid.rows - 1, 0).x() > grid.p_W(0, 0).x()) {
    for (int row = 0; row < grid.rows / 2; ++row) {
      const auto at = [&](int r) { return grid.points_W.begin() + static_cast<std::ptrdiff_t>(r) * grid.columns; };
      std::swap_ranges(at(row), at(row + 1), at(grid.rows - 1 - row));
    }
  }
  if (grid.p_W(0, grid.columns - 1).y() < grid.p_W(0, 0).y()) {
    for (int row = 0; row < grid.rows; ++row) {
      const auto first = grid.points_W.begin() + static_cast<std::ptrdiff_t>(row) * grid.columns;
      std::reverse(first, first + grid.columns);
    }
  }
}

}  // namespace

Ground::Ground(const HeightSamples& samples, const LocalPlane& plane, std::optional<double> origin_m) {
  terrain_ = terrain::SurfaceGrid{.rows = samples.rows, .columns = samples.columns, .points_W = {}};
  terrain_->points_W.reserve(samples.samples.size());
  for (const HeightSample& sample : samples.samples) {
    const Eigen::Vector2d p_NE = plane.p_NE(sample.place);
    terrain_->points_W.emplace_back(p_NE.x(), p_NE.y(), -sample.height_m);
  }
  orient(*terrain_);
  if (!origin_m) origin_m = terrain_->altitude_m(Eigen::Vector2d::Zero());
  if (!origin_m) throw std::invalid_argument("it has no height at the origin; set origin.altitude");
  for (Eigen::Vector3d& p_W : terrain_->points_W) p_W.z() += *origin_m;
}

std::optional<double> Ground::altitude_m(const Eigen::Vector2d& p_NE) const {
  return terrain_ ? terrain_->altitude_m(p_NE) : 0.0;
}

std::optional<double> Ground::lowest_m(const std::vector<Eigen::Vector2d>& points_NE) const {
  std::optional<double> lowest;
  for (const Eigen::Vector2d& p_NE : points_NE) {
    const std::optional<double> own = altitude_m(p_NE);
    if (!own) return {};
    lowest = std::min(lowest.value_or(*own), *own);
  }
  return lowest;
}

std::vector<Eigen::Vector2d> Ground::divided(const std::vector<Eigen::Vector2d>& line_NE, double step_m) const {
  if (!terrain_) return line_NE;
  std::vector<Eigen::Vector2d> points{line_NE.front()};
  for (size_t i = 1; i < line_NE.size(); ++i) {
    const Eigen::Vector2d along = line_NE[i] - line_NE[i - 1];
    const int parts = std::max(1, static_cast<int>(std::ceil(along.norm() / step_m)));
    for (int k = 1; k <= parts; ++k) points.push_back(line_NE[i - 1] + along * k / parts);
  }
  return points;
}

}  // namespace hedgehop::scenes::map
