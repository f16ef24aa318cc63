#include "scenes/terrain/terrain.h"

#include <cmath>
#include <stdexcept>

#include "scenes/terrain/heightmap.h"
#include "scenes/terrain/surface_grid.h"
#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::scenes::terrain {

namespace {

constexpr double kMaxPositionM = 100e3;  // as for every position in a scenario

void require_near(const Eigen::Vector2d& northwest_EN, const Eigen::Vector2d& span_m) {
  const Eigen::Vector2d middle = northwest_EN + 0.5 * Eigen::Vector2d(span_m.x(), -span_m.y());
  if (middle.cwiseAbs().maxCoeff() + span_m.maxCoeff() <= kMaxPositionM) return;
  const auto text = [](double m) { return std::to_string(std::llround(m)); };
  throw fields::InvalidField("terrain.heightmap", "its middle is " + text(middle.x()) + " m east and " +
                                                      text(middle.y()) +
                                                      " m north; subtract it with scene.origin: [east, north, up]");
}

/// Returns the samples in W.
SurfaceGrid grid_of(const TerrainConfig& c, const Eigen::Vector3d& origin_ENU, const Heightmap& map) {
  if (!c.spacing_m && !map.spacing_EN_m) throw fields::InvalidField("terrain.spacing", "is required without a GeoTIFF");
  SurfaceGrid grid{.rows = map.values.rows, .columns = map.values.cols, .points_W = {}};
  const Eigen::Vector2d spacing_EN_m = c.spacing_m ? Eigen::Vector2d(*c.spacing_m, *c.spacing_m) : *map.spacing_EN_m;
  const Eigen::Vector2d span_m(spacing_EN_m.x() * (grid.columns - 1), spacing_EN_m.y() * (grid.rows - 1));
  const Eigen::Vector2d placed_EN(c.east_m, c.north_m);
  Eigen::Vector2d northwest_EN = placed_EN + 0.5 * Eigen::Vector2d(-span_m.x(), span_m.y());
  if (map.northwest_EN_m) northwest_EN = placed_EN + *map.northwest_EN_m - origin_ENU.head<2>();
  double low_m = -origin_ENU.z(), height_per_value_m = 1.0;
  if (!map.in_meters) {
    if (!(c.low_m < c.high_m)) throw fields::InvalidField("terrain.high", "must be greater than 'low' for a PNG");
    low_m = c.low_m;
    height_per_value_m = c.high_m - c.low_m;
  }
  require_near(northwest_EN, span_m);
  grid.points_W.reserve(map.values.total());
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      grid.points_W.emplace_back(northwest_EN.y() - row * spacing_EN_m.y(),
                                 northwest_EN.x() + column * spacing_EN_m.x(),
                                 -(low_m + height_per_value_m * static_cast<double>(map.values(row, column))));
    }
  }
  return grid;
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
  if (!add_surface(grid_of(config, origin_ENU, map), seed, scene)) {
    throw fields::InvalidField("terrain.heightmap", "'" + config.heightmap + "': it has no cell with data");
  }
}

}  // namespace hedgehop::scenes::terrain
