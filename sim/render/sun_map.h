#pragma once

#include <Eigen/Core>
#include <vector>

#include "scenes/scene.h"
#include "sim/render/gl_functions.h"

namespace hedgehop::sim {

/// Draws what plan_sun_map() plans, as a GL_TEXTURE_2D with depths that it binds to texture unit 1: a comparing sampler
/// gives the share of the sun's light, 0..1, that reaches a point. Needs the scene's vertex array bound.
/// @param chunks  of the scene. @param to_sun_W  any length but 0.
/// @return from p_W, m, to the position in the map, see SunPlan.
/// Throws std::runtime_error when the map cannot be created.
Eigen::Matrix4f draw_sun_map(const GlFunctions& gl, const std::vector<scenes::Chunk>& chunks,
                             const Eigen::Vector3f& to_sun_W);

}  // namespace hedgehop::sim
