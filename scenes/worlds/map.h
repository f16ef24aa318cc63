#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scenes/additions.h"
#include "scenes/world_config.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::worlds {

/// The place of W's origin on the WGS 84 ellipsoid.
struct MapOrigin {
  double latitude_rad = 0.0;
  double longitude_rad = 0.0;
  std::optional<double> altitude_m;  ///< in the heights of the terrain; default: that of the terrain at the origin
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MapOrigin> auto& c) {
  v("latitude", c.latitude_rad,
    {.unit = "deg", .at_least = -85.0, .at_most = 85.0, .required = true, .meaning = "latitude of the origin, WGS 84"});
  v("longitude", c.longitude_rad,
    {.unit = "deg",
     .at_least = -180.0,
     .at_most = 180.0,
     .required = true,
     .meaning = "longitude of the origin, WGS 84"});
  v("altitude", c.altitude_m,
    {.unit = "m", .meaning = "height of the origin in the terrain's file; default: that of the terrain there"});
}

/// A place from OpenStreetMap: buildings with simple roofs, streets with traffic, and trees, on terrain from a digital
/// elevation model. W's origin is at `origin`; north and east span the plane that touches the ellipsoid there.
struct MapConfig {
  static constexpr std::string_view kName = "map";
  static constexpr std::string_view kMeaning = "a real place: buildings, streets and trees from OpenStreetMap, terrain";

  std::string osm;
  std::string terrain;  ///< empty: the plane at altitude 0
  MapOrigin origin;
  double radius_m = 10e3;
  double building_height_m = 6.0;
  double level_height_m = 3.0;
  int64_t vehicles = 0;
  double vehicle_speed_mps = 8.0;
  int64_t texture_size_px = 512;
  SceneAdditions added;  ///< without another ground, terrain or origin
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MapConfig> auto& c) {
  v("osm", c.osm,
    {.required = true,
     .meaning = "map from OpenStreetMap, .osm or .osm.pbf; relative to the folder of the file that names it"});
  v("terrain", c.terrain,
    {.meaning = "digital elevation model that GDAL can read, such as a GeoTIFF; default: a plane at altitude 0"});
  v("origin", c.origin, {.required = true, .meaning = "place of the scene's origin"});
  v("radius", c.radius_m,
    {.unit = "m",
     .at_least = 50.0,
     .at_most = 20e3,
     .meaning = "objects and terrain farther from the origin, north or east, are left out"});
  v("building_height", c.building_height_m,
    {.unit = "m", .at_least = 1.0, .at_most = 1000.0, .meaning = "height of buildings without `height` and levels"});
  v("level_height", c.level_height_m,
    {.unit = "m", .at_least = 1.0, .at_most = 10.0, .meaning = "height of a level of buildings without `height`"});
  v("vehicles", c.vehicles,
    {.at_least = 0.0, .at_most = 200.0, .meaning = "number of cars that drive to and fro on straight streets"});
  v("vehicle_speed", c.vehicle_speed_mps,
    {.unit = "m/s", .above = 0.0, .at_most = 50.0, .meaning = "maximum speed of the cars; each drives at 60 to 100 %"});
  describe_texture_size(v, c.texture_size_px);
  describe_objects(v, c.added);
}

/// The contents of the map's files.
struct MapContents {
  Scene scene;                       ///< without a name; `bounds_NE_m` contain all objects
  std::vector<std::string> remarks;  ///< one line for each object that cannot be read, with its id
};

/// Reads the files of a map. Depends on the arguments and the contents of the files only.
/// @throws std::invalid_argument that begins with the faulty key: also if the file cannot be read, or if this build of
/// Hedgehop cannot read such files.
MapContents read_map(const MapConfig& config, uint64_t seed);

/// Returns the scene around the contents of the map's files: name and lights.
/// @throws std::invalid_argument with the field, its value and the valid values.
Scene make_map(const MapConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
