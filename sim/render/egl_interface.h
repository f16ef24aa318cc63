#pragma once

#include <cstdint>

// The part of EGL that Hedgehop uses: [EGL2014] sec. 3, its registry, and the extensions EGL_EXT_device_enumeration,
// EGL_EXT_device_query, EGL_EXT_platform_base, EGL_EXT_platform_device, EGL_KHR_no_config_context and
// EGL_MESA_platform_surfaceless. A test compares it with Khronos' headers.

namespace hedgehop::sim {

using EGLint = int32_t;
using EGLenum = unsigned int;
using EGLBoolean = unsigned int;
using EGLDisplay = void*;
using EGLConfig = void*;
using EGLContext = void*;
using EGLSurface = void*;
using EGLDeviceEXT = void*;
using EglProc = void (*)();

}  // namespace hedgehop::sim

// X(name without EGL_, value)
#define HEDGEHOP_EGL_CONSTANTS(X)        \
  X(TRUE, 1)                             \
  X(NONE, 0x3038)                        \
  X(EXTENSIONS, 0x3055)                  \
  X(CONTEXT_MAJOR_VERSION, 0x3098)       \
  X(CONTEXT_MINOR_VERSION, 0x30FB)       \
  X(CONTEXT_OPENGL_PROFILE_MASK, 0x30FD) \
  X(CONTEXT_OPENGL_CORE_PROFILE_BIT, 1)  \
  X(OPENGL_API, 0x30A2)                  \
  X(PLATFORM_SURFACELESS_MESA, 0x31DD)   \
  X(PLATFORM_DEVICE_EXT, 0x313F)

// X(result, name without egl, parameters): functions of the library
#define HEDGEHOP_EGL_FUNCTIONS(X)                                                  \
  X(EGLBoolean, BindAPI, (EGLenum))                                                \
  X(EGLContext, CreateContext, (EGLDisplay, EGLConfig, EGLContext, const EGLint*)) \
  X(EGLBoolean, DestroyContext, (EGLDisplay, EGLContext))                          \
  X(EGLContext, GetCurrentContext, ())                                             \
  X(EGLDisplay, GetCurrentDisplay, ())                                             \
  X(EGLint, GetError, ())                                                          \
  X(EglProc, GetProcAddress, (const char*))                                        \
  X(EGLBoolean, Initialize, (EGLDisplay, EGLint*, EGLint*))                        \
  X(EGLBoolean, MakeCurrent, (EGLDisplay, EGLSurface, EGLSurface, EGLContext))     \
  X(const char*, QueryString, (EGLDisplay, EGLint))

// X(result, name without egl, parameters): functions of extensions, which eglGetProcAddress finds
#define HEDGEHOP_EGL_EXTENSION_FUNCTIONS(X)                             \
  X(EGLDisplay, GetPlatformDisplayEXT, (EGLenum, void*, const EGLint*)) \
  X(EGLBoolean, QueryDevicesEXT, (EGLint, EGLDeviceEXT*, EGLint*))      \
  X(const char*, QueryDeviceStringEXT, (EGLDeviceEXT, EGLint))
