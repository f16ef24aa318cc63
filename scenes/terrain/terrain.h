#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "scenes/scene.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::terrain {

/// A surface of triangles over a grid of heights, instead of the plane at altitude 0.
struct TerrainConfig {
  std::string heightmap;
  std::optional<double> spacing_m;
  double low_m = 0.0, high_m = 0.0;  ///< altitudes of black and white in a PNG
  double north_m = 0.0, east_m = 0.0;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<TerrainConfig> auto& c) {
  v("heightmap", c.heightmap,
    {.meaning = "grey PNG of 8 or 16 bit, or TIFF of one band in m; up is north; at most 512 x 512 samples"});
  v("spacing", c.spacing_m,
    {.unit = "m", .above = 0.0, .at_most = 1000.0, .meaning = "distance between samples; default: that of a GeoTIFF"});
  v("low", c.low_m, {.unit = "m", .meaning = "altitude of black in a PNG"});
  v("high", c.high_m, {.unit = "m", .meaning = "altitude of white in a PNG"});
  v("north", c.north_m,
    {.unit = "m", .meaning = "north position of the map's middle; of a GeoTIFF, its shift to the north"});
  v("east", c.east_m,
    {.unit = "m", .meaning = "east position of the map's middle; of a GeoTIFF, its shift to the east"});
}

/// Adds a terrain to a scene: triangles with the texture of a meadow, and solids of shape `surface`. Cells with a
/// corner without data are holes.
/// @param origin_ENU  origin of georeferenced coordinates, m. It is also subtracted from the altitudes of a GeoTIFF.
/// @param seed  of the texture.
/// @throws std::invalid_argument that begins with the faulty key.
void add_terrain(const TerrainConfig& config, const Eigen::Vector3d& origin_ENU, uint64_t seed, Scene& scene);

}  // namespace hedgehop::scenes::terrain
