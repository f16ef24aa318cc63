#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/map/local_plane.h"
#include "scenes/map/town_textures.h"

namespace hedgehop::scenes::map {

/// A street or path of the map.
struct Street {
  std::string name;                      ///< such as "way 12"
  std::vector<Eigen::Vector2d> line_NE;  ///< its middle, m; at least two points, all different from the next
  double width_m = 0.0;
  bool has_lanes = false;  ///< for cars, with sidewalks
};

/// Returns the street of a way; nullopt for a way that is not on the ground (tunnels) or does not exist (proposed).
/// @param[out] faults  receives a line for a way that cannot be drawn, and for each tag that cannot be read.
std::optional<Street> street_of(const OsmLine& line, const LocalPlane& plane, std::vector<std::string>& faults);

/// A triangle of the surface of a street, counter-clockwise seen from above.
struct StreetTriangle {
  std::array<Eigen::Vector2d, 3> p_NE, uv;  ///< in the plan, m; in repeats of the texture
  uint32_t texture = 0;
  double lift_m = 0.0;  ///< height above the ground, so that the street covers it; crossing ones differ by millimeters
};

/// Returns the surfaces of streets: ribbons with mitered bends. They are not obstacles.
std::vector<StreetTriangle> street_surfaces(const std::vector<Street>& streets, const TownTextures& town);

/// Height of the lowest street above the ground, m.
inline constexpr double kStreetLiftM = 0.06;

}  // namespace hedgehop::scenes::map
