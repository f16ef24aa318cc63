#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/map/ground.h"
#include "scenes/map/streets.h"
#include "scenes/mesh/mesh_builder.h"

namespace hedgehop::scenes::map {

/// Adds the part of a street that lies over a triangle of the ground to a list of vertices and faces.
/// @param ground_W  counter-clockwise seen from above.
void drape(const StreetTriangle& street, const std::array<Eigen::Vector3d, 3>& ground_W, std::vector<Vertex>& vertices,
           std::vector<std::array<uint32_t, 3>>& faces);

/// Adds the surface of the ground with streets on it, and the solids of a terrain. Blocks of a terrain have a coarse
/// far detail, with the streets on it. @param half_m  of the plane, if there is no terrain. @param grass  texture.
void add_ground_mesh(const Ground& ground, const std::vector<StreetTriangle>& streets, double half_m, uint32_t grass,
                     mesh::MeshBuilder& mesh, std::vector<Solid>& solids);

}  // namespace hedgehop::scenes::map
