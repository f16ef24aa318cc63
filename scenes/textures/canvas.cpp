#include "scenes/textures/canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

namespace hedgehop::scenes::textures {
namespace {

// Position of a pixel on a periodic lattice: the previous node, the next node, and the eased weight of the next one.
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

// Value noise on one lattice, computed row by row. Keeps the two adjacent lattice rows, interpolated across the image.
class Octave {
 public:
  Octave(int size_px, int cells_u, int cells_v, float strength, Random& random) : lattice_(cells_v, cells_u) {
    for (float& node : lattice_) node = static_cast<float>(uniform(random, -1.0, 1.0)) * strength;
    // Random phases separate the nodes of the octaves.
    across_ = lattice_steps(size_px, cells_u, uniform(random, 0.0, 1.0));
    down_ = lattice_steps(size_px, cells_v, uniform(random, 0.0, 1.0));
    above_.resize(across_.size());
    below_.resize(across_.size());
  }

  void add_row(int r, float* sum) {
    const LatticeStep& s = down_[static_cast<size_t>(r)];
    if (s.before != row_) {
      if (s.before == next_) std::swap(above_, below_);
      if (s.before != next_) spread(s.before, above_);
      spread(s.after, below_);
      row_ = s.before;
      next_ = s.after;
    }
    const float *above = above_.data(), *below = below_.data(), way = s.way;
    for (size_t c = 0; c < across_.size(); ++c) sum[c] += above[c] + way * (below[c] - above[c]);
  }

 private:
  void spread(int row, std::vector<float>& line) const {
    const float* node = lattice_[row];
    float* out = line.data();
    for (const LatticeStep& s : across_) *out++ = node[s.before] + s.way * (node[s.after] - node[s.before]);
  }

  cv::Mat1f lattice_;
  std::vector<LatticeStep> across_, down_;
  std::vector<float> above_, below_;
  int row_ = -1, next_ = -1;  ///< lattice rows in above_ and below_
};

// Adds numbers and their squares to two sums in a fixed order, which makes the result reproducible.
std::pair<double, double> with_moments(const float* numbers, int count, double sum, double squares) {
  for (int i = 0; i < count; ++i) {
    sum += numbers[i];
    squares += static_cast<double>(numbers[i]) * numbers[i];
  }
  return {sum, squares};
}

// Returns the share of the pixel [i, i + 1) that [low, high) covers.
double coverage(int i, double low, double high) {
  return std::clamp(std::min(high, i + 1.0) - std::max(low, static_cast<double>(i)), 0.0, 1.0);
}

int wrapped(int i, int size) { return ((i % size) + size) % size; }

}  // namespace

cv::Mat1f fractal_noise(int size_px, const NoiseShape& shape, Random& random) {
  std::vector<Octave> octaves;
  int cells_u = shape.cells_u, cells_v = shape.cells_v;
  float strength = 1.0f;
  for (int octave = 0; octave < shape.octaves; ++octave) {
    if (cells_u > size_px || cells_v > size_px) break;
    octaves.emplace_back(size_px, cells_u, cells_v, strength, random);
    cells_u *= 2;
    cells_v *= 2;
    strength *= static_cast<float>(shape.gain);
  }

  // Row by row, so that a row remains in the processor's cache while the octaves are added.
  cv::Mat1f sum(size_px, size_px, 0.0f);
  double mean = 0.0, square = 0.0;
  for (int r = 0; r < size_px; ++r) {
    float* row = sum[r];
    for (Octave& octave : octaves) octave.add_row(r, row);
    std::tie(mean, square) = with_moments(row, size_px, mean, square);
  }
  mean /= static_cast<double>(sum.total());
  const double deviation = std::sqrt(square / static_cast<double>(sum.total()) - mean * mean);
  for (int r = 0; r < size_px; ++r) {
    float* row = sum[r];
    for (int c = 0; c < size_px; ++c) row[c] = static_cast<float>((row[c] - mean) / deviation);
  }
  return sum;
}

Canvas::Canvas(int size_px, double tile_m, const Color& background)
    : tile_m_(tile_m), pixels_(size_px, size_px, background) {}

template <class OpacityAt>
void Canvas::blend(const Area& area, const Color& color, const OpacityAt& opacity_at) {
  const double px_per_m = size_px() / tile_m_;
  const double left = area.left * px_per_m, right = left + area.width * px_per_m;
  const double top = area.top * px_per_m, bottom = top + area.height * px_per_m;
  for (int r = static_cast<int>(std::floor(top)); r < bottom; ++r) {
    Color* row = pixels_[wrapped(r, size_px())];
    const double rows = coverage(r, top, bottom);
    const int first = static_cast<int>(std::floor(left));
    int at = wrapped(first, size_px());
    for (int c = first; c < right; ++c, at = at + 1 == size_px() ? 0 : at + 1) {
      Color& pixel = row[at];
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
  // Pixels clearly inside or outside need no square root.
  const double whole = std::max(0.0, radius - margin), none = radius + margin;
  blend(box, color, [&](double x, double y) {
    const double distance2 = (x - center_x) * (x - center_x) + (y - center_y) * (y - center_y);
    if (distance2 < whole * whole) return static_cast<float>(opacity);
    if (distance2 > none * none) return 0.0f;
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
  const auto by = static_cast<float>(strength);
  for (int r = 0; r < size_px(); ++r) {
    const float* n = noise[r];
    Color* row = pixels_[r];
    for (int c = 0; c < size_px(); ++c) row[c] *= std::clamp(1.0f + by * n[c], 0.3f, 1.7f);
  }
}

void Canvas::stain(const cv::Mat1f& noise, double threshold, double softness, const Color& color, double opacity) {
  for (int r = 0; r < size_px(); ++r) {
    const float* n = noise[r];
    Color* row = pixels_[r];
    for (int c = 0; c < size_px(); ++c) {
      const double way = std::clamp((n[c] - threshold) / softness, 0.0, 1.0);
      row[c] += (color - row[c]) * static_cast<float>(opacity * way);
    }
  }
}

cv::Mat Canvas::finished() const {
  cv::Mat3b image(pixels_.size());
  for (int r = 0; r < size_px(); ++r) {
    const float* from = pixels_[r]->val;
    uint8_t* to = image[r]->val;
    for (int i = 0; i < 3 * size_px(); ++i) {
      // Rounds like std::lround, because the fraction above an integer is exact.
      const float level = 255.0f * std::clamp(from[i], 0.0f, 1.0f);
      const int whole = static_cast<int>(level);
      to[i] = static_cast<uint8_t>(whole + (level - static_cast<float>(whole) >= 0.5f ? 1 : 0));
    }
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
