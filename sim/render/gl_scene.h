#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "scenes/scene.h"
#include "sim/render/gl_functions.h"
#include "sim/render/scene_geometry.h"

namespace hedgehop::sim {

/// Copies the meshes of a scene to the context and leaves them bound: one vertex buffer and one index buffer, so that
/// one call can draw several meshes.
void upload_meshes(const GlFunctions& gl, const SceneGeometry& geometry);

/// Copies textures to the context and leaves them bound: a GL_TEXTURE_2D_ARRAY of RGBA8 on texture unit 0.
void upload_textures(const GlFunctions& gl, const std::vector<cv::Mat>& textures);

/// Draws the map of plan_sun_map() into a GL_TEXTURE_2D of depths and binds it to texture unit 1. A comparing sampler
/// returns the share of sunlight, 0..1, that reaches a point. The scene's vertex array must be bound.
/// @param chunks  of the scene. @param to_sun_W  of any length but 0.
/// @return transformation from p_W, m, to the position in the map, see SunPlan.
/// Throws std::runtime_error if the map cannot be created.
Eigen::Matrix4f draw_sun_map(const GlFunctions& gl, const std::vector<scenes::Chunk>& chunks,
                             const Eigen::Vector3f& to_sun_W);

}  // namespace hedgehop::sim
