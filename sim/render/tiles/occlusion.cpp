#include "sim/render/tiles/occlusion.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::sim::tiles {

namespace {

/// Pixels of a tile between bounds.
uint64_t within(double left, double right, double top, double bottom, int column, int row) {
  const auto bits = [](double low, double high) {  // of eight in a line
    const int first = static_cast<int>(std::clamp(std::ceil(low), 0.0, 8.0));
    const int end = static_cast<int>(std::clamp(std::floor(high) + 1.0, 0.0, 8.0));
    return end > first ? (1u << end) - (1u << first) : 0u;
  };
  const uint32_t columns = bits(left - kTilePx * column, right - kTilePx * column);
  const uint32_t rows = bits(top - kTilePx * row, bottom - kTilePx * row);
  uint64_t pixels = 0;
  for (int y = 0; y < kTilePx; ++y) pixels |= (rows >> y & 1) != 0 ? uint64_t{columns} << kTilePx * y : 0;
  return pixels;
}

/// Whether all of a tile's pixels that are asked for show something nearer. @param nearest  1 / z of what may be
/// hidden.
bool hides(const Frame& frame, const Tile& tile, uint64_t asked, float nearest) {
  if ((asked & ~tile.covered) != 0) return false;
  const Layer* const layer = layers(frame, tile);
  for (uint16_t i = 0; i < tile.count; ++i) {
    if ((layer[i].pixels & asked) != 0 && !(layer[i].farthest > nearest)) return false;
  }
  return true;
}

}  // namespace

bool hides(const Frame& frame, const Eye& eye, const Eigen::AlignedBox3f& box, double near_m) {
  const Lens& lens = frame.lens;
  const double* r = eye.R_CW;
  double nearest_m = INFINITY, left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
  for (int corner = 0; corner < 8; ++corner) {
    const auto side = [&](int axis) {
      return static_cast<double>((corner >> axis & 1) != 0 ? box.max()[axis] : box.min()[axis]) - eye.p_m[axis];
    };
    const double x = side(0), y = side(1), z = side(2);
    const double z_C = r[6] * x + r[7] * y + r[8] * z;
    if (z_C < near_m) return false;
    const double u = (r[0] * x + r[1] * y + r[2] * z) / z_C * lens.focal_x_px + lens.center_u_px;
    const double v = (r[3] * x + r[4] * y + r[5] * z) / z_C * lens.focal_y_px + lens.center_v_px;
    nearest_m = std::min(nearest_m, z_C);
    left = std::min(left, u), right = std::max(right, u);
    top = std::min(top, v), bottom = std::max(bottom, v);
  }
  constexpr double kSparePx = 1.0, kSpareShare = 1e-5;
  const auto index = [](double px, int tiles) {
    return static_cast<int>(std::clamp(px / kTilePx, 0.0, static_cast<double>(tiles - 1)));
  };
  const int first = index(left - kSparePx, frame.across), last = index(right + kSparePx, frame.across);
  const int upper = index(top - kSparePx, frame.down), lower = index(bottom + kSparePx, frame.down);
  const auto nearest = static_cast<float>((1.0 + kSpareShare) / nearest_m);
  for (int grid = 0; grid < frame.samples; ++grid) {
    for (int row = upper; row <= lower; ++row) {
      const Tile* const tiles =
          frame.tiles + (static_cast<size_t>(grid) * static_cast<size_t>(frame.down) + static_cast<size_t>(row)) *
                            static_cast<size_t>(frame.across);
      for (int column = first; column <= last; ++column) {
        const Tile& tile = tiles[column];
        if (tile.farthest > nearest) continue;
        const uint64_t asked =
            within(left - kSparePx, right + kSparePx, top - kSparePx, bottom + kSparePx, column, row);
        if (!hides(frame, tile, asked, nearest)) return false;
      }
    }
  }
  return true;
}

}  // namespace hedgehop::sim::tiles
