#pragma once

#include "sim/render/tiles/frame.h"
#include "sim/render/tiles/scene_view.h"
#include "sim/render/tiles/simd.h"

namespace hedgehop::sim::tiles {
namespace {

/// The edges of a facet. Each edge is an affine function of the pixel in integers, >= 0 inside. The functions of two
/// facets at a common edge differ in sign only, so that each pixel belongs to exactly one of them.
struct Edges {
  L4 at_first;     ///< at pixel (0, 0)
  L4 right, down;  ///< change per eighth of a pixel, below 2^24
};

/// Bounds of the pixels that a facet may cover, both ends included.
struct Extent {
  int left, right, top, bottom;
};

struct FacetSetUp {
  Edges edges;
  Extent extent;
  Surface surface;
  float nearest, farthest;  ///< bounds of 1 / z, 1/m; nearest is infinite if a corner is behind the near plane
};

inline D4 load(const float a[4]) { return D4{a[0], a[1], a[2], a[3]}; }
inline D4 next(D4 a) { return __builtin_shufflevector(a, a, 1, 2, 3, 0); }

struct Corners {
  D4 x, y, z;  ///< in C, m
};

inline Corners in_camera(const FacetShape& shape, const ViewPose& pose) {
  const D4 x = load(shape.x_m) - pose.p_m[0], y = load(shape.y_m) - pose.p_m[1], z = load(shape.z_m) - pose.p_m[2];
  const double* r = pose.R_CW;
  return {r[0] * x + r[1] * y + r[2] * z, r[3] * x + r[4] * y + r[5] * z, r[6] * x + r[7] * y + r[8] * z};
}

/// Rounds edges to integers. The larger slope is between 2^23 and 2^24. A pixel on an edge belongs to exactly one side.
inline Edges quantized(D4 a, D4 b, D4 c) {
  const D4 larger = maximum(magnitude(a), magnitude(b));
  // 2^(23 - exponent), from the bits of the exponent. An eighth of a pixel is a power of two, too.
  const L4 exponent = reinterpret_cast<L4>(larger) >> 52;
  const D4 scale = reinterpret_cast<D4>((2046 + 23 - exponent) << 52);
  const L4 none = larger == 0.0;             // two equal corners, or an edge at infinity
  const D4 limit = all(1125899906842624.0);  // 2^50, far outside any image
  const D4 finite = maximum(minimum(c * scale * 8.0, limit), -limit);
  const D4 constant = pick(none, pick(c < 0.0, -limit, limit), finite);
  const L4 right = integers(pick(none, D4{}, a * scale)), down = integers(pick(none, D4{}, b * scale));
  const L4 inclusive = (right > 0) | ((right == 0) & (down > 0));
  return {integers(constant) + ~inclusive, right, down};
}

/// Minimum and maximum of four numbers.
struct DoubleRange {
  double min, max;
};
inline DoubleRange range(D4 a) {
  const D4 other = __builtin_shufflevector(a, a, 2, 3, 0, 1);
  const D4 low = minimum(a, other), high = maximum(a, other);
  return {low[0] < low[1] ? low[0] : low[1], high[0] > high[1] ? high[0] : high[1]};
}

/// Returns the bounds of the pixels between corners that are all in front of the near plane.
inline Extent extent_of(const Corners& p, D4 per_z, const PinholeImage& lens, double margin_px) {
  const DoubleRange u = range(lens.center_u_px + lens.focal_x_px * (p.x * per_z));
  const DoubleRange v = range(lens.center_v_px + lens.focal_y_px * (p.y * per_z));
  // Rounded edges are up to 1e-4 px away from the corners. The bounds include that.
  const double margin = margin_px + 1e-3;
  const auto first = [&](double a, double end) {
    a -= margin;
    if (!(a > 0.0)) return 0;
    if (a > end) return static_cast<int>(end) + 1;
    const int floor = static_cast<int>(a);
    return floor + (a > floor);
  };
  const auto last = [&](double a, double end) {
    a += margin;
    if (!(a >= 0.0)) return -1;
    return a > end ? static_cast<int>(end) : static_cast<int>(a);
  };
  const double last_u = lens.width_px - 1, last_v = lens.height_px - 1;
  return {first(u.min, last_u), last(u.max, last_u), first(v.min, last_v), last(v.max, last_v)};
}

/// Returns the bounds of a facet that crosses the near plane: between the corners in front of the plane and the
/// intersections of the edges with the plane.
inline Extent extent_at_near_plane(const Corners& p, const PinholeImage& lens, double near_m, double margin_px) {
  Extent whole{lens.width_px, -1, lens.height_px, -1};
  for (int i = 0; i < 4; ++i) {
    const int k = (i + 1) % 4;
    Corners ends{all(p.x[i]), all(p.y[i]), all(p.z[i])};
    if (p.z[i] < near_m && p.z[k] < near_m) continue;
    const double share = (near_m - p.z[i]) / (p.z[k] - p.z[i]);
    if ((p.z[i] < near_m) != (p.z[k] < near_m)) {
      const int behind = p.z[i] < near_m ? 0 : 1;
      const double x = p.x[i] + share * (p.x[k] - p.x[i]), y = p.y[i] + share * (p.y[k] - p.y[i]);
      ends = {behind == 0 ? D4{x, x, p.x[k], p.x[k]} : D4{p.x[i], p.x[i], x, x},
              behind == 0 ? D4{y, y, p.y[k], p.y[k]} : D4{p.y[i], p.y[i], y, y},
              behind == 0 ? D4{near_m, near_m, p.z[k], p.z[k]} : D4{p.z[i], p.z[i], near_m, near_m}};
    }
    const Extent part = extent_of(ends, 1.0 / ends.z, lens, margin_px);
    whole.left = part.left < whole.left ? part.left : whole.left;
    whole.right = part.right > whole.right ? part.right : whole.right;
    whole.top = part.top < whole.top ? part.top : whole.top;
    whole.bottom = part.bottom > whole.bottom ? part.bottom : whole.bottom;
  }
  return whole;
}

/// Sets up a facet for an image. Returns whether it faces the camera and may cover a pixel.
/// @param margin_px  maximum distance of a sample from the center of its pixel.
inline bool set_up(const FacetShape& shape, const ViewPose& pose, const PinholeImage& lens, double near_m,
                   double margin_px, FacetSetUp& out) {
  const Corners p = in_camera(shape, pose);
  const DoubleRange z = range(p.z);
  if (z.max < near_m) return false;
  const bool cut = z.min < near_m;
  const D4 per_z = 1.0 / p.z;
  out.extent = cut ? extent_at_near_plane(p, lens, near_m, margin_px) : extent_of(p, per_z, lens, margin_px);
  if (out.extent.left > out.extent.right || out.extent.top > out.extent.bottom) return false;

  const Corners n{next(p.x), next(p.y), next(p.z)};
  // next x this: positive inside, because corners are counter-clockwise from outside. Facets on both sides of an edge
  // compute the same products.
  const D4 ex = n.y * p.z - n.z * p.y, ey = n.z * p.x - n.x * p.z, ez = n.x * p.y - n.y * p.x;
  const double volume = ex[0] * p.x[2] + ey[0] * p.y[2] + ez[0] * p.z[2];
  if (!(volume > 0.0)) return false;

  const D4 a = ex * lens.per_focal_x, b = ey * lens.per_focal_y;
  out.edges = quantized(a, b, ez - a * lens.center_u_px - b * lens.center_v_px);

  // Normal of the plane, from the same products.
  const double nx = ex[0] + ex[1] + (p.y[0] * p.z[2] - p.z[0] * p.y[2]);
  const double ny = ey[0] + ey[1] + (p.z[0] * p.x[2] - p.x[0] * p.z[2]);
  const double nz = ez[0] + ez[1] + (p.x[0] * p.y[2] - p.y[0] * p.x[2]);
  const double per_volume = 1.0 / volume;
  Affine& w = out.surface.w;
  w.right = nx * per_volume * lens.per_focal_x;
  w.down = ny * per_volume * lens.per_focal_y;
  w.at_origin = nz * per_volume - w.right * lens.center_u_px - w.down * lens.center_v_px;
  const DoubleRange w_range = range(per_z);
  out.farthest = static_cast<float>(cut ? 1.0 / z.max : w_range.min);
  out.nearest = cut ? __builtin_inff() : static_cast<float>(w_range.max);
  return true;
}

}  // namespace
}  // namespace hedgehop::sim::tiles
