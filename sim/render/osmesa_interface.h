#pragma once

#include "sim/render/gl_interface.h"

// The part of Mesa's off-screen interface that Hedgehop uses, as Mesa documents it (docs.mesa3d.org/osmesa.html) since
// version 11.2. A test compares it with GL/osmesa.h.

namespace hedgehop::sim {

using OSMesaContext = struct osmesa_context*;
using OSMESAproc = void (*)();

}  // namespace hedgehop::sim

// X(name without OSMESA_, value)
#define HEDGEHOP_OSMESA_CONSTANTS(X) \
  X(FORMAT, 0x22)                    \
  X(DEPTH_BITS, 0x30)                \
  X(STENCIL_BITS, 0x31)              \
  X(ACCUM_BITS, 0x32)                \
  X(PROFILE, 0x33)                   \
  X(CORE_PROFILE, 0x34)              \
  X(CONTEXT_MAJOR_VERSION, 0x36)     \
  X(CONTEXT_MINOR_VERSION, 0x37)     \
  X(RGBA, 0x1908)

// X(result, name without OSMesa, parameters)
#define HEDGEHOP_OSMESA_FUNCTIONS(X)                                          \
  X(OSMesaContext, CreateContextAttribs, (const int*, OSMesaContext))         \
  X(void, DestroyContext, (OSMesaContext))                                    \
  X(OSMesaContext, GetCurrentContext, ())                                     \
  X(GLboolean, MakeCurrent, (OSMesaContext, void*, GLenum, GLsizei, GLsizei)) \
  X(OSMESAproc, GetProcAddress, (const char*))
