#include "scenes/terrain/terrain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "scenes/mesh/mesh_builder.h"
#include "scenes/terrain/heightmap.h"
#include "scenes/textures/stone_textures.h"
#include "scenes/textures/street_textures.h"
#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::scenes::terrain {

namespace {

constexpr int kCellsPerChunk = 16;       // along each side
constexpr double kMaxPositionM = 100e3;  // as for every position in a scenario

/// The samples in W.
class Grid {
 public:
  Grid(const TerrainConfig& c, const Eigen::Vector3d& origin_ENU, Heightmap map) : map_(std::move(map)) {
    if (!c.spacing_m && !map_.spacing_EN_m)
      throw fields::InvalidField("terrain.spacing", "is required without a GeoTIFF");
    spacing_EN_m_ = c.spacing_m ? Eigen::Vector2d(*c.spacing_m, *c.spacing_m) : *map_.spacing_EN_m;
    const Eigen::Vector2d span_m(spacing_EN_m_.x() * (columns() - 1), spacing_EN_m_.y() * (rows() - 1));
    const Eigen::Vector2d placed_EN(c.east_m, c.north_m);
    northwest_EN_ = placed_EN + 0.5 * Eigen::Vector2d(-span_m.x(), span_m.y());
    if (map_.northwest_EN_m) northwest_EN_ = placed_EN + *map_.northwest_EN_m - origin_ENU.head<2>();
    if (map_.in_meters) {
      low_m_ = -origin_ENU.z();
      span_m_ = 1.0;
    } else {
      if (!(c.low_m < c.high_m)) throw fields::InvalidField("terrain.high", "must be greater than 'low' for a PNG");
      low_m_ = c.low_m;
      span_m_ = c.high_m - c.low_m;
    }
    require_near(span_m);
  }

  int rows() const { return map_.values.rows; }
  int columns() const { return map_.values.cols; }
  bool is_known(int row, int column) const { return !std::isnan(map_.values(row, column)); }

  Eigen::Vector3d p_W(int row, int column) const {
    return {northwest_EN_.y() - row * spacing_EN_m_.y(), northwest_EN_.x() + column * spacing_EN_m_.x(),
            -(low_m_ + span_m_ * static_cast<double>(map_.values(row, column)))};
  }

  /// Returns the upward normal from central differences, or one-sided ones at the edge of the known samples.
  Eigen::Vector3d normal_W(int row, int column) const {
    const auto pick = [&](int r, int q) {
      const bool inside = r >= 0 && r < rows() && q >= 0 && q < columns();
      return inside && is_known(r, q) ? p_W(r, q) : p_W(row, column);
    };
    const Eigen::Vector3d north = pick(row - 1, column) - pick(row + 1, column),
                          east = pick(row, column + 1) - pick(row, column - 1);
    const Eigen::Vector3d down = north.cross(east);
    return down.norm() > 0.0 ? Eigen::Vector3d(-down.normalized()) : Eigen::Vector3d(0.0, 0.0, -1.0);
  }

 private:
  void require_near(const Eigen::Vector2d& span_m) const {
    const Eigen::Vector2d middle = northwest_EN_ + 0.5 * Eigen::Vector2d(span_m.x(), -span_m.y());
    if (middle.cwiseAbs().maxCoeff() + span_m.maxCoeff() <= kMaxPositionM) return;
    const auto text = [](double m) { return std::to_string(std::llround(m)); };
    throw fields::InvalidField("terrain.heightmap", "its middle is " + text(middle.x()) + " m east and " +
                                                        text(middle.y()) +
                                                        " m north; subtract it with scene.origin: [east, north, up]");
  }

  Heightmap map_;
  Eigen::Vector2d spacing_EN_m_, northwest_EN_;
  double low_m_ = 0.0, span_m_ = 1.0;
};

/// Adds a block of cells as a chunk and a solid.
void add_block(const Grid& grid, int first_row, int first_column, uint32_t texture, mesh::MeshBuilder& builder,
               Scene& scene) {
  const int last_row = std::min(first_row + kCellsPerChunk, grid.rows() - 1),
            last_column = std::min(first_column + kCellsPerChunk, grid.columns() - 1);
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

}  // namespace

void add_terrain(const TerrainConfig& config, const Eigen::Vector3d& origin_ENU, uint64_t seed, Scene& scene) {
  fields::require_bounds(config, "terrain");
  fields::require(!config.heightmap.empty(), "terrain.heightmap", "is required");
  Heightmap map;
  try {
    map = read_heightmap(config.heightmap);
  } catch (const std::invalid_argument& fault) {
    throw fields::InvalidField("terrain.heightmap", "'" + config.heightmap + "': " + fault.what());
  }
  const Grid grid(config, origin_ENU, std::move(map));
  const int size_px = scene.textures.size_px();
  const uint32_t texture = scene.textures.add([=] { return textures::paint_grass(size_px, seed); });
  mesh::MeshBuilder builder("opaque");
  builder.begin_instance("terrain", SemanticClass::ground);
  for (int row = 0; row < grid.rows() - 1; row += kCellsPerChunk) {
    for (int column = 0; column < grid.columns() - 1; column += kCellsPerChunk)
      add_block(grid, row, column, texture, builder, scene);
  }
  if (builder.index_count() == 0) {
    throw fields::InvalidField("terrain.heightmap", "'" + config.heightmap + "': it has no cell with data");
  }
  scene.meshes.push_back(builder.finish());
}

}  // namespace hedgehop::scenes::terrain
