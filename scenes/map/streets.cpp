#include "scenes/map/streets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

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
      {"motorway", {12.0, true}},      {"trunk", {12.0, true}},        {"primary", {11.0, true}},
      {"secondary", {10.0, true}},     {"tertiary", {9.0, true}},      {"unclassified", {8.0, true}},
      {"residential", {8.0, true}},    {"living_street", {7.0, true}}, {"road", {8.0, true}},
      {"motorway_link", {7.0, true}},  {"trunk_link", {7.0, true}},    {"primary_link", {7.0, true}},
      {"secondary_link", {7.0, true}}, {"tertiary_link", {7.0, true}}, {"service", {4.0, false}},
      {"pedestrian", {6.0, false}},    {"track", {3.0, false}},        {"bridleway", {2.0, false}},
      {"footway", {2.0, false}},       {"cycleway", {2.5, false}},     {"path", {1.5, false}},
      {"steps", {2.0, false}},         {"corridor", {2.0, false}},     {"busway", {7.0, true}}};
  const auto found = kKinds.find(highway);
  return found == kKinds.end() ? nullptr : &found->second;
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

using Cell = std::pair<int, int>;
using Quad = std::array<Vertex, 4>;  ///< top left, bottom left, bottom right, top right

Cell cell_of(const Vector2d& p_NE) {
  constexpr double kCellM = 128.0;
  return {static_cast<int>(std::floor(p_NE.x() / kCellM)), static_cast<int>(std::floor(p_NE.y() / kCellM))};
}

/// Adds the pieces of a street to the cells of its middles. Pieces without ground are left out.
void add_pieces(const Street& street, double lift_m, const Ground& ground, const TownTextures& town,
                std::map<Cell, std::vector<Quad>>& cells) {
  const double tile_m = street.has_lanes ? textures::kStreetTileM : textures::kAsphaltTileM;
  const std::vector<Vector2d> line = ground.divided(street.line_NE, 0.5 * tile_m);
  const std::vector<Vector2d> offsets = to_right_edge(line, 0.5 * street.width_m);
  const uint32_t texture = street.has_lanes ? town.city.streets[0] : town.asphalt;
  const double across = street.has_lanes ? 1.0 : street.width_m / tile_m;
  double along_m = 0.0;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const double next_m = along_m + (line[i + 1] - line[i]).norm();
    Quad quad;
    bool known = true;
    const auto set = [&](size_t corner, size_t point, bool right, double at_m) {
      const Vector2d p_NE = line[point] + (right ? 1.0 : -1.0) * offsets[point];
      const std::optional<double> altitude_m = ground.altitude_m(p_NE);
      known = known && altitude_m;
      if (!altitude_m) return;
      quad[corner].p_W = Eigen::Vector3d(p_NE.x(), p_NE.y(), -*altitude_m - lift_m).cast<float>();
      quad[corner].uv = Vector2d(right ? across : 0.0, -at_m / tile_m).cast<float>();
      quad[corner].texture = texture;
    };
    set(0, i + 1, false, next_m);
    set(1, i, false, along_m);
    set(2, i, true, along_m);
    set(3, i + 1, true, next_m);
    if (known) cells[cell_of(0.5 * (line[i] + line[i + 1]))].push_back(quad);
    along_m = next_m;
  }
}

}  // namespace

std::optional<Street> street_of(const OsmLine& line, const LocalPlane& plane, std::vector<std::string>& faults) {
  const TagReader tags(line.name, line.tags, faults);
  const StreetKind* const kind = kind_of(tags.text("highway"));
  const std::string_view tunnel = tags.text("tunnel");
  if (kind == nullptr || (!tunnel.empty() && tunnel != "no")) return {};
  if (tags.text("area") == "yes") {
    faults.push_back(line.name + ": an area with 'highway' is not drawn");
    return {};
  }
  Street street{line.name, {}, kind->width_m, kind->has_lanes};
  for (const GeoPoint& place : line.points) street.line_NE.push_back(plane.p_NE(place));
  constexpr double kMinWidthM = 0.5, kMaxWidthM = 60.0;
  if (const std::optional<double> width_m = tags.length_m("width"))
    street.width_m = std::clamp(*width_m, kMinWidthM, kMaxWidthM);
  return street;
}

void add_streets(const std::vector<Street>& streets, const Ground& ground, const TownTextures& town,
                 mesh::MeshBuilder& mesh) {
  constexpr double kLiftStepM = 4e-3;
  constexpr size_t kLifts = 8;  // different heights, since streets that cross at one height would flicker
  std::map<Cell, std::vector<Quad>> cells;
  for (size_t k = 0; k < streets.size(); ++k)
    add_pieces(streets[k], kStreetLiftM + kLiftStepM * static_cast<double>(k % kLifts), ground, town, cells);
  if (cells.empty()) return;
  mesh.begin_instance("road", SemanticClass::road);
  const std::array<std::array<uint32_t, 3>, 2> faces{{{0, 1, 2}, {0, 2, 3}}};
  for (const auto& [cell, quads] : cells) {
    mesh.begin_chunk(false);
    for (const Quad& quad : quads) mesh.add(quad, faces);
  }
}

}  // namespace hedgehop::scenes::map
