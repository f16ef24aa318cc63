#include "scenes/terrain/surface_grid.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scenes/textures/street_textures.h"

namespace hedgehop::scenes::terrain {

namespace {

/// The samples at the corners of triangles, row by row.
class Corners {
 public:
  Corners(const SurfaceGrid& grid, std::span<const GridTriangle> triangles) : columns_(grid.columns) {
    for (const GridTriangle& triangle : triangles) {
      for (const GridPlace& place : triangle) places_.push_back(number(place));
    }
    std::ranges::sort(places_);
    places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  }

  /// Calls `visit` with the row and column of each corner.
  template <class Visit>
  void each(const Visit& visit) const {
    for (const int place : places_) visit(place / columns_, place % columns_);
  }
  /// Returns a triangle with indices into the corners.
  std::array<uint32_t, 3> face(const GridTriangle& triangle) const {
    std::array<uint32_t, 3> face;
    for (size_t k = 0; k < 3; ++k)
      face[k] = static_cast<uint32_t>(std::ranges::lower_bound(places_, number(triangle[k])) - places_.begin());
    return face;
  }

 private:
  int number(const GridPlace& place) const { return place.row * columns_ + place.column; }

  int columns_;
  std::vector<int> places_;
};

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

std::vector<GridBlock> blocks_of(const SurfaceGrid& grid, int cells) {
  std::vector<GridBlock> blocks;
  for (int row = 0; row < grid.rows - 1; row += cells) {
    for (int column = 0; column < grid.columns - 1; column += cells) {
      blocks.push_back({row, std::min(row + cells, grid.rows - 1), column, std::min(column + cells, grid.columns - 1)});
    }
  }
  return blocks;
}

std::vector<GridTriangle> triangles_of(const SurfaceGrid& grid, const GridBlock& block) {
  std::vector<GridTriangle> triangles;
  for (int row = block.first_row; row < block.last_row; ++row) {
    for (int column = block.first_column; column < block.last_column; ++column) {
      const GridPlace northwest{row, column}, northeast{row, column + 1}, southwest{row + 1, column},
          southeast{row + 1, column + 1};
      const auto known = [&](const GridPlace& place) { return grid.is_known(place.row, place.column); };
      if (!known(northwest) || !known(northeast) || !known(southwest) || !known(southeast)) continue;
      triangles.push_back({northwest, southwest, northeast});
      triangles.push_back({northeast, southwest, southeast});
    }
  }
  return triangles;
}

void add_triangles(const SurfaceGrid& grid, std::span<const GridTriangle> triangles, uint32_t texture,
                   mesh::MeshBuilder& mesh) {
  const Corners corners(grid, triangles);
  std::vector<Vertex> vertices;
  corners.each([&](int row, int column) {
    const Eigen::Vector3d p_W = grid.p_W(row, column), n_W = grid.normal_W(row, column);
    const Eigen::Vector2d uv = Eigen::Vector2d(p_W.y(), -p_W.x()) / textures::kGrassTileM;
    vertices.push_back({p_W.cast<float>(), n_W.cast<float>(), uv.cast<float>(), texture});
  });
  std::vector<std::array<uint32_t, 3>> faces;
  for (const GridTriangle& triangle : triangles) faces.push_back(corners.face(triangle));
  mesh.add(vertices, faces);
}

Solid solid_of(const SurfaceGrid& grid, std::span<const GridTriangle> triangles) {
  const Corners corners(grid, triangles);
  Solid solid{.name = "terrain", .shape = Solid::Shape::surface};
  corners.each([&](int row, int column) { solid.polyhedron.corners.push_back(grid.p_W(row, column)); });
  for (const GridTriangle& triangle : triangles) solid.polyhedron.faces.push_back(corners.face(triangle));
  return solid;
}

bool add_surface(const SurfaceGrid& grid, uint64_t seed, Scene& scene) {
  const int size_px = scene.textures.size_px();
  const uint32_t texture = scene.textures.add([=] { return textures::paint_grass(size_px, seed); });
  constexpr int kCellsPerBlock = 16;
  mesh::MeshBuilder builder("opaque");
  builder.begin_instance("terrain", SemanticClass::ground);
  for (const GridBlock& block : blocks_of(grid, kCellsPerBlock)) {
    const std::vector<GridTriangle> triangles = triangles_of(grid, block);
    if (triangles.empty()) continue;
    builder.begin_chunk(false);
    add_triangles(grid, triangles, texture, builder);
    scene.solids.push_back(solid_of(grid, triangles));
  }
  if (builder.index_count() == 0) return false;
  scene.meshes.push_back(builder.finish());
  return true;
}

}  // namespace hedgehop::scenes::terrain
