#include "scenes/textures/canvas.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>
#include <vector>

namespace hedgehop::scenes::textures {
namespace {

// Returns the share of the pixel [i, i + 1) that [low, high) covers.
double coverage(int i, double low, double high) {
  return std::clamp(std::min(high, i + 1.0) - std::max(low, static_cast<double>(i)), 0.0, 1.0);
}

int wrapped(int i, int size) { return ((i % size) + size) % size; }

}  // namespace

Canvas::Canvas(int size_px, double tile_m, const Color& background)
    : size_px_(size_px),
      tile_m_(tile_m),
      pixels_(static_cast<size_t>(size_px) * static_cast<size_t>(size_px), pixel_of(background)) {}

std::vector<double> Canvas::pixel_centers_m() const {
  std::vector<double> centers_m;
  const double m_per_px = tile_m_ / size_px_;
  for (int i = 0; i < size_px_; ++i) centers_m.push_back((i + 0.5) * m_per_px);
  return centers_m;
}

template <class BlendRow>
void Canvas::blend(const Area& area, const BlendRow& blend_row) {
  const double px_per_m = size_px_ / tile_m_;
  const double left = area.left * px_per_m, right = left + area.width * px_per_m;
  const double top = area.top * px_per_m, bottom = top + area.height * px_per_m;
  for (int r = static_cast<int>(std::floor(top)); r < bottom; ++r) {
    blend_row(row(wrapped(r, size_px_)), (r + 0.5) / px_per_m, Covered{left, right, coverage(r, top, bottom)});
  }
}

template <class OpacityAt>
void Canvas::blend_even(const Area& area, const Color& color, const OpacityAt& opacity_at) {
  const Pixel paint = pixel_of(color);
  blend(area, [&](Pixel* pixels, double y, const Covered& covered) {
    const float opacity = opacity_at(y);
    const auto blend_edge = [&](int c) {
      const float weight = static_cast<float>(covered.rows * coverage(c, covered.left, covered.right)) * opacity;
      Pixel& pixel = pixels[wrapped(c, size_px_)];
      pixel += (paint - pixel) * weight;
    };
    // The pixels between the two edges are covered completely.
    const int first = static_cast<int>(std::floor(covered.left)), last = static_cast<int>(std::ceil(covered.right)) - 1;
    if (first <= last) blend_edge(first);
    const float weight = static_cast<float>(covered.rows) * opacity;
    for (int c = first + 1; c < last;) {
      const int at = wrapped(c, size_px_), count = std::min(last - c, size_px_ - at);
      for (Pixel& pixel : std::span(pixels + at, static_cast<size_t>(count))) pixel += (paint - pixel) * weight;
      c += count;
    }
    if (first < last) blend_edge(last);
  });
}

void Canvas::fill(const Area& area, const Color& color, double opacity) {
  blend_even(area, color, [opacity](double) { return static_cast<float>(opacity); });
}

void Canvas::fade(const Area& area, const Color& color, double top_opacity, double bottom_opacity) {
  blend_even(area, color, [&](double y) {
    const double way = std::clamp((y - area.top) / area.height, 0.0, 1.0);
    return static_cast<float>(top_opacity + (bottom_opacity - top_opacity) * way);
  });
}

void Canvas::disc(double center_x, double center_y, double radius, const Color& color, double opacity) {
  const double px_per_m = size_px_ / tile_m_;
  const double margin = 1.0 / px_per_m;
  const Area box{center_x - radius - margin, center_y - radius - margin, 2.0 * (radius + margin),
                 2.0 * (radius + margin)};
  // Pixels clearly inside or outside need no square root. The edge is one pixel wide.
  const double slack = 0.51 * margin;
  const double whole = std::max(0.0, radius - slack), none = radius + slack;
  const Pixel paint = pixel_of(color);
  blend(box, [&](Pixel* pixels, double y, const Covered& covered) {
    const double y2 = (y - center_y) * (y - center_y);
    for (int c = static_cast<int>(std::floor(covered.left)); c < covered.right; ++c) {
      const double x = (c + 0.5) / px_per_m;
      const double distance2 = (x - center_x) * (x - center_x) + y2;
      if (distance2 > none * none) continue;
      double inside = 1.0;
      if (distance2 >= whole * whole) {
        inside = std::clamp((radius - std::hypot(x - center_x, y - center_y)) * px_per_m + 0.5, 0.0, 1.0);
      }
      const auto edge = static_cast<float>(covered.rows * coverage(c, covered.left, covered.right));
      Pixel& pixel = pixels[wrapped(c, size_px_)];
      pixel += (paint - pixel) * (edge * static_cast<float>(opacity * inside));
    }
  });
}

void Canvas::outline(const Area& area, double line, const Color& color, double opacity) {
  fill({area.left, area.top, area.width, line}, color, opacity);
  fill({area.left, area.top + area.height - line, area.width, line}, color, opacity);
  fill({area.left, area.top + line, line, area.height - 2.0 * line}, color, opacity);
  fill({area.left + area.width - line, area.top + line, line, area.height - 2.0 * line}, color, opacity);
}

void Canvas::crack(double x, double y, double length, double width, const Color& color, double opacity,
                   Random& random) {
  double heading = uniform(random, 0.0, 2.0 * std::numbers::pi);
  for (double way = 0.0; way < length; way += 0.7 * width) {
    disc(x, y, 0.5 * width, color, opacity);
    heading += uniform(random, -0.35, 0.35);
    x += 0.7 * width * std::cos(heading);
    y += 0.7 * width * std::sin(heading);
  }
}

void Canvas::shade(const cv::Mat1f& noise, double strength) {
  const auto by = static_cast<float>(strength);
  std::vector<float> factors(static_cast<size_t>(size_px_));
  for (int r = 0; r < size_px_; ++r) {
    const float* const n = noise[r];
    for (size_t c = 0; c < factors.size(); ++c) factors[c] = std::clamp(1.0f + by * n[c], 0.3f, 1.7f);
    Pixel* const pixels = row(r);
    for (size_t c = 0; c < factors.size(); ++c) pixels[c] *= factors[c];
  }
}

void Canvas::stain(const cv::Mat1f& noise, double threshold, double softness, const Color& color, double opacity) {
  const Pixel paint = pixel_of(color);
  std::vector<float> weights(static_cast<size_t>(size_px_));
  for (int r = 0; r < size_px_; ++r) {
    const float* const n = noise[r];
    for (size_t c = 0; c < weights.size(); ++c) {
      weights[c] = static_cast<float>(opacity * std::clamp((n[c] - threshold) / softness, 0.0, 1.0));
    }
    Pixel* const pixels = row(r);
    for (size_t c = 0; c < weights.size(); ++c) pixels[c] += (paint - pixels[c]) * weights[c];
  }
}

cv::Mat Canvas::finished() const {
  using Levels [[gnu::vector_size(16)]] = int32_t;
  const Pixel none{}, full = none + 1.0f;
  cv::Mat3b image(size_px_, size_px_);
  uint8_t* out = image[0]->val;
  const auto bytes_of = [&](const Pixel& pixel) {
    // Rounds like std::lround, because the fraction above an integer is exact.
    const Pixel above = pixel > none ? pixel : none, level = 255.0f * (above < full ? above : full);
    const Levels whole = __builtin_convertvector(level, Levels);
    const Levels rounded = whole - (level - __builtin_convertvector(whole, Pixel) >= 0.5f);  // true is -1
    return static_cast<uint32_t>(rounded[0] | rounded[1] << 8 | rounded[2] << 16);
  };
  // Four bytes at a time, the last of which the next pixel overwrites.
  for (size_t i = 0; i + 1 < pixels_.size(); ++i, out += 3) {
    const uint32_t bytes = bytes_of(pixels_[i]);
    std::memcpy(out, &bytes, sizeof bytes);
  }
  const uint32_t last = bytes_of(pixels_.back());
  std::memcpy(out, &last, 3);
  return image;
}

Color varied(const Color& color, double spread, Random& random) {
  const double all = uniform(random, 1.0 - spread, 1.0 + spread);
  Color result;
  for (int k = 0; k < 3; ++k) {
    result[k] = color[k] * static_cast<float>(all * uniform(random, 1.0 - 0.25 * spread, 1.0 + 0.25 * spread));
  }
  return result;
}

}  // namespace hedgehop::scenes::textures
