#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/textures/canvas.h"
#include "scenes/textures/surface_patterns.h"

/// Compares every value with the same arithmetic pixel by pixel, because textures and flights must not change.
namespace hedgehop::scenes::textures {
namespace {

float eased(double at, int& node) {
  node = static_cast<int>(at);
  const double t = at - node;
  return static_cast<float>(t * t * (3.0 - 2.0 * t));
}

/// Noise computed one octave after another over the complete image.
cv::Mat1f plain_noise(int size_px, const NoiseShape& shape, Random& random) {
  cv::Mat1f sum(size_px, size_px, 0.0f);
  float strength = 1.0f;
  for (int octave = 0; octave < shape.octaves; ++octave) {
    const int cells_u = shape.cells_u << octave, cells_v = shape.cells_v << octave;
    if (cells_u > size_px || cells_v > size_px) break;
    cv::Mat1f lattice(cells_v, cells_u);
    for (float& node : lattice) node = static_cast<float>(uniform(random, -1.0, 1.0)) * strength;
    const double phase_u = uniform(random, 0.0, 1.0), phase_v = uniform(random, 0.0, 1.0);
    for (int r = 0; r < size_px; ++r) {
      int row = 0, col = 0;
      const float way_v = eased(static_cast<double>(r) * cells_v / size_px + phase_v, row);
      for (int c = 0; c < size_px; ++c) {
        const float way_u = eased(static_cast<double>(c) * cells_u / size_px + phase_u, col);
        const auto across = [&](int at) {
          const float *node = lattice[at % cells_v], from = node[col % cells_u];
          return from + way_u * (node[(col + 1) % cells_u] - from);
        };
        sum(r, c) += across(row) + way_v * (across(row + 1) - across(row));
      }
    }
    strength *= static_cast<float>(shape.gain);
  }
  double mean = 0.0, square = 0.0;
  for (const float x : sum) {
    mean += x;
    square += static_cast<double>(x) * x;
  }
  mean /= static_cast<double>(sum.total());
  const double deviation = std::sqrt(square / static_cast<double>(sum.total()) - mean * mean);
  for (float& x : sum) x = static_cast<float>((x - mean) / deviation);
  return sum;
}

TEST(CanvasExact, NoiseEqualsTheSumOfItsOctaves) {
  for (const NoiseShape& shape : {NoiseShape{}, NoiseShape{3, 5, 9, 0.8}, NoiseShape{64, 16, 5, 1.0}}) {
    for (const int size_px : {64, 200}) {
      Random a(7), b(7);
      const cv::Mat1f noise = fractal_noise(size_px, shape, a), plain = plain_noise(size_px, shape, b);
      EXPECT_EQ(cv::norm(noise, plain, cv::NORM_INF), 0.0);
      EXPECT_EQ(a(), b());
    }
  }
}

uint8_t rounded(float level) { return static_cast<uint8_t>(std::lround(255.0f * std::clamp(level, 0.0f, 1.0f))); }

TEST(CanvasExact, LevelsAreRoundedHalfAwayFromZero) {
  // Every half-way level, its neighbors on both sides, and values out of range.
  std::vector<float> levels = {-0.5f, -0.0f, 0.0f, 1.0f, 1.5f};
  for (int k = 0; k < 255; ++k) {
    const float half = (static_cast<float>(k) + 0.5f) / 255.0f;
    for (const float level : {half, std::nextafter(half, 0.0f), std::nextafter(half, 1.0f)}) levels.push_back(level);
  }
  for (const float level : levels) {
    const cv::Mat image = Canvas(4, 1.0, {level, 0.5f * level, 0.0f}).finished();
    EXPECT_EQ(image.at<cv::Vec3b>(3, 2), cv::Vec3b(rounded(level), rounded(0.5f * level), 0)) << level;
  }
}

TEST(CanvasExact, ShadeStainAndDiscEqualAPixelByPixelComputation) {
  constexpr int kSizePx = 96;
  constexpr double kTileM = 3.0, kPxPerM = kSizePx / kTileM;
  const Color ground{0.4f, 0.5f, 0.6f}, rust{0.7f, 0.2f, 0.1f}, oil{0.05f, 0.1f, 0.02f};
  Random random(3);
  const cv::Mat1f noise = fractal_noise(kSizePx, {}, random);
  for (int trial = 0; trial < 40; ++trial) {
    const double x = uniform(random, 1.0, 2.0), y = uniform(random, 1.0, 2.0), radius = uniform(random, 0.005, 0.9);
    Canvas canvas(kSizePx, kTileM, ground);
    canvas.shade(noise, 0.4);
    canvas.stain(noise, 0.2, 1.3, rust, 0.7);
    canvas.disc(x, y, radius, oil, 0.8);
    const cv::Mat image = canvas.finished();
    for (int r = 0; r < kSizePx; ++r) {
      for (int c = 0; c < kSizePx; ++c) {
        Color pixel = ground * std::clamp(1.0f + 0.4f * noise(r, c), 0.3f, 1.7f);
        const double way = std::clamp((noise(r, c) - 0.2) / 1.3, 0.0, 1.0);
        pixel += (rust - pixel) * static_cast<float>(0.7 * way);
        const double away_m = std::hypot((c + 0.5) / kPxPerM - x, (r + 0.5) / kPxPerM - y);
        const double inside = std::clamp((radius - away_m) * kPxPerM + 0.5, 0.0, 1.0);
        pixel += (oil - pixel) * static_cast<float>(0.8 * inside);
        ASSERT_EQ(image.at<cv::Vec3b>(r, c), cv::Vec3b(rounded(pixel[0]), rounded(pixel[1]), rounded(pixel[2])));
      }
    }
  }
}

/// Returns the share of [i, i + 1) that [low, high) covers.
double covered(int i, double low, double high) {
  return std::clamp(std::min(high, i + 1.0) - std::max(low, static_cast<double>(i)), 0.0, 1.0);
}

int wrapped(int i) { return ((i % 64) + 64) % 64; }

TEST(CanvasExact, FillAndFadeEqualAPixelByPixelComputation) {
  constexpr int kSizePx = 64;
  constexpr double kTileM = 2.0, kPxPerM = kSizePx / kTileM;
  const Color ground{0.4f, 0.5f, 0.6f}, rust{0.7f, 0.2f, 0.1f};
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    // Areas across the edges of the image, wider than it, thinner than a pixel and on its grid.
    const double grid = trial % 4 == 0 ? 1.0 / kPxPerM : 1e-6;
    const auto on_grid = [&](double length_m) { return std::round(length_m / grid) * grid; };
    const double width_m = trial % 3 == 0 ? uniform(random, 0.0, 0.04) : uniform(random, 0.0, 2.5);
    const Area area{on_grid(uniform(random, -1.0, 2.0)), on_grid(uniform(random, -1.0, 2.0)), on_grid(width_m),
                    on_grid(uniform(random, 0.0, 2.0))};
    const double upper = uniform(random, 0.0, 1.0), lower = trial % 2 == 0 ? upper : uniform(random, 0.0, 1.0);
    Canvas canvas(kSizePx, kTileM, ground);
    if (trial % 2 == 0) {
      canvas.fill(area, rust, upper);
    } else {
      canvas.fade(area, rust, upper, lower);
    }

    cv::Mat3f plain(kSizePx, kSizePx, ground);
    const double left = area.left * kPxPerM, right = left + area.width * kPxPerM;
    const double top = area.top * kPxPerM, bottom = top + area.height * kPxPerM;
    for (int r = static_cast<int>(std::floor(top)); r < bottom; ++r) {
      for (int c = static_cast<int>(std::floor(left)); c < right; ++c) {
        const double way = std::clamp(((r + 0.5) / kPxPerM - area.top) / area.height, 0.0, 1.0);
        const auto opacity = static_cast<float>(trial % 2 == 0 ? upper : upper + (lower - upper) * way);
        const auto edge = static_cast<float>(covered(r, top, bottom) * covered(c, left, right));
        Color& pixel = plain(wrapped(r), wrapped(c));
        pixel += (rust - pixel) * (edge * opacity);
      }
    }
    const cv::Mat3b image = canvas.finished();
    for (int r = 0; r < kSizePx; ++r) {
      for (int c = 0; c < kSizePx; ++c) {
        const Color& pixel = plain(r, c);
        ASSERT_EQ(image(r, c), cv::Vec3b(rounded(pixel[0]), rounded(pixel[1]), rounded(pixel[2]))) << trial;
      }
    }
  }
}

/// Returns the share of a pixel covered by the joints at the multiples of a period.
float in_joint(double at_m, double pixel_m, double period_m, double joint_m) {
  const double from_joint_m = std::abs(at_m - period_m * std::round(at_m / period_m));
  const double overlap_m = 0.5 * (joint_m + pixel_m) - from_joint_m;
  return static_cast<float>(std::clamp(overlap_m / pixel_m, 0.0, std::min(1.0, joint_m / pixel_m)));
}

TEST(CanvasExact, MasonryHasTheToneAndJointOfEachPixel) {
  constexpr int kSizePx = 96;
  constexpr double kTileM = 3.0, kPixelM = kTileM / kSizePx;
  const Color block{0.6f, 0.3f, 0.2f}, joint{0.7f, 0.7f, 0.6f};
  for (const Masonry& masonry : {Masonry{7, 9, 0.05, 0.3, 0.5}, Masonry{32, 4, 0.008, 0.2, 0.0}}) {
    Canvas canvas(kSizePx, kTileM, {});
    Random random(5), again(5);
    paint_masonry(canvas, masonry, block, joint, random);
    std::vector<Color> tones;
    for (int k = 0; k < masonry.rows * masonry.columns; ++k) tones.push_back(varied(block, masonry.spread, again));
    const double width_m = kTileM / masonry.columns, height_m = kTileM / masonry.rows;
    const cv::Mat3b image = canvas.finished();
    for (int r = 0; r < kSizePx; ++r) {
      for (int c = 0; c < kSizePx; ++c) {
        const double x = (c + 0.5) * kPixelM, y = (r + 0.5) * kPixelM;
        const int row = std::min(static_cast<int>(y / height_m), masonry.rows - 1);
        const double shifted = x + (row % 2 == 1 ? masonry.bond * width_m : 0.0);
        const int column = static_cast<int>(shifted / width_m) % masonry.columns;
        const Color& tone = tones[static_cast<size_t>(row * masonry.columns + column)];
        const float share = std::max(in_joint(shifted, kPixelM, width_m, masonry.joint_m),
                                     in_joint(y, kPixelM, height_m, masonry.joint_m));
        const Color pixel = tone + (joint - tone) * share;
        ASSERT_EQ(image(r, c), cv::Vec3b(rounded(pixel[0]), rounded(pixel[1]), rounded(pixel[2])));
      }
    }
  }
}

}  // namespace
}  // namespace hedgehop::scenes::textures
