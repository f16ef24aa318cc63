#pragma once

#include "sim/render/drawing_options.h"
#include "sim/render/gl_functions.h"

namespace hedgehop::sim {

/// A linked program and where its uniforms are (-1 where it has none).
struct Program {
  GLuint id = 0;
  GLint eye_W = -1, eye_low_C = -1, rotation = -1, lens = -1, horizon = -1, zenith = -1, label = -1;
  GLint p_WM = -1, sun_from_W = -1, ambient = -1, sun = -1;  ///< of shadows
};

/// Vertex attributes of all programs but sky_program().
inline constexpr GLuint kPositionAttribute = 0;  ///< p_W, m
inline constexpr GLuint kSurfaceAttribute = 1;   ///< u, v, brightness 0..1, texture layer

/// Textured and lit surfaces, from the bound array of textures: RGB, or the mean of its channels. Each throws
/// std::runtime_error with the compiler's message when it does not compile. With shadows, a SunMap scales the
/// sun's part of the brightness.
Program color_program(const GlFunctions& gl, Shadows shadows);
Program grey_program(const GlFunctions& gl, Shadows shadows);
/// Metric depth: z in C, m.
Program depth_program(const GlFunctions& gl);
/// 1 / z in C, 1/m, and how it changes to the next pixel on the right and below: the surface's own plane.
Program plane_program(const GlFunctions& gl);
/// One integer for all that a call draws.
Program label_program(const GlFunctions& gl);
/// Depth of surfaces as seen from the sun; no colors.
Program sun_map_program(const GlFunctions& gl);
/// The sky behind everything: three vertices without attributes.
Program sky_program(const GlFunctions& gl);

}  // namespace hedgehop::sim
