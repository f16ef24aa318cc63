#pragma once

#include <opencv2/core.hpp>

#include "sim/libm/random.h"

namespace hedgehop::scenes::textures {

using Color = cv::Vec3f;  ///< RGB, 0..1

/// A rectangle of the image, in m from its top left corner.
struct Area {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
};

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

/// A square tileable image to paint on. Shapes wrap around the edges and are antialiased. Lengths are in m on the
/// surface, so that an image has the same appearance at every resolution.
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

  /// Draws a border of width `line` inside `area`.
  void outline(const Area& area, double line, const Color& color, double opacity = 1.0);

  /// Draws a random winding line, such as a crack.
  void crack(double x, double y, double length, double width, const Color& color, double opacity, Random& random);

  /// Multiplies the pixels by 1 + strength * noise, limited to 0.3..1.7.
  void shade(const cv::Mat1f& noise, double strength);

  /// Blends in `color` at pixels whose noise exceeds `threshold`. The opacity rises to `opacity` over `softness`.
  void stain(const cv::Mat1f& noise, double threshold, double softness, const Color& color, double opacity);

  /// Sets the color of each pixel. @param color_at  (double x, double y), in m, -> color.
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

/// Returns the color with each channel multiplied by `factor`.
inline Color scaled(const Color& color, double factor) { return color * static_cast<float>(factor); }

/// Returns a random variation of `color`: all channels are multiplied by one factor within 1 +- spread and each by a
/// factor within 1 +- spread / 4.
Color varied(const Color& color, double spread, Random& random);

}  // namespace hedgehop::scenes::textures
