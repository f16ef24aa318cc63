#pragma once

#include "sim/render/gl_interface.h"

namespace hedgehop::sim {

#define HEDGEHOP_GL_CONSTANT(NAME, VALUE) inline constexpr int GL_##NAME = VALUE;
HEDGEHOP_GL_CONSTANTS(HEDGEHOP_GL_CONSTANT)
#undef HEDGEHOP_GL_CONSTANT

/// The OpenGL functions of a context. Hedgehop does not link to a GL library.
struct GlFunctions {
#define HEDGEHOP_GL_MEMBER(RESULT, NAME, PARAMETERS) RESULT(*NAME) PARAMETERS = nullptr;
  HEDGEHOP_GL_FUNCTIONS(HEDGEHOP_GL_MEMBER)
#undef HEDGEHOP_GL_MEMBER
};

/// Returns the table of functions.
/// @param address  returns the entry point for a name, or null. @param library  its name, for messages.
/// Throws std::runtime_error that names the library and the function if a function is missing.
GlFunctions load_gl(void (*(*address)(const char* name))(), const char* library);

/// Throws std::runtime_error with the code if an OpenGL error is pending.
/// @param activity  for the message, such as "drawing".
void check_gl(const GlFunctions& gl, const char* activity);

}  // namespace hedgehop::sim
