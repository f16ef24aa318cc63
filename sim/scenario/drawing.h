#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "sim/fields/field.h"

namespace hedgehop::sim {

/// A renderer: the implementation that makes the images.
enum class RendererKind {
  osmesa,  ///< OpenGL of Mesa's software rasterizer through OSMesa
  egl,     ///< OpenGL through EGL without a surface: a GPU if available, else Mesa's software rasterizer
  tiles,   ///< Hedgehop's own rasterizer for processors with AVX2
};

inline constexpr std::array<std::string_view, 3> kRendererNames = {"osmesa", "egl", "tiles"};  ///< by RendererKind

/// How the camera images are rendered.
struct DrawingConfig {
  RendererKind renderer = RendererKind::osmesa;
  bool shadows = false;
  std::optional<double> visibility_m;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<DrawingConfig> auto& c) {
  v("renderer", c.renderer,
    {.choices = {kRendererNames.begin(), kRendererNames.end()},
     .meaning = "renderer of the camera images: osmesa (Mesa's software rasterizer), egl (the GPU, if the machine has "
                "one) or tiles (Hedgehop's own, several times faster on a processor with AVX2)"});
  v("shadows", c.shadows,
    {.meaning = "whether static solids cast shadows; flat sheets (ground, a ceiling) and moving objects cast none"});
  v("visibility", c.visibility_m,
    {.unit = "m",
     .at_least = 1.0,
     .meaning = "meteorological optical range in fog or haze: distance at which the contrast has fallen to 5 %; clear "
                "air if not given"});
}

}  // namespace hedgehop::sim
