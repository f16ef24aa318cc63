#include "vision/motion/cost_rows.h"

#include <algorithm>

#include "vision/flow/wide_integers.h"

namespace hedgehop::vision::motion {

HEDGEHOP_WIDE void blend(const uint8_t* upper, const uint8_t* lower, int weight, int count, int16_t* blended) {
  for (int i = 0; i < count; ++i) blended[i] = static_cast<int16_t>(upper[i] * (kUnit - weight) + lower[i] * weight);
}

HEDGEHOP_WIDE void replace_row(const uint8_t* leaving, const uint8_t* entering, int count, int16_t* sums) {
  for (int i = 0; i < count; ++i) sums[i] = static_cast<int16_t>(sums[i] + entering[i] - leaving[i]);
}

HEDGEHOP_WIDE void absolute_difference(const uint8_t* a, const uint8_t* b, int count, uint8_t* difference) {
  for (int i = 0; i < count; ++i) difference[i] = a[i] > b[i] ? a[i] - b[i] : b[i] - a[i];
}

HEDGEHOP_WIDE void sum_columns(const int16_t* sums, int sides, int count, int16_t* costs) {
  std::fill_n(costs, count, int16_t{0});
  for (int side = -sides; side <= sides; ++side) {
    for (int i = 0; i < count; ++i) costs[i] = static_cast<int16_t>(costs[i] + sums[i + side]);
  }
}

HEDGEHOP_WIDE void keep_smaller(const int16_t* costs, int16_t plane, size_t count, int16_t* best, int16_t* best_plane) {
  for (size_t i = 0; i < count; ++i) {
    best_plane[i] = costs[i] < best[i] ? plane : best_plane[i];
    best[i] = costs[i] < best[i] ? costs[i] : best[i];
  }
}

HEDGEHOP_WIDE void keep_smaller_outside(const int16_t* costs, int16_t plane, size_t count, const int16_t* first,
                                        const int16_t* last, int16_t* second) {
  for (size_t i = 0; i < count; ++i) {
    const int16_t cost = (plane < first[i]) | (plane > last[i]) ? costs[i] : kNoCost;
    second[i] = cost < second[i] ? cost : second[i];
  }
}

}  // namespace hedgehop::vision::motion
