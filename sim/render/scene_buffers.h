#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "sim/render/gl_functions.h"
#include "sim/render/scene_geometry.h"

namespace hedgehop::sim {

/// Copies a scene to a context's memory and leaves it bound: one vertex and one index buffer, so that one call draws
/// any of its meshes, and a GL_TEXTURE_2D_ARRAY of RGBA8 on texture unit 0.
/// @param textures  a scene's.
void upload(const GlFunctions& gl, const SceneGeometry& geometry, const std::vector<cv::Mat>& textures);

}  // namespace hedgehop::sim
