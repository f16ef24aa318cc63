#pragma once

namespace hedgehop::sim {

/// How the cameras' pictures are made.
struct DrawingConfig {
  enum class Context { osmesa, egl };
  Context context = Context::osmesa;
};
template <class Visitor>
void describe(Visitor& v, DrawingConfig& c) {
  v("gl", c.context,
    {.choices = {"osmesa", "egl"},
     .meaning = "who draws: Mesa's rasteriser behind OSMesa, or EGL, which takes a GPU where there is one"});
}

}  // namespace hedgehop::sim
