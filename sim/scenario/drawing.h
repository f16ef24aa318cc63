#pragma once

namespace hedgehop::sim {

/// How the cameras' images are made.
struct DrawingConfig {
  enum class Context { osmesa, egl };
  Context context = Context::osmesa;
  bool shadows = false;
};
template <class Visitor>
void describe(Visitor& v, DrawingConfig& c) {
  v("gl", c.context,
    {.choices = {"osmesa", "egl"},
     .meaning = "who draws: Mesa's rasterizer behind OSMesa, or EGL, which takes a GPU where there is one"});
  v("shadows", c.shadows,
    {.meaning =
         "whether what stands still shades all from the sun; flat sheets (ground, a ceiling) and movers cast none"});
}

}  // namespace hedgehop::sim
