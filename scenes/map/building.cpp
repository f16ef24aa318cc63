#include "scenes/map/building.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <string_view>

#include "scenes/map/tags.h"

namespace hedgehop::scenes::map {
namespace {

double signed_area_m2(const PlanRing& ring) {
  double twice_m2 = 0.0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    twice_m2 += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice_m2;
}

/// @param positive  the wanted sense of the ring.
PlanRing ring_of(const GeoRing& ring, const LocalPlane& plane, bool positive) {
  PlanRing corners;
  for (const GeoPoint& place : ring) corners.push_back(plane.p_NE(place));
  if ((signed_area_m2(corners) > 0.0) != positive) std::ranges::reverse(corners);
  return corners;
}

RoofShape roof_shape(const TagReader& tags) {
  static const std::map<std::string_view, RoofShape> kShapes = {
      {"", RoofShape::flat},         {"flat", RoofShape::flat},     {"skillion", RoofShape::skillion},
      {"gabled", RoofShape::gabled}, {"hipped", RoofShape::hipped}, {"pyramidal", RoofShape::pyramidal}};
  const auto found = kShapes.find(tags.text("roof:shape"));
  if (found != kShapes.end()) return found->second;
  tags.report("roof:shape", "it is drawn flat; valid: flat, skillion, gabled, hipped, pyramidal");
  return RoofShape::flat;
}

}  // namespace

double area_m2(const Footprint& footprint) {
  double sum_m2 = signed_area_m2(footprint.outer);
  for (const PlanRing& hole : footprint.holes) sum_m2 += signed_area_m2(hole);
  return sum_m2;
}

MapBuilding building_of(const OsmArea& area, const LocalPlane& plane, const DefaultHeights& defaults,
                        std::vector<std::string>& faults) {
  constexpr double kRoofM = 2.5, kMinWallM = 0.5, kMaxRoofShare = 0.5;  // of roofs without tags
  constexpr double kMinHeightM = 0.1, kMaxHeightM = 1500.0, kMaxLevels = 300.0;
  MapBuilding building;
  building.name = area.name;
  for (const GeoPolygon& polygon : area.polygons) {
    Footprint& footprint = building.footprints.emplace_back(Footprint{ring_of(polygon.outer, plane, true), {}});
    for (const GeoRing& hole : polygon.holes) footprint.holes.push_back(ring_of(hole, plane, false));
  }

  const TagReader tags(area.name, area.tags, faults);
  building.roof = roof_shape(tags);
  building.ridge_across = tags.text("roof:orientation") == "across";
  if (const std::optional<double> direction_deg = tags.direction_deg("roof:direction"))
    building.slope_to_rad = *direction_deg * std::numbers::pi / 180.0;
  const std::optional<double> height_m = tags.length_m("height", kMinHeightM, kMaxHeightM),
                              levels = tags.number("building:levels", kMaxLevels),
                              roof_levels = tags.number("roof:levels", kMaxLevels),
                              own_roof_m = tags.length_m("roof:height", 0.0, kMaxHeightM);
  double roof_m = kRoofM;
  if (own_roof_m) {
    roof_m = *own_roof_m;
  } else if (roof_levels && *roof_levels > 0.0) {
    roof_m = *roof_levels * defaults.level_m;
  }
  if (building.roof == RoofShape::flat) roof_m = own_roof_m || !roof_levels ? 0.0 : *roof_levels * defaults.level_m;

  building.height_m = defaults.building_m;
  if (height_m) {
    building.height_m = *height_m;
  } else if (levels) {
    building.height_m = *levels * defaults.level_m + roof_m;
  }
  const std::optional<double> min_m = tags.length_m("min_height", 0.0, kMaxHeightM),
                              min_level = tags.number("building:min_level", kMaxLevels);
  building.min_height_m = min_m ? *min_m : min_level.value_or(0.0) * defaults.level_m;
  if (!(building.height_m > building.min_height_m)) {
    faults.push_back(area.name + ": its height is not above its min_height; both are ignored");
    building.height_m = defaults.building_m;
    building.min_height_m = 0.0;
  }
  if (building.roof != RoofShape::flat) {
    const double wall_and_roof_m = building.height_m - building.min_height_m;
    building.roof_height_m = own_roof_m || roof_levels ? std::min(roof_m, std::max(wall_and_roof_m - kMinWallM, 0.0))
                                                       : std::min(roof_m, kMaxRoofShare * wall_and_roof_m);
  }
  return building;
}

}  // namespace hedgehop::scenes::map
