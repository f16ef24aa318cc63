#pragma once

#include <optional>

namespace hedgehop::sim {

/// How the cameras' images are made.
struct DrawingConfig {
  enum class Context { osmesa, egl, tiles };

  /// What the environment variable HEDGEHOP_GL names, for scenarios that name none: osmesa where it is not set. Read
  /// once. Throws InputError when it names none.
  static Context usual_context();

  Context context = usual_context();
  bool shadows = false;
  std::optional<double> visibility_m;
};
template <class Visitor>
void describe(Visitor& v, DrawingConfig& c) {
  v("context", c.context,
    {.choices = {"osmesa", "egl", "tiles"},
     .meaning = "who draws: Mesa's rasterizer behind OSMesa; EGL, which takes a GPU where there is one; or tiles, "
                "Hedgehop's own, several times faster on a processor with AVX2"});
  v("shadows", c.shadows,
    {.meaning =
         "whether what stands still shades all from the sun; flat sheets (ground, a ceiling) and movers cast none"});
  v("visibility", c.visibility_m,
    {.unit = "m",
     .at_least = 1.0,
     .meaning =
         "in fog or haze: the distance at which contrast has fallen to 5 % (meteorological optical range); the air "
         "is clear when not given"});
}

}  // namespace hedgehop::sim
