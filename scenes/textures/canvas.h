#pragma once

#include <opencv2/core.hpp>

#include "sim/libm/random.h"

namespace hedgehop::scenes::textures {

using Color = cv::Vec3f;  ///< RGB, 0..1

/// A rectangle of the image, in meters from its top left corner.
struct Area {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
};

/// Spectrum of a noise image: value noise on lattices of `cells_u` x `cells_v`, then twice as many, `octaves` times,
/// each `gain` times as strong as the one before.
struct NoiseShape {
  int cells_u = 4;
  int cells_v = 4;
  int octaves = 7;
  double gain = 0.75;
};

/// Returns tileable noise with mean 0 and standard deviation 1. Lattices finer than the pixels are left out.
cv::Mat1f fractal_noise(int size_px, const NoiseShape& shape, Random& random);

/// A square, tileable image under the brush. Everything wraps around the edges, edges are antialiased, and lengths
/// are meters on the surface, so that an image looks alike at any resolution.
class Canvas {
 public:
  Canvas(int size_px, double tile_m, const Color& background);
  Canvas(const Canvas& other) : tile_m_(other.tile_m_), pixels_(other.pixels_.clone()) {}
  Canvas& operator=(const Canvas&) = delete;

  int size_px() const { return pixels_.rows; }
  double tile_m() const { return tile_m_; }

  void fill(const Area& area, const Color& color, double opacity = 1.0);
  void fade(const Area& area, const Color& color, double top_opacity, double bottom_opacity);
  void disc(double center_x, double center_y, double radius, const Color& color, double opacity = 1.0);

  /// Draws the outline of `area`, `line` wide, inside of it.
  void outline(const Area& area, double line, const Color& color, double opacity = 1.0);

  /// Draws a wandering dark line, as of a crack.
  void crack(double x, double y, double length, double width, const Color& color, double opacity, Random& random);

  /// Multiplies by 1 + strength * noise, within 0.3..1.7.
  void shade(const cv::Mat1f& noise, double strength);

  /// Blends in `color` where the noise exceeds `threshold`: opacity grows to `opacity` over `softness`.
  void stain(const cv::Mat1f& noise, double threshold, double softness, const Color& color, double opacity);

  /// Gives each pixel a color from its place in meters. @param color_at  of (double x, double y).
  template <class ColorAt>
  void paint(const ColorAt& color_at) {
    const double m_per_px = tile_m_ / size_px();
    for (int r = 0; r < size_px(); ++r) {
      Color* row = pixels_[r];
      for (int c = 0; c < size_px(); ++c) row[c] = color_at((c + 0.5) * m_per_px, (r + 0.5) * m_per_px);
    }
  }

  /// Returns the image, CV_8UC3 RGB.
  cv::Mat finished() const;

 private:
  template <class OpacityAt>
  void blend(const Area& area, const Color& color, const OpacityAt& opacity_at);

  double tile_m_;
  cv::Mat3f pixels_;
};

/// Returns the color, each channel times `factor`.
inline Color scaled(const Color& color, double factor) { return color * static_cast<float>(factor); }

/// Returns a color near `color`: all channels times one random factor within 1 +- spread, and each a little by
/// itself.
Color varied(const Color& color, double spread, Random& random);

}  // namespace hedgehop::scenes::textures
