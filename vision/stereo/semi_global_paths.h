#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hedgehop::vision::stereo {

/// Costs along a path for a number of pixels, by disparity. There is padding for reads beyond the minimum and maximum
/// disparity.
struct PathCosts {
  PathCosts(int pixels, int disparities);
  void clear();  ///< sets all costs to zero
  int16_t* at(int pixel) { return costs.data() + kPadding + static_cast<ptrdiff_t>(pixel) * stride; }

  static constexpr int kPadding = 16;
  /// Above all costs on a path; a step from it still fits 16 bits.
  static constexpr int16_t kFar = INT16_MAX - 8 * 13 * 13;
  int stride;
  std::vector<int16_t> costs, minima;
};

/// Parameters and buffers for one image row.
struct PathRow {
  int width, disparities;        ///< a multiple of 16
  int half;                      ///< pixels of a block on each side of its center
  int16_t step_cost, leap_cost;  ///< for disparity changes along a path of one and of more
  bool narrow;                   ///< process eight disparities at a time, even with AVX2
  // Indexed by column, then by disparity:
  const int16_t* columns;        ///< costs summed over the rows of a block
  const int16_t* square_before;  ///< of the block around the column before the first
  int16_t* squares;              ///< costs of blocks
  int16_t* sums;                 ///< costs summed over all paths
};

/// Index of the best disparity of a pixel and its cost.
struct Winner {
  int16_t cost, at;
  bool unique;
};

// Path costs by [Hirschmuller2008] eq. (13): L(p, d) = C(p, d) + min(L(q, d), L(q, d - 1) + step, L(q, d + 1) + step,
// min L(q) + leap) - min L(q), with q the previous pixel of p.

/// Sums the costs of blocks and of the paths from the left, from above and from the upper right.
/// @param from_left  two alternating pixels. @param above, here  of the previous and the current row.
/// @param from_above_right  one pixel more than the row, the last one zero; previous row on input, current row on
/// output.
void walk_right(const PathRow& row, PathCosts& from_left, PathCosts& above, PathCosts& here,
                PathCosts& from_above_right);

/// Adds the costs of the paths from the right and from the upper left, and selects the best disparities.
/// @param from_right  two alternating pixels. @param from_above_left  one pixel more than the row, the first one zero.
/// @param uniqueness_percent  0 to 99: required margin of the best sum over those of non-adjacent disparities.
/// @param winners  for each pixel the last one of the minimum sums.
void walk_left(const PathRow& row, PathCosts& from_right, PathCosts& from_above_left, int uniqueness_percent,
               Winner* winners);

}  // namespace hedgehop::vision::stereo
