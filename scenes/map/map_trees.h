#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "scenes/map/ground.h"
#include "scenes/map/local_plane.h"
#include "scenes/map/town_textures.h"
#include "scenes/mesh/mesh_builder.h"

namespace hedgehop::scenes::map {

/// A tree of the map.
struct MapTree {
  std::string name;  ///< such as "node 12"
  Eigen::Vector2d p_NE = Eigen::Vector2d::Zero();
  double height_m = 0.0;
  double crown_radius_m = 0.0;
};

/// Returns the trees of nodes, and of rows with a tree every 8 m. Tags: `height`, `diameter_crown`.
/// @param seed  of the sizes without tags. @param[out] faults  receives a line for each tag that cannot be read.
std::vector<MapTree> trees_of(const OsmObjects& objects, const LocalPlane& plane, uint64_t seed,
                              std::vector<std::string>& faults);

/// Adds trees to the mesh, in chunks of neighboring ones, and their solids.
/// @param seed  of their shapes. @param[out] faults  receives a line for each tree outside the terrain.
void add_map_trees(std::vector<MapTree> trees, const Ground& ground, const TownTextures& town, uint64_t seed,
                   mesh::MeshBuilder& mesh, std::vector<Solid>& solids, std::vector<std::string>& faults);

}  // namespace hedgehop::scenes::map
