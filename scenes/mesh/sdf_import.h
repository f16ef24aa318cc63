#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>

#include "scenes/mesh/mesh_import.h"
#include "scenes/scene.h"

namespace hedgehop::scenes::mesh {

/// Returns whether the suffix is that of SDFormat: .sdf or .world.
bool is_sdf(const std::filesystem::path& file);

/// Adds the models of a world or model in SDFormat to a scene: an instance for each model, the triangles of its visual
/// shapes, and its collision shapes as solids. A level plane at the scene's ground is left out, and other planes are
/// solid over 2 km.
/// @param to_W  from the file's axes (east, north, up).
/// @return the elements that are left out, in one line; empty without them.
/// @throws std::invalid_argument with the reason, without the file's name.
std::string add_sdf(const ImportConfig& config, const Eigen::Affine3d& to_W, Scene& scene);

}  // namespace hedgehop::scenes::mesh
