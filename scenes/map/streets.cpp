#include "scenes/map/streets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include "scenes/map/tags.h"
#include "scenes/textures/stone_textures.h"
#include "scenes/textures/street_textures.h"

namespace hedgehop::scenes::map {
namespace {

using Eigen::Vector2d;

/// Width without a tag, m, and whether cars drive on it.
struct StreetKind {
  double width_m;
  bool has_lanes;
};

const StreetKind* kind_of(std::string_view highway) {
  static const std::map<std::string_view, StreetKind> kKinds = {
      {"motorway", {12.0, true}},      {"trunk", {12.0, true}},         {"primary", {11.0, true}},
      {"secondary", {10.0, true}},     {"tertiary", {9.0, true}},       {"unclassified", {8.0, true}},
      {"residential", {8.0, true}},    {"living_street", {7.0, true}},  {"road", {8.0, true}},
      {"motorway_link", {7.0, true}},  {"trunk_link", {7.0, true}},     {"primary_link", {7.0, true}},
      {"secondary_link", {7.0, true}}, {"tertiary_link", {7.0, true}},  {"service", {4.0, false}},
      {"pedestrian", {6.0, false}},    {"track", {3.0, false}},         {"bridleway", {2.0, false}},
      {"footway", {2.0, false}},       {"cycleway", {2.5, false}},      {"path", {1.5, false}},
      {"steps", {2.0, false}},         {"busway", {7.0, true}},         {"raceway", {8.0, false}},
      {"bus_guideway", {4.0, false}},  {"emergency_bay", {3.0, false}}, {"escape", {6.0, false}}};
  const auto found = kKinds.find(highway);
  return found == kKinds.end() ? nullptr : &found->second;
}

/// Returns whether ways of a kind are not on the ground, or do not exist.
bool is_no_street(std::string_view highway) {
  static const std::set<std::string_view> kNoStreets = {
      "abandoned", "construction", "corridor", "disused", "elevator",  "ladder",   "no",         "planned",
      "platform",  "proposed",     "razed",    "removed", "rest_area", "services", "via_ferrata"};
  return kNoStreets.contains(highway);
}

Vector2d right_of(const Vector2d& along) { return Vector2d(-along.y(), along.x()).normalized(); }

/// Returns the vector from each point of a line to the right edge of its ribbon.
std::vector<Vector2d> to_right_edge(const std::vector<Vector2d>& line, double half_m) {
  constexpr double kMaxMiter = 2.0;  // of half the width, at sharp bends
  std::vector<Vector2d> offsets;
  for (size_t i = 0; i < line.size(); ++i) {
    const Vector2d before = right_of(line[std::max<size_t>(i, 1)] - line[std::max<size_t>(i, 1) - 1]);
    const Vector2d after = i + 1 < line.size() ? right_of(line[i + 1] - line[i]) : before;
    const Vector2d sum = before + after;
    const double cosine = 0.5 * sum.norm();  // of half the bend
    if (cosine < 1e-3) {
      offsets.push_back(half_m * before);
    } else {
      offsets.push_back(half_m * std::min(1.0 / cosine, kMaxMiter) * sum.normalized());
    }
  }
  return offsets;
}

/// Adds the surface of a street.
void add_ribbon(const Street& street, double lift_m, const TownTextures& town, std::vector<StreetTriangle>& triangles) {
  const double tile_m = street.has_lanes ? textures::kStreetTileM : textures::kAsphaltTileM;
  const std::vector<Vector2d>& line = street.line_NE;
  const std::vector<Vector2d> offsets = to_right_edge(line, 0.5 * street.width_m);
  const uint32_t texture = street.has_lanes ? town.city.streets[0] : town.asphalt;
  const double across = street.has_lanes ? 1.0 : street.width_m / tile_m;
  double along_m = 0.0;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const double next_m = along_m + (line[i + 1] - line[i]).norm();
    const Vector2d top_left = line[i + 1] - offsets[i + 1], top_right = line[i + 1] + offsets[i + 1],
                   bottom_left = line[i] - offsets[i], bottom_right = line[i] + offsets[i];
    const Vector2d top_left_uv(0.0, -next_m / tile_m), top_right_uv(across, -next_m / tile_m),
        bottom_left_uv(0.0, -along_m / tile_m), bottom_right_uv(across, -along_m / tile_m);
    triangles.push_back(
        {{top_left, bottom_left, bottom_right}, {top_left_uv, bottom_left_uv, bottom_right_uv}, texture, lift_m});
    triangles.push_back(
        {{top_left, bottom_right, top_right}, {top_left_uv, bottom_right_uv, top_right_uv}, texture, lift_m});
    along_m = next_m;
  }
}

}  // namespace

std::optional<Street> street_of(const OsmLine& line, const LocalPlane& plane, std::vector<std::string>& faults) {
  const TagReader tags(line.name, line.tags, faults);
  const StreetKind* const kind = kind_of(tags.text("highway"));
  const std::string_view tunnel = tags.text("tunnel");
  if (is_no_street(tags.text("highway")) || (!tunnel.empty() && tunnel != "no")) return {};
  if (kind == nullptr) {
    tags.report("highway", "it is not drawn");
    return {};
  }
  if (tags.text("area") == "yes") {
    faults.push_back(line.name + ": an area with 'highway' is not drawn");
    return {};
  }
  Street street{line.name, {}, kind->width_m, kind->has_lanes};
  for (const GeoPoint& place : line.points) street.line_NE.push_back(plane.p_NE(place));
  constexpr double kMinWidthM = 0.5, kMaxWidthM = 60.0;
  street.width_m = tags.length_m("width", kMinWidthM, kMaxWidthM).value_or(street.width_m);
  return street;
}

std::vector<StreetTriangle> street_surfaces(const std::vector<Street>& streets, const TownTextures& town) {
  constexpr double kLiftStepM = 4e-3;
  constexpr size_t kLifts = 8;  // different heights, since streets that cross at one height would flicker
  std::vector<StreetTriangle> triangles;
  for (size_t k = 0; k < streets.size(); ++k)
    add_ribbon(streets[k], kStreetLiftM + kLiftStepM * static_cast<double>(k % kLifts), town, triangles);
  return triangles;
}

}  // namespace hedgehop::scenes::map
