#pragma once

#include <Eigen/Core>

#include "sim/render/gl_functions.h"
#include "sim/render/scene_buffers.h"

namespace hedgehop::sim {

/// Whether what stands between a surface and the sun darkens it.
enum class Shadows { none, sun };

/// The depth of all that stands still as seen from the sun, drawn once: where its light ends.
struct SunMap {
  /// GL_TEXTURE_2D with depths: 1 nearest to the sun, 0 farthest. A comparing sampler gives the share of the light,
  /// 0..1, that reaches a point.
  GLuint texture = 0;
  /// From p_W, m, to the position in the map: column and row, 0..1 from its first texel to its last, and depth.
  Eigen::Matrix4f from_W = Eigen::Matrix4f::Zero();
  double texel_m = 0.0;  ///< side of a texel, across the light
};

/// Draws the map with as many texels as shadows 0.05 m fine need, within 2048 to 4096 a side. Movers and flat chunks
/// cast no shadow: below the ground there is nothing, and a room's ceiling would darken all of it.
/// Needs the scene's vertex array bound; binds the map to texture unit 1.
/// @param to_sun_W  any length but 0. Throws std::runtime_error when the map cannot be created.
SunMap draw_sun_map(const GlFunctions& gl, const SceneBuffers& buffers, const Eigen::Vector3f& to_sun_W);

}  // namespace hedgehop::sim
