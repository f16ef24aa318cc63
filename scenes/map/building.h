#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "scenes/map/local_plane.h"
#include "scenes/map/osm_objects.h"

namespace hedgehop::scenes::map {

using PlanRing =
    std::vector<Eigen::Vector2d>;  ///< in the plan (north, east), m; the last corner is not the first again

/// A polygon of the plan with holes. The outer ring is clockwise in (north, east) as printed on a map with north up:
/// its signed area with respect to north and east is positive. Holes have the opposite sense.
struct Footprint {
  PlanRing outer;
  std::vector<PlanRing> holes;
};

/// Returns the area of a footprint without its holes, m^2.
double area_m2(const Footprint& footprint);

enum class RoofShape { flat, skillion, gabled, hipped, pyramidal };

/// A building of the map. Heights are above its lowest point on the ground, m.
struct MapBuilding {
  std::string name;                   ///< such as "way 12"
  std::vector<Footprint> footprints;  ///< at least one
  double height_m = 0.0;              ///< of the top of the roof
  double min_height_m = 0.0;          ///< of the bottom; 0: on the ground
  RoofShape roof = RoofShape::flat;
  double roof_height_m = 0.0;          ///< of the roof alone; 0 if flat
  bool ridge_across = false;           ///< the ridge runs along the shorter sides
  std::optional<double> slope_to_rad;  ///< a skillion roof descends to there, from north to east; default: across

  double eaves_m() const { return height_m - roof_height_m; }
};

/// Heights of buildings without tags of their own, m.
struct DefaultHeights {
  double building_m = 6.0, level_m = 3.0;
};

/// Returns the building of an area. Tags after [OSM3D2024] sec. on tags: `height`, `min_height`,
/// `building:levels`, `building:min_level`, `roof:shape`, `roof:height`, `roof:levels`, `roof:orientation`,
/// `roof:direction`.
/// @param[out] faults  receives a line "way 12: ..." for each tag that cannot be read; the default replaces it.
MapBuilding building_of(const OsmArea& area, const LocalPlane& plane, const DefaultHeights& defaults,
                        std::vector<std::string>& faults);

}  // namespace hedgehop::scenes::map
