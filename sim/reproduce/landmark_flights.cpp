#include "sim/reproduce/landmark_flights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "scenes/worlds/highrise.h"
#include "sim/reproduce/corner_flight.h"

namespace hedgehop::sim {
namespace {

using Eigen::Vector3d;
using vision::landmarks::LandmarkCoordinates;
using vision::landmarks::LandmarkMap;

constexpr uint64_t kSeed = 1;

vision::landmarks::LandmarkMapConfig begun_by(LandmarkCoordinates coordinates) {
  vision::landmarks::LandmarkMapConfig config;
  config.start.coordinates = coordinates;
  return config;
}

std::optional<Vector3d> place_W(const LandmarkMap& map, const std::map<size_t, int64_t>& id_of_corner, size_t corner) {
  const auto id = id_of_corner.find(corner);
  if (id == id_of_corner.end()) return std::nullopt;
  const auto found = std::ranges::find(map.landmarks(), id->second, &vision::landmarks::MappedLandmark::id);
  if (found == map.landmarks().end()) return std::nullopt;
  return position_W(found->landmark);
}

Columns errors_of(const CornerFlight& flight) {
  constexpr size_t kSample = 2;  // a corner of the first roof, none that is special
  const Vector3d truth_W = flight.corners_W[kSample];
  const double per_m = 100.0 / (truth_W - flight.X_WC(0.0).translation()).norm();
  Columns columns;
  const auto sample = [&](double t_s, const LandmarkMap& map, const auto& id_of_corner) {
    const Vector3d unknown = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    const Vector3d off = per_m * (place_W(map, id_of_corner, kSample).value_or(unknown) - truth_W);
    columns["t_s"].push_back(t_s);
    columns["sample_north_percent"].push_back(off.x());
    columns["sample_east_percent"].push_back(off.y());
    columns["sample_altitude_percent"].push_back(-off.z());
  };
  columns["ground_percent"] =
      fly_past_corners(flight, begun_by(LandmarkCoordinates::cartesian), kSeed, sample).error_percent;
  columns["inverse_depth_percent"] =
      fly_past_corners(flight, begun_by(LandmarkCoordinates::inverse_depth), kSeed).error_percent;
  return columns;
}

/// Returns the edges of the towers in scenes::worlds::highrise_corners(): a box each, and a spire if a ninth corner
/// over the center of the eight follows.
std::vector<std::pair<size_t, size_t>> outline(const std::vector<Vector3d>& corners_W) {
  std::vector<std::pair<size_t, size_t>> edges;
  for (size_t first = 0; first < corners_W.size();) {
    Vector3d middle = Vector3d::Zero();
    for (size_t k = 0; k < 4; ++k) {
      edges.emplace_back(first + k, first + (k + 1) % 4);
      edges.emplace_back(first + 4 + k, first + 4 + (k + 1) % 4);
      edges.emplace_back(first + k, first + 4 + k);
      middle += 0.25 * corners_W[first + k];
    }
    const size_t top = first + 8;
    const bool spire = top < corners_W.size() && (corners_W[top] - middle).head<2>().norm() < 1e-6;
    for (size_t k = 0; spire && k < 4; ++k) edges.emplace_back(first + k, top);
    first = top + spire;
  }
  return edges;
}

void add_outline(const std::string& name, const std::vector<std::pair<size_t, size_t>>& edges,
                 const std::vector<Vector3d>& corners_W, Columns& columns) {
  const auto add = [&](const Vector3d& p_W) {
    columns[name + "_north_m"].push_back(p_W.x());
    columns[name + "_east_m"].push_back(p_W.y());
    columns[name + "_altitude_m"].push_back(-p_W.z());
  };
  for (const auto& [from, to] : edges) {
    add(corners_W[from]);
    add(corners_W[to]);
    add(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  }
}

Columns map_of(const CornerFlight& flight) {
  const auto edges = outline(flight.corners_W);
  Columns columns;
  add_outline("true", edges, flight.corners_W, columns);
  int image = 0;
  const int last = static_cast<int>(std::floor(flight.duration_s * 10.0));
  fly_past_corners(flight, begun_by(LandmarkCoordinates::cartesian), kSeed,
                   [&](double, const LandmarkMap& map, const auto& id_of_corner) {
                     const char* name = image == 0 ? "early" : image == last / 5 ? "middle" : "late";
                     const bool asked = image == 0 || image == last / 5 || image == last;
                     ++image;
                     if (!asked) return;
                     std::vector<Vector3d> places_W;
                     const Vector3d unknown = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
                     for (size_t k = 0; k < flight.corners_W.size(); ++k) {
                       places_W.push_back(place_W(map, id_of_corner, k).value_or(unknown));
                     }
                     add_outline(name, edges, places_W, columns);
                   });
  return columns;
}

}  // namespace

std::vector<std::string> landmark_error_columns() {
  return {"t_s",
          "ground_percent",
          "inverse_depth_percent",
          "sample_north_percent",
          "sample_east_percent",
          "sample_altitude_percent"};
}
Columns cube_lateral_errors() { return errors_of(cube_lateral_flight()); }
Columns highrise_lateral_errors() { return errors_of(highrise_lateral_flight()); }
Columns highrise_forward_errors() { return errors_of(highrise_forward_flight()); }

std::vector<std::string> landmark_map_columns() {
  std::vector<std::string> columns;
  for (const std::string when : {"true", "early", "middle", "late"}) {
    for (const std::string axis : {"_north_m", "_east_m", "_altitude_m"}) columns.push_back(when + axis);
  }
  return columns;
}
Columns cube_lateral_map() { return map_of(cube_lateral_flight()); }
Columns highrise_lateral_map() { return map_of(highrise_lateral_flight()); }
Columns highrise_forward_map() { return map_of(highrise_forward_flight()); }

}  // namespace hedgehop::sim
