#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/libm/random.h"

namespace hedgehop::scenes::textures {

using Color = cv::Vec3f;  ///< RGB, 0..1

/// A rectangle of the image, in m from its top left corner.
struct Area {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
};

/// A square tileable image to paint on. Shapes wrap around the edges and are antialiased. Lengths are in m on the
/// surface, so that an image has the same appearance at every resolution.
class Canvas {
 public:
  Canvas(int size_px, double tile_m, const Color& background);

  int size_px() const { return size_px_; }
  double tile_m() const { return tile_m_; }

  void fill(const Area& area, const Color& color, double opacity = 1.0);
  void fade(const Area& area, const Color& color, double top_opacity, double bottom_opacity);
  void disc(double center_x, double center_y, double radius, const Color& color, double opacity = 1.0);

  /// Draws a border of width `line` inside `area`.
  void outline(const Area& area, double line, const Color& color, double opacity = 1.0);

  /// Draws a random winding line, such as a crack.
  void crack(double x, double y, double length, double width, const Color& color, double opacity, Random& random);

  /// Multiplies the pixels by 1 + strength * noise, limited to 0.3..1.7.
  void shade(const cv::Mat1f& noise, double strength);

  /// Blends in `color` at pixels whose noise exceeds `threshold`. The opacity rises to `opacity` over `softness`.
  void stain(const cv::Mat1f& noise, double threshold, double softness, const Color& color, double opacity);

  /// Returns the position of the center of each column or row, m.
  std::vector<double> pixel_centers_m() const;

  /// Sets the color of each pixel. @param color_at  (size_t row, size_t column) -> color.
  template <class ColorAt>
  void paint(const ColorAt& color_at) {
    const auto size = static_cast<size_t>(size_px_);
    for (size_t r = 0; r < size; ++r) {
      for (size_t c = 0; c < size; ++c) pixels_[r * size + c] = pixel_of(color_at(r, c));
    }
  }

  /// Returns the image, CV_8UC3 RGB.
  cv::Mat finished() const;

 private:
  using Pixel [[gnu::vector_size(16)]] = float;  ///< R, G, B and 0: one operation works on all channels

  static Pixel pixel_of(const Color& color) { return Pixel{color[0], color[1], color[2], 0.0f}; }
  Pixel* row(int r) { return pixels_.data() + static_cast<ptrdiff_t>(r) * size_px_; }

  /// The part of a row of pixels that an area covers.
  struct Covered {
    double left, right;  ///< px
    double rows;         ///< share of the row's height, 0..1
  };
  template <class BlendRow>
  void blend(const Area& area, const BlendRow& blend_row);
  template <class OpacityAt>
  void blend_even(const Area& area, const Color& color, const OpacityAt& opacity_at);

  int size_px_;
  double tile_m_;
  std::vector<Pixel> pixels_;
};

/// Returns the color with each channel multiplied by `factor`.
inline Color scaled(const Color& color, double factor) { return color * static_cast<float>(factor); }

/// Returns a random variation of `color`: all channels are multiplied by one factor within 1 +- spread and each by a
/// factor within 1 +- spread / 4.
Color varied(const Color& color, double spread, Random& random);

/// Spectrum of a noise image: `octaves` layers of value noise. The first lattice has `cells_u` x `cells_v` cells; each
/// further layer doubles the number of cells in both directions and multiplies the amplitude by `gain`.
struct NoiseShape {
  int cells_u = 4;
  int cells_v = 4;
  int octaves = 7;
  double gain = 0.75;
};

/// Returns tileable noise with mean 0 and standard deviation 1. Lattices finer than the pixels are omitted.
cv::Mat1f fractal_noise(int size_px, const NoiseShape& shape, Random& random);

}  // namespace hedgehop::scenes::textures
