// The declarations of OpenGL, EGL and OSMesa agree with the headers of Khronos and Mesa, if these are installed.
// Compilation is the test.
#include <gtest/gtest.h>

#if __has_include(<GL/glcorearb.h>) && __has_include(<EGL/eglext.h>) && __has_include(<GL/osmesa.h>)
#define GL_GLEXT_PROTOTYPES
#define EGL_EGLEXT_PROTOTYPES
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>
#include <GL/osmesa.h>

#include <type_traits>

#include "sim/render/egl_interface.h"
#include "sim/render/gl_interface.h"
#include "sim/render/osmesa_interface.h"

namespace {

using EglProc = hedgehop::sim::EglProc;

template <class A, class B>
constexpr bool kSame = std::is_same_v<A, B>;

#define HEDGEHOP_TYPE(NAME) static_assert(kSame<::NAME, hedgehop::sim::NAME>);
HEDGEHOP_TYPE(GLenum)
HEDGEHOP_TYPE(GLbitfield)
HEDGEHOP_TYPE(GLuint)
HEDGEHOP_TYPE(GLint)
HEDGEHOP_TYPE(GLsizei)
HEDGEHOP_TYPE(GLboolean)
HEDGEHOP_TYPE(GLubyte)
HEDGEHOP_TYPE(GLchar)
HEDGEHOP_TYPE(GLfloat)
HEDGEHOP_TYPE(GLsizeiptr)
HEDGEHOP_TYPE(OSMESAproc)
HEDGEHOP_TYPE(EGLint)
HEDGEHOP_TYPE(EGLenum)
HEDGEHOP_TYPE(EGLBoolean)
HEDGEHOP_TYPE(EGLDisplay)
HEDGEHOP_TYPE(EGLConfig)
HEDGEHOP_TYPE(EGLContext)
HEDGEHOP_TYPE(EGLSurface)
HEDGEHOP_TYPE(EGLDeviceEXT)

#define HEDGEHOP_GL_VALUE(NAME, VALUE) static_assert(GL_##NAME == VALUE);
#define HEDGEHOP_EGL_VALUE(NAME, VALUE) static_assert(EGL_##NAME == VALUE);
#define HEDGEHOP_OSMESA_VALUE(NAME, VALUE) static_assert(OSMESA_##NAME == VALUE);
HEDGEHOP_GL_CONSTANTS(HEDGEHOP_GL_VALUE)
HEDGEHOP_EGL_CONSTANTS(HEDGEHOP_EGL_VALUE)
HEDGEHOP_OSMESA_CONSTANTS(HEDGEHOP_OSMESA_VALUE)

#define HEDGEHOP_GL_FUNCTION(RESULT, NAME, PARAMETERS) static_assert(kSame<decltype(&gl##NAME), RESULT(*) PARAMETERS>);
#define HEDGEHOP_EGL_FUNCTION(RESULT, NAME, PARAMETERS) \
  static_assert(kSame<decltype(&egl##NAME), RESULT(*) PARAMETERS>);
#define HEDGEHOP_OSMESA_FUNCTION(RESULT, NAME, PARAMETERS) \
  static_assert(kSame<decltype(&OSMesa##NAME), RESULT(*) PARAMETERS>);
HEDGEHOP_GL_FUNCTIONS(HEDGEHOP_GL_FUNCTION)
HEDGEHOP_EGL_FUNCTIONS(HEDGEHOP_EGL_FUNCTION)
HEDGEHOP_EGL_EXTENSION_FUNCTIONS(HEDGEHOP_EGL_FUNCTION)
HEDGEHOP_OSMESA_FUNCTIONS(HEDGEHOP_OSMESA_FUNCTION)

TEST(GlDeclarations, AgreeWithTheInstalledHeaders) {}

}  // namespace
#else
TEST(GlDeclarations, AgreeWithTheInstalledHeaders) {
  GTEST_SKIP() << "OpenGL's headers are not installed (Debian: apt install libosmesa6-dev libegl-dev)";
}
#endif
