#include "sim/render/tiles/occlusion.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::sim::tiles {

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
  const auto tile = [](double px, int tiles) {
    return static_cast<int>(std::clamp(px / kTilePx, 0.0, static_cast<double>(tiles - 1)));
  };
  const int first = tile(left - kSparePx, frame.across), last = tile(right + kSparePx, frame.across);
  const int upper = tile(top - kSparePx, frame.down), lower = tile(bottom + kSparePx, frame.down);
  const auto nearest = static_cast<float>((1.0 + kSpareShare) / nearest_m);
  for (int grid = 0; grid < frame.samples; ++grid) {
    for (int row = upper; row <= lower; ++row) {
      const Tile* const tiles = frame.tiles + (static_cast<size_t>(grid) * static_cast<size_t>(frame.down) +
                                               static_cast<size_t>(row)) * static_cast<size_t>(frame.across);
      for (int column = first; column <= last; ++column) {
        if (!(tiles[column].farthest > nearest)) return false;
      }
    }
  }
  return true;
}

}  // namespace hedgehop::sim::tiles
