#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "scenes/map/ground.h"
#include "scenes/map/local_plane.h"
#include "scenes/map/town_textures.h"
#include "scenes/mesh/mesh_builder.h"

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

/// Adds the surfaces of streets: ribbons on the ground, in chunks of neighboring pieces. They are not obstacles.
void add_streets(const std::vector<Street>& streets, const Ground& ground, const TownTextures& town,
                 mesh::MeshBuilder& mesh);

/// Height of streets above the ground, so that they cover it, m. Crossing streets differ by millimeters.
inline constexpr double kStreetLiftM = 0.06;

}  // namespace hedgehop::scenes::map
