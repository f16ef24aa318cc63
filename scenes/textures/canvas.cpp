#include "scenes/textures/canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace hedgehop::scenes::textures {
namespace {

// Where a pixel falls on a periodic lattice: the node before it, the node after it, and the eased way between them.
struct LatticeStep {
  int before;
  int after;
  float way;
};

std::vector<LatticeStep> lattice_steps(int size_px, int cells, double phase) {
  std::vector<LatticeStep> steps;
  for (int i = 0; i < size_px; ++i) {
    const double at = static_cast<double>(i) * cells / size_px + phase;
    const int node = static_cast<int>(at);
    const double t = at - node;
    steps.push_back({node % cells, (node + 1) % cells, static_cast<float>(t * t * (3.0 - 2.0 * t))});
  }
  return steps;
}

void add_value_noise(cv::Mat1f& sum, int cells_u, int cells_v, float strength, Random& random) {
  cv::Mat1f lattice(cells_v, cells_u);
  for (float& node : lattice) node = static_cast<float>(uniform(random, -1.0, 1.0)) * strength;

  // Across first, one row per lattice row; then down. The phases keep the octaves' nodes apart.
  const auto across = lattice_steps(sum.cols, cells_u, uniform(random, 0.0, 1.0));
  cv::Mat1f rows(cells_v, sum.cols);
  for (int r = 0; r < cells_v; ++r) {
    const float* node = lattice[r];
    float* out = rows[r];
    for (int c = 0; c < sum.cols; ++c) {
      const LatticeStep& s = across[static_cast<size_t>(c)];
      out[c] = node[s.before] + s.way * (node[s.after] - node[s.before]);
    }
  }
  const auto down = lattice_steps(sum.rows, cells_v, uniform(random, 0.0, 1.0));
  for (int r = 0; r < sum.rows; ++r) {
    const LatticeStep& s = down[static_cast<size_t>(r)];
    const float *above = rows[s.before], *below = rows[s.after];
    float* out = sum[r];
    for (int c = 0; c < sum.cols; ++c) out[c] += above[c] + s.way * (below[c] - above[c]);
  }
}

// Share of the pixel [i, i + 1) that [low, high) covers.
double coverage(int i, double low, double high) {
  return std::clamp(std::min(high, i + 1.0) - std::max(low, static_cast<double>(i)), 0.0, 1.0);
}

int wrapped(int i, int size) { return ((i % size) + size) % size; }

}  // namespace

cv::Mat1f fractal_noise(int size_px, const NoiseShape& shape, Random& random) {
  cv::Mat1f sum(size_px, size_px, 0.0f);
  int cells_u = shape.cells_u, cells_v = shape.cells_v;
  float strength = 1.0f;
  for (int octave = 0; octave < shape.octaves; ++octave) {
    if (cells_u > size_px || cells_v > size_px) break;
    add_value_noise(sum, cells_u, cells_v, strength, random);
    cells_u *= 2;
    cells_v *= 2;
    strength *= static_cast<float>(shape.gain);
  }

  double mean = 0.0, square = 0.0;
  for (float x : sum) {
    mean += x;
    square += static_cast<double>(x) * x;
  }
  mean /= static_cast<double>(sum.total());
  const double deviation = std::sqrt(square / static_cast<double>(sum.total()) - mean * mean);
  for (float& x : sum) x = static_cast<float>((x - mean) / deviation);
  return sum;
}

Canvas::Canvas(int size_px, double tile_m, const Color& background)
    : tile_m_(tile_m), pixels_(size_px, size_px, background) {}

void Canvas::blend(const Area& area, const Color& color, const Weight& opacity_at) {
  const double px_per_m = size_px() / tile_m_;
  const double left = area.left * px_per_m, right = left + area.width * px_per_m;
  const double top = area.top * px_per_m, bottom = top + area.height * px_per_m;
  for (int r = static_cast<int>(std::floor(top)); r < bottom; ++r) {
    Color* row = pixels_[wrapped(r, size_px())];
    const double rows = coverage(r, top, bottom);
    for (int c = static_cast<int>(std::floor(left)); c < right; ++c) {
      Color& pixel = row[wrapped(c, size_px())];
      const auto edge = static_cast<float>(rows * coverage(c, left, right));
      const float weight = edge * opacity_at((c + 0.5) / px_per_m, (r + 0.5) / px_per_m);
      pixel += (color - pixel) * weight;
    }
  }
}

void Canvas::fill(const Area& area, const Color& color, double opacity) {
  const auto constant = static_cast<float>(opacity);
  blend(area, color, [constant](double, double) { return constant; });
}

void Canvas::fade(const Area& area, const Color& color, double top_opacity, double bottom_opacity) {
  blend(area, color, [&](double, double y) {
    const double way = std::clamp((y - area.top) / area.height, 0.0, 1.0);
    return static_cast<float>(top_opacity + (bottom_opacity - top_opacity) * way);
  });
}

void Canvas::disc(double center_x, double center_y, double radius, const Color& color, double opacity) {
  const double px_per_m = size_px() / tile_m_;
  const double margin = 1.0 / px_per_m;
  const Area box{center_x - radius - margin, center_y - radius - margin, 2.0 * (radius + margin),
                 2.0 * (radius + margin)};
  blend(box, color, [&](double x, double y) {
    const double inside_px = (radius - std::hypot(x - center_x, y - center_y)) * px_per_m + 0.5;
    return static_cast<float>(opacity * std::clamp(inside_px, 0.0, 1.0));
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
  auto n = noise.begin();
  for (Color& pixel : pixels_) pixel *= std::clamp(1.0f + static_cast<float>(strength) * *n++, 0.3f, 1.7f);
}

void Canvas::stain(const cv::Mat1f& noise, double threshold, double softness, const Color& color, double opacity) {
  auto n = noise.begin();
  for (Color& pixel : pixels_) {
    const double way = std::clamp((*n++ - threshold) / softness, 0.0, 1.0);
    pixel += (color - pixel) * static_cast<float>(opacity * way);
  }
}

void Canvas::paint(const std::function<Color(double x, double y)>& color_at) {
  const double m_per_px = tile_m_ / size_px();
  for (int r = 0; r < size_px(); ++r) {
    Color* row = pixels_[r];
    for (int c = 0; c < size_px(); ++c) row[c] = color_at((c + 0.5) * m_per_px, (r + 0.5) * m_per_px);
  }
}

cv::Mat Canvas::finished() const {
  cv::Mat3b image(pixels_.size());
  auto out = image.begin();
  for (const Color& pixel : pixels_) {
    for (int k = 0; k < 3; ++k) {
      (*out)[k] = static_cast<uint8_t>(std::lround(255.0f * std::clamp(pixel[k], 0.0f, 1.0f)));
    }
    ++out;
  }
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
