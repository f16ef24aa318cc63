#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

namespace hedgehop::sim {

/// Returns whether the dynamic linker finds a library, without Hedgehop's code.
inline bool is_installed(const char* library) { return dlopen(library, RTLD_LAZY | RTLD_LOCAL) != nullptr; }

}  // namespace hedgehop::sim

/// Skip the rest of a test that needs OSMesa or EGL. After it, SetUp() skips the test.
#define HEDGEHOP_REQUIRE_OSMESA()                       \
  if (!::hedgehop::sim::is_installed("libOSMesa.so.8")) \
  GTEST_SKIP() << "OSMesa is not installed (Debian: apt install libosmesa6)"
#define HEDGEHOP_REQUIRE_EGL()                       \
  if (!::hedgehop::sim::is_installed("libEGL.so.1")) \
  GTEST_SKIP() << "EGL is not installed (Debian: apt install libegl1 libegl-mesa0)"
