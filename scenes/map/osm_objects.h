#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hedgehop::scenes::map {

/// A place on the WGS 84 ellipsoid, degrees.
struct GeoPoint {
  double latitude_deg = 0.0, longitude_deg = 0.0;
};
using GeoRing = std::vector<GeoPoint>;  ///< the last point is not the first again
using Tags = std::map<std::string, std::string>;

/// A polygon with holes. Outer rings run counter-clockwise seen from above, holes clockwise.
struct GeoPolygon {
  GeoRing outer;
  std::vector<GeoRing> holes;
};

/// An object of OpenStreetMap. The name is its kind and id, such as "way 12".
struct OsmArea {
  std::string name;
  Tags tags;
  std::vector<GeoPolygon> polygons;  ///< at least one
};
struct OsmLine {
  std::string name;
  Tags tags;
  std::vector<GeoPoint> points;  ///< at least two
};
struct OsmPoint {
  std::string name;
  Tags tags;
  GeoPoint place;
};

/// The objects of a file that a scene contains, in the order of the file.
struct OsmObjects {
  std::vector<OsmArea> buildings;   ///< closed ways and multipolygons with `building`
  std::vector<OsmLine> streets;     ///< ways with `highway`
  std::vector<OsmPoint> trees;      ///< nodes with `natural=tree`
  std::vector<OsmLine> tree_rows;   ///< ways with `natural=tree_row`
  std::vector<std::string> faults;  ///< "way 12: ...": one line for each such object whose shape is incomplete
};

/// The function of libhedgehop_osm.so, which is loaded for the first map. @param[out] read  the objects of the file.
/// Throws std::runtime_error with the reason if the file cannot be read.
using ReadOsm = void(const std::filesystem::path& file, OsmObjects& read);
constexpr const char* kOsmLibrary = "libhedgehop_osm.so";
constexpr const char* kReadOsm = "hedgehop_read_osm";

}  // namespace hedgehop::scenes::map
