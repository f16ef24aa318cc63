#include "scenes/worlds/map.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

#include "scenes/map/building_mesh.h"
#include "scenes/map/fault_lines.h"
#include "scenes/map/ground_mesh.h"
#include "scenes/map/map_files.h"
#include "scenes/map/map_trees.h"
#include "scenes/map/streets.h"
#include "scenes/map/traffic.h"
#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"
#include "sim/fields/quantities.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::worlds {
namespace {

using Eigen::Vector2d;

// Streams of the map's seed.
constexpr uint64_t kTownImageStream = 0, kTownBuildingStream = 1, kTownTreeStream = 2, kTreeShapeStream = 3,
                   kTrafficStream = 4;

/// Calls `read` and adds the key and the file to its error.
template <class Read>
auto read_file(const char* key, const std::string& file, const Read& read) {
  try {
    return read();
  } catch (const std::invalid_argument& fault) {
    throw fields::InvalidField(key, "'" + file + "': " + fault.what());
  }
}

/// The objects within the radius, and the extent of all objects.
class NearObjects {
 public:
  explicit NearObjects(double radius_m) : radius_m_(radius_m) {}

  bool contains(const Vector2d& p_NE) const { return p_NE.cwiseAbs().maxCoeff() <= radius_m_; }
  /// Returns whether points are within the radius, and notes them or counts their object.
  bool takes(const std::vector<Vector2d>& points_NE) {
    if (!std::ranges::all_of(points_NE, [&](const Vector2d& p_NE) { return contains(p_NE); })) {
      ++left_out_;
      return false;
    }
    for (const Vector2d& p : points_NE) bounds_NE_.extend(p);
    return true;
  }

  int left_out() const { return left_out_; }
  /// Returns the maximum distance of an object from the origin, north or east.
  double extent_m() const { return bounds_NE().min().cwiseAbs().cwiseMax(bounds_NE().max()).maxCoeff(); }
  Eigen::AlignedBox2d bounds_NE() const {
    constexpr double kMarginM = 20.0;
    Eigen::AlignedBox2d box = bounds_NE_;
    box.extend(Vector2d::Zero().eval());
    return {box.min() - Vector2d::Constant(kMarginM), box.max() + Vector2d::Constant(kMarginM)};
  }

 private:
  double radius_m_;
  int left_out_ = 0;
  Eigen::AlignedBox2d bounds_NE_;
};

// The next functions return the objects within the radius, and report only their faults.

std::vector<map::MapBuilding> near_buildings(const map::OsmObjects& objects, const map::LocalPlane& plane,
                                             const map::DefaultHeights& heights, NearObjects& near,
                                             std::vector<std::string>& faults) {
  std::vector<map::MapBuilding> buildings;
  for (const map::OsmArea& area : objects.buildings) {
    std::vector<std::string> own_faults;
    map::MapBuilding building = map::building_of(area, plane, heights, own_faults);
    const auto is_taken = [&](const map::Footprint& footprint) { return near.takes(footprint.outer); };
    if (!std::ranges::all_of(building.footprints, is_taken)) continue;
    buildings.push_back(std::move(building));
    std::ranges::move(own_faults, std::back_inserter(faults));
  }
  return buildings;
}

std::vector<map::Street> near_streets(const map::OsmObjects& objects, const map::LocalPlane& plane, NearObjects& near,
                                      std::vector<std::string>& faults) {
  const auto is_near = [&](const map::GeoPoint& place) { return near.contains(plane.p_NE(place)); };
  std::vector<map::Street> streets;
  for (const map::OsmLine& line : objects.streets) {
    std::vector<std::string> own_faults;
    std::optional<map::Street> street = map::street_of(line, plane, own_faults);
    if (!(street ? near.takes(street->line_NE) : std::ranges::all_of(line.points, is_near))) continue;
    if (street) streets.push_back(std::move(*street));
    std::ranges::move(own_faults, std::back_inserter(faults));
  }
  return streets;
}

std::vector<map::MapTree> near_trees(const map::OsmObjects& objects, const map::LocalPlane& plane, uint64_t seed,
                                     NearObjects& near, std::vector<std::string>& faults) {
  std::vector<std::string> all_faults;
  std::vector<map::MapTree> trees = map::trees_of(objects, plane, seed, all_faults);
  std::erase_if(trees, [&](const map::MapTree& tree) { return !near.takes({tree.p_NE}); });
  std::set<std::string> names;
  for (const map::MapTree& tree : trees) names.insert(tree.name);
  for (const map::OsmLine& row : objects.tree_rows) {
    const auto is_near = [&](const map::GeoPoint& place) { return near.contains(plane.p_NE(place)); };
    if (std::ranges::any_of(row.points, is_near)) names.insert(row.name);
  }
  std::ranges::copy_if(all_faults, std::back_inserter(faults),
                       [&](const std::string& fault) { return names.contains(fault.substr(0, fault.find(": "))); });
  return trees;
}

std::string summary(const MapConfig& config, const std::vector<map::MapBuilding>& buildings,
                    const std::vector<map::Street>& streets, size_t trees, int left_out) {
  double area_m2 = 0.0, length_m = 0.0;
  for (const map::MapBuilding& building : buildings) {
    for (const map::Footprint& footprint : building.footprints) area_m2 += map::area_m2(footprint);
  }
  for (const map::Street& street : streets) {
    for (size_t i = 1; i < street.line_NE.size(); ++i) length_m += (street.line_NE[i] - street.line_NE[i - 1]).norm();
  }
  char text[160];
  std::snprintf(text, sizeof text, "%zu buildings on %.1f m2, %zu streets of %.1f m, %zu trees", buildings.size(),
                area_m2, streets.size(), length_m, trees);
  std::string line = "'" + config.osm + "': " + text;
  if (left_out > 0) line += "; " + std::to_string(left_out) + " objects outside scene.radius";
  return line;
}

/// Throws std::invalid_argument: every object is outside the radius, for example because the origin is of another
/// place.
[[noreturn]] void refuse_origin(const MapConfig& config, const map::OsmObjects& objects) {
  const map::GeoPoint place = !objects.buildings.empty()   ? objects.buildings[0].polygons[0].outer[0]
                              : !objects.streets.empty()   ? objects.streets[0].points[0]
                              : !objects.tree_rows.empty() ? objects.tree_rows[0].points[0]
                                                           : objects.trees.at(0).place;
  char text[160];
  std::snprintf(text, sizeof text,
                ": all objects are outside scene.radius; the first is at latitude %.6g, longitude %.7g",
                place.latitude_deg, place.longitude_deg);
  throw fields::InvalidField("origin", "'" + config.osm + "'" + text);
}

/// Reads the terrain within the radius, at most some distance beyond the objects, since a smaller area has more of the
/// file's samples. @param extent_m  of the objects. @param[out] remarks  receives a line if the terrain has fewer
/// samples than the file, or unusable ones.
map::Ground ground_of(const MapConfig& config, const map::LocalPlane& plane, double extent_m,
                      std::vector<std::string>& remarks) {
  constexpr double kBeyondObjectsM = 2e3;
  if (config.terrain.empty()) return {};
  const double radius_m = std::min(config.radius_m, extent_m + kBeyondObjectsM);
  return read_file("terrain", config.terrain, [&] {
    const map::HeightSamples samples = map::read_heights(config.terrain, plane.bounds(radius_m));
    char text[160];
    if (samples.stride > 1) {
      std::snprintf(text, sizeof text, "every %d. sample is used; the others are up to %.2f m from the surface",
                    samples.stride, samples.skipped_error_m);
      remarks.push_back("'" + config.terrain + "': " + text + "; a smaller scene.radius uses more");
    }
    if (samples.absurd_count > 0)
      remarks.push_back("'" + config.terrain + "': " + std::to_string(samples.absurd_count) +
                        " samples have heights that do not exist on Earth; they are holes");
    return map::Ground(samples, plane, config.origin.altitude_m);
  });
}

/// Reports the streets that lie partly outside the terrain.
void report_holes(const std::vector<map::Street>& streets, const map::Ground& ground,
                  std::vector<std::string>& faults) {
  for (const map::Street& street : streets) {
    if (!ground.lowest_m(street.line_NE))
      faults.push_back(street.name + ": drawn in part, since the terrain has no height at some of its points");
  }
}

}  // namespace

MapContents read_map(const MapConfig& config, uint64_t seed) {
  fields::require_bounds(config);
  require_texture_size(config.texture_size_px);
  fields::require(!config.osm.empty(), "osm", "is required");
  const map::LocalPlane plane({config.origin.latitude_rad * kDegPerRad, config.origin.longitude_rad * kDegPerRad});
  map::OsmObjects objects = read_file("osm", config.osm, [&] { return map::read_osm(config.osm); });

  MapContents contents;
  std::vector<std::string>& faults = objects.faults;
  NearObjects near(config.radius_m);
  const std::vector<map::MapBuilding> buildings =
      near_buildings(objects, plane, {config.building_height_m, config.level_height_m}, near, faults);
  const std::vector<map::Street> streets = near_streets(objects, plane, near, faults);
  std::vector<map::MapTree> trees = near_trees(objects, plane, derived_seed(seed, kTownTreeStream), near, faults);
  if (buildings.empty() && streets.empty() && trees.empty() && near.left_out() > 0) refuse_origin(config, objects);
  contents.remarks.push_back(summary(config, buildings, streets, trees.size(), near.left_out()));
  const map::Ground ground = ground_of(config, plane, near.extent_m(), contents.remarks);
  report_holes(streets, ground, faults);

  map::TownTextures town =
      map::town_textures(static_cast<int>(config.texture_size_px), derived_seed(seed, kTownImageStream));
  Scene& scene = contents.scene;
  scene.textures = town.images();
  scene.bounds_NE_m = near.bounds_NE();
  scene.has_ground = !ground.terrain();
  mesh::MeshBuilder mesh("opaque");
  map::add_ground_mesh(ground, map::street_surfaces(streets, town), 0.5 * scene.bounds_NE_m.sizes().maxCoeff(),
                       town.city.grass, mesh, scene.solids);
  if (mesh.index_count() == 0)
    throw fields::InvalidField("terrain", "'" + config.terrain + "': it has no cell with data");
  for (size_t k = 0; k < buildings.size(); ++k) {
    Random random(derived_seed(derived_seed(seed, kTownBuildingStream), k));
    map::add_map_building(buildings[k], ground, town, random, mesh, scene.solids, faults);
  }
  map::add_map_trees(std::move(trees), ground, town, derived_seed(seed, kTreeShapeStream), mesh, scene.solids, faults);
  scene.meshes.push_back(mesh.finish());
  map::add_traffic(streets, ground, town, config.vehicles, config.vehicle_speed_mps, derived_seed(seed, kTrafficStream),
                   scene.movers);
  if (const auto cars = static_cast<int64_t>(scene.movers.size()); cars < config.vehicles) {
    contents.remarks.push_back(std::to_string(cars) + " of " + std::to_string(config.vehicles) +
                               " cars: no further straight piece of a street is 40 m long");
  }
  std::ranges::move(map::one_line_each(faults), std::back_inserter(contents.remarks));
  return contents;
}

Scene make_map(const MapConfig& config, uint64_t) {
  fields::require_bounds(config);
  require_texture_size(config.texture_size_px);
  Scene scene;
  scene.name = "map";
  scene.textures = TextureList(static_cast<int>(config.texture_size_px));
  scene.lights.ambient = 0.62f;
  scene.lights.sun = 0.50f;
  scene.lights.to_sun_W = Eigen::Vector3f(0.35f, -0.55f, -0.76f).normalized();
  return scene;
}

}  // namespace hedgehop::scenes::worlds
