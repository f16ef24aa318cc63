#pragma once

#include <Eigen/Core>
#include <span>

#include "scenes/mesh/cut.h"
#include "scenes/scene.h"

namespace hedgehop::scenes::mesh {

/// Returns the triangles with textures that hold the colors of their corners, linearly interpolated. The textures are
/// added to the scene. @param colors  one per vertex, sRGB, 0..1.
Triangles colored(const Triangles& triangles, std::span<const Eigen::Vector3f> colors, Scene& scene);

}  // namespace hedgehop::scenes::mesh
