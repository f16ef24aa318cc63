#pragma once

#include "sim/render/drawing_options.h"
#include "sim/render/gl_functions.h"

namespace hedgehop::sim {

/// A linked program and the locations of its uniforms; -1 if the program lacks the uniform.
struct Program {
  GLuint id = 0;
  GLint camera_W = -1, camera_low_C = -1, rotation = -1, lens = -1, horizon = -1, zenith = -1;
  GLint X_WM = -1, sun_from_W = -1, ambient = -1, sun = -1;  ///< for shadows
};

/// Vertex attributes of all programs but sky_program().
inline constexpr GLuint kPositionAttribute = 0;  ///< p_W, m
inline constexpr GLuint kSurfaceAttribute = 1;   ///< u, v, brightness 0..1, texture layer
inline constexpr GLuint kLabelAttribute = 2;

// Each function throws std::runtime_error with the message of the compiler if the program does not compile.

/// Lit surfaces with the bound array of textures: RGB, or the mean of the channels. With shadows, the map of
/// draw_sun_map() scales the sun's part of the brightness.
Program color_program(const GlFunctions& gl, Shadows shadows);
Program grey_program(const GlFunctions& gl, Shadows shadows);
/// Metric depth: z in C, m.
Program depth_program(const GlFunctions& gl);
/// Raster::planes.
Program plane_program(const GlFunctions& gl);
/// Raster::labels.
Program label_program(const GlFunctions& gl);
/// Depth seen from the sun; no colors.
Program sun_map_program(const GlFunctions& gl);
/// The sky in the background: three vertices without attributes.
Program sky_program(const GlFunctions& gl);

}  // namespace hedgehop::sim
