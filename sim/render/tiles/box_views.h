#pragma once

#include "sim/render/tiles/occlusion.h"

namespace hedgehop::sim::tiles {
namespace {

/// Eight boxes relative to the camera, axes of W.
struct RelativeBoxes {
  F8 low_m[3], high_m[3];
  F8 size_m;  ///< bound of the distance of the corners

  explicit RelativeBoxes(const BoxCamera& camera, const EightBoxes& boxes) : size_m{} {
    for (int i = 0; i < 3; ++i) {
      const auto from_eye = [&](const float(&at)[8]) {
        F8 numbers;
        std::memcpy(&numbers, at, sizeof(numbers));
        return (numbers - camera.eye_m[i]) - camera.eye_rest_m[i];
      };
      low_m[i] = from_eye(boxes.low_m[i]);
      high_m[i] = from_eye(boxes.high_m[i]);
      size_m += maximum(magnitude(low_m[i]), magnitude(high_m[i]));
    }
  }

  /// Returns the minimum or maximum of n . p over the corners of each box.
  F8 lowest(const float (&n)[3]) const {
    return minimum(n[0] * low_m[0], n[0] * high_m[0]) + minimum(n[1] * low_m[1], n[1] * high_m[1]) +
           minimum(n[2] * low_m[2], n[2] * high_m[2]);
  }
  F8 highest(const float (&n)[3]) const {
    return maximum(n[0] * low_m[0], n[0] * high_m[0]) + maximum(n[1] * low_m[1], n[1] * high_m[1]) +
           maximum(n[2] * low_m[2], n[2] * high_m[2]);
  }
};

// Bounds of boxes from float operations, whose error relative to z is at most `share`.
inline float sample_margin_px(const Frame& frame) { return frame.samples == 1 ? 0.01f : 0.385f; }
/// Returns upper bounds of 1 / z. @param nearest_m  min z of boxes.
inline F8 reciprocal(F8 nearest_m, F8 share) { return (1.0f + 1e-5f + share) / nearest_m; }

/// Intervals of pixel columns or rows, both ends included; empty if last < first.
struct PixelIntervals {
  I8 first, last;

  /// The pixels between low and high. @param size  of the image, px.
  PixelIntervals(F8 low, F8 high, int size) {
    const F8 end = all(static_cast<float>(size));
    const F8 from = minimum(maximum(low, F8{}), end), to = maximum(minimum(high, end - 1.0f), all(-1.0f)) + 1.0f;
    first = __builtin_convertvector(from, I8);
    first -= floats(first) < from;
    last = __builtin_convertvector(to, I8) - 1;
  }
};

/// As Kernels::see.
inline uint32_t see(const Frame& frame, const BoxCamera& camera, const EightBoxes& boxes, uint32_t lanes,
                    bool behind_facets, EightViews& views) {
  const RelativeBoxes relative(camera, boxes);
  const float(&R_CW)[3][3] = camera.R_CW;
  I8 inside = relative.highest(R_CW[2]) + kFloatError * relative.size_m >= camera.near_m;
  for (int side = 0; side < 4; ++side) {
    inside &= relative.highest(camera.sides[side]) + camera.side_errors[side] * relative.size_m >= 0.0f;
  }
  const uint32_t within = lanes & signs(inside);
  if (within == 0) return 0;

  F8 distance2{};
  for (int i = 0; i < 2; ++i) {
    const F8 gap = maximum(maximum(relative.low_m[i], -relative.high_m[i]), F8{});
    distance2 += gap * gap;
  }
  std::memcpy(views.distance2_m2, &distance2, sizeof(distance2));

  // The corners in the image, corner by corner.
  const F8 nearest_m = relative.lowest(R_CW[2]);
  const I8 crosses = nearest_m < camera.near_m;
  F8 left = all(__builtin_inff()), right = -left, top = left, bottom = -left;
  for (int corner = 0; corner < 8; ++corner) {
    const F8 x = (corner & 1) != 0 ? relative.high_m[0] : relative.low_m[0];
    const F8 y = (corner & 2) != 0 ? relative.high_m[1] : relative.low_m[1];
    const F8 z = (corner & 4) != 0 ? relative.high_m[2] : relative.low_m[2];
    const auto component_C = [&](int row) { return R_CW[row][0] * x + R_CW[row][1] * y + R_CW[row][2] * z; };
    const F8 per_z = 1.0f / pick(crosses, all(1.0f), component_C(2));
    const F8 u = component_C(0) * per_z, v = component_C(1) * per_z;
    left = minimum(left, u);
    right = maximum(right, u);
    top = minimum(top, v);
    bottom = maximum(bottom, v);
  }
  const F8 share = kFloatError * relative.size_m / pick(crosses, all(1.0f), nearest_m);
  const auto lines = [&](F8 low, F8 high, float focal, float center, int size) {
    const F8 margin = sample_margin_px(frame) + share * focal;
    return PixelIntervals((low * focal + center) - margin, (high * focal + center) + margin, size);
  };
  const PixelIntervals columns = lines(left, right, camera.focal_px[0], camera.center_px[0], frame.lens.width_px);
  const PixelIntervals rows = lines(top, bottom, camera.focal_px[1], camera.center_px[1], frame.lens.height_px);
  const uint32_t crossing = signs(crosses);
  uint32_t seen = within & (crossing | ~signs((columns.last < columns.first) | (rows.last < rows.first)));
  const F8 nearest = pick(crosses, all(__builtin_inff()), reciprocal(nearest_m, share));
  for (uint32_t left_over = seen; left_over != 0; left_over &= left_over - 1) {
    const int i = __builtin_ctz(left_over);
    PixelBox& box = views.pixels[i];
    box = {columns.first[i], columns.last[i], rows.first[i], rows.last[i], nearest[i]};
    if ((crossing >> i & 1) != 0) {
      box = {0, 0, 0, 0, nearest[i]};  // always seen
    } else if (!behind_facets && hides_pixels(frame, box)) {
      seen &= ~(1u << i);
    }
  }
  return seen;
}

}  // namespace
}  // namespace hedgehop::sim::tiles
