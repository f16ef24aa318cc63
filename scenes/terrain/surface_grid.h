#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scenes/mesh/mesh_builder.h"
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

/// A sample of a grid.
struct GridPlace {
  int row = 0, column = 0;
};
using GridTriangle = std::array<GridPlace, 3>;  ///< counter-clockwise seen from above

/// Samples of a grid, both ends included.
struct GridBlock {
  int first_row = 0, last_row = 0, first_column = 0, last_column = 0;
};

/// Returns blocks of cells that cover a grid. Each is drawn as one chunk. @param cells  along each side of a block.
std::vector<GridBlock> blocks_of(const SurfaceGrid& grid, int cells);

/// Returns the triangles of the surface in a block, without those at unknown samples.
std::vector<GridTriangle> triangles_of(const SurfaceGrid& grid, const GridBlock& block);

/// Adds triangles between samples of a surface to the current chunk. @param texture  of a meadow.
void add_triangles(const SurfaceGrid& grid, std::span<const GridTriangle> triangles, uint32_t texture,
                   mesh::MeshBuilder& mesh);

/// Returns triangles between samples as a solid of shape `surface`.
Solid solid_of(const SurfaceGrid& grid, std::span<const GridTriangle> triangles);

/// Adds a surface to a scene: triangles with the texture of a meadow, and solids of shape `surface`.
/// @param seed  of the texture. @return whether the grid has a cell without unknown corners.
bool add_surface(const SurfaceGrid& grid, uint64_t seed, Scene& scene);

}  // namespace hedgehop::scenes::terrain
