#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::scenes::terrain {

/// A surface through a grid of points: rows from north to south, columns from west to east, not necessarily along
/// the axes of W. Each cell is two triangles, divided from northeast to southwest. Cells with an unknown corner are
/// holes.
struct SurfaceGrid {
  int rows = 0, columns = 0;
  std::vector<Eigen::Vector3d> points_W;  ///< m, row by row; z is NaN if it is unknown

  const Eigen::Vector3d& p_W(int row, int column) const {
    return points_W[static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(column)];
  }
  bool is_known(int row, int column) const;

  /// Returns the upward normal from central differences, or one-sided ones at the edge of the known points.
  Eigen::Vector3d normal_W(int row, int column) const;

  /// Returns the altitude of the surface, m; nullopt outside and over holes. The grid must be nearly regular: each cell
  /// is within a cell of its place in a grid of parallelograms.
  std::optional<double> altitude_m(const Eigen::Vector2d& p_NE) const;
};

/// Adds a surface to a scene: triangles with the texture of a meadow, and solids of shape `surface`.
/// @param seed  of the texture. @return whether the grid has a cell without unknown corners.
bool add_surface(const SurfaceGrid& grid, uint64_t seed, Scene& scene);

}  // namespace hedgehop::scenes::terrain
