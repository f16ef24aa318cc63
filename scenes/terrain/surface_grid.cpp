#include "scenes/terrain/surface_grid.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "scenes/mesh/mesh_builder.h"
#include "scenes/textures/street_textures.h"

namespace hedgehop::scenes::terrain {

namespace {

constexpr int kCellsPerChunk = 16;  // along each side

/// Adds a block of cells as a chunk and a solid.
void add_block(const SurfaceGrid& grid, int first_row, int first_column, uint32_t texture, mesh::MeshBuilder& builder,
               Scene& scene) {
  const int last_row = std::min(first_row + kCellsPerChunk, grid.rows - 1),
            last_column = std::min(first_column + kCellsPerChunk, grid.columns - 1);
  std::vector<Vertex> vertices;
  cv::Mat_<int> corner_of(last_row - first_row + 1, last_column - first_column + 1, -1);
  Solid solid{.name = "terrain", .shape = Solid::Shape::surface};
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      if (!grid.is_known(row, column)) continue;
      const Eigen::Vector3d p_W = grid.p_W(row, column), n_W = grid.normal_W(row, column);
      const Eigen::Vector2d uv = Eigen::Vector2d(p_W.y(), -p_W.x()) / textures::kGrassTileM;
      corner_of(row - first_row, column - first_column) = static_cast<int>(vertices.size());
      vertices.push_back({p_W.cast<float>(), n_W.cast<float>(), uv.cast<float>(), texture});
      solid.polyhedron.corners.push_back(p_W);
    }
  }
  for (int row = 0; row + 1 < corner_of.rows; ++row) {
    for (int column = 0; column + 1 < corner_of.cols; ++column) {
      const int northwest = corner_of(row, column), northeast = corner_of(row, column + 1),
                southwest = corner_of(row + 1, column), southeast = corner_of(row + 1, column + 1);
      if (std::min({northwest, northeast, southwest, southeast}) < 0) continue;
      const auto add = [&](int a, int b, int c) {
        solid.polyhedron.faces.push_back(
            {static_cast<uint32_t>(a), static_cast<uint32_t>(b), static_cast<uint32_t>(c)});
      };
      add(northwest, southwest, northeast);
      add(northeast, southwest, southeast);
    }
  }
  if (solid.polyhedron.faces.empty()) return;
  builder.begin_chunk(false);
  builder.add(vertices, solid.polyhedron.faces);
  scene.solids.push_back(std::move(solid));
}

/// Returns the height of a triangle over a point of the plan; nullopt outside.
std::optional<double> height_in(const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector2d& p_NE) {
  constexpr double kEdge = 1e-9;  // share of a side: points on a shared edge belong to one of the triangles
  Eigen::Matrix2d sides;
  sides << (triangle[1] - triangle[0]).head<2>(), (triangle[2] - triangle[0]).head<2>();
  const Eigen::Vector2d share = sides.inverse() * (p_NE - triangle[0].head<2>());
  if (share.minCoeff() < -kEdge || share.sum() > 1.0 + kEdge) return {};
  return -(triangle[0].z() + share.x() * (triangle[1] - triangle[0]).z() + share.y() * (triangle[2] - triangle[0]).z());
}

}  // namespace

bool SurfaceGrid::is_known(int row, int column) const { return !std::isnan(p_W(row, column).z()); }

Eigen::Vector3d SurfaceGrid::normal_W(int row, int column) const {
  const auto pick = [&](int r, int q) {
    const bool inside = r >= 0 && r < rows && q >= 0 && q < columns;
    return inside && is_known(r, q) ? p_W(r, q) : p_W(row, column);
  };
  const Eigen::Vector3d north = pick(row - 1, column) - pick(row + 1, column),
                        east = pick(row, column + 1) - pick(row, column - 1);
  const Eigen::Vector3d down = north.cross(east);
  return down.norm() > 0.0 ? Eigen::Vector3d(-down.normalized()) : Eigen::Vector3d(0.0, 0.0, -1.0);
}

std::optional<double> SurfaceGrid::altitude_m(const Eigen::Vector2d& p_NE) const {
  if (rows < 2 || columns < 2) return {};
  const auto plan = [&](int row, int column) -> Eigen::Vector2d { return p_W(row, column).head<2>(); };
  int row = rows / 2, column = columns / 2;
  row = std::min(row, rows - 2);
  column = std::min(column, columns - 2);
  // Steps by the shape of the cell at hand; a regular grid needs one.
  constexpr int kMaxSteps = 8;
  for (int step = 0; step < kMaxSteps; ++step) {
    Eigen::Matrix2d sides;
    sides << plan(row + 1, column) - plan(row, column), plan(row, column + 1) - plan(row, column);
    const Eigen::Vector2d share = sides.inverse() * (p_NE - plan(row, column));
    const auto moved = [](int at, double by, int count) {
      return static_cast<int>(std::clamp(at + std::floor(by), 0.0, static_cast<double>(count - 2)));
    };
    const int next_row = moved(row, share.x(), rows), next_column = moved(column, share.y(), columns);
    if (next_row == row && next_column == column) break;
    row = next_row;
    column = next_column;
  }
  // The cell may be a neighbor's if the grid is not regular.
  for (const auto& [r, q] : {std::pair{0, 0}, {0, 1}, {1, 0}, {0, -1}, {-1, 0}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}) {
    const int at_row = row + r, at_column = column + q;
    if (at_row < 0 || at_column < 0 || at_row > rows - 2 || at_column > columns - 2) continue;
    const Eigen::Vector3d &northwest = p_W(at_row, at_column), &northeast = p_W(at_row, at_column + 1),
                          &southwest = p_W(at_row + 1, at_column), &southeast = p_W(at_row + 1, at_column + 1);
    if (std::isnan(northwest.z() + northeast.z() + southwest.z() + southeast.z())) continue;
    if (const auto found = height_in({northwest, southwest, northeast}, p_NE)) return found;
    if (const auto found = height_in({northeast, southwest, southeast}, p_NE)) return found;
  }
  return {};
}

bool add_surface(const SurfaceGrid& grid, uint64_t seed, Scene& scene) {
  const int size_px = scene.textures.size_px();
  const uint32_t texture = scene.textures.add([=] { return textures::paint_grass(size_px, seed); });
  mesh::MeshBuilder builder("opaque");
  builder.begin_instance("terrain", SemanticClass::ground);
  for (int row = 0; row < grid.rows - 1; row += kCellsPerChunk) {
    for (int column = 0; column < grid.columns - 1; column += kCellsPerChunk)
      add_block(grid, row, column, texture, builder, scene);
  }
  if (builder.index_count() == 0) return false;
  scene.meshes.push_back(builder.finish());
  return true;
}

}  // namespace hedgehop::scenes::terrain
