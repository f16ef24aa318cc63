#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hedgehop::vision::stereo {

/// Costs along a path, by disparity, of some pixels. Beside each pixel's there is room for what lies beyond the least
/// and the largest disparity.
struct PathCosts {
  PathCosts(int pixels, int disparities);
  void clear();  ///< to zero
  int16_t* at(int pixel) { return costs.data() + kRoom + static_cast<ptrdiff_t>(pixel) * stride; }
  int16_t& least(int pixel) { return leasts[static_cast<size_t>(pixel)]; }

  static constexpr int kRoom = 16;
  /// More than any cost on a path; a step from it is a number of 16 bits still.
  static constexpr int16_t kFar = INT16_MAX - 8 * 13 * 13;
  int stride;
  std::vector<int16_t> costs, leasts;
};

/// A row of an image, on which paths go on.
struct PathRow {
  int width, disparities;        ///< a multiple of 16
  int half;                      ///< pixels of a square to either side of its middle
  int16_t step_cost, leap_cost;  ///< of a disparity that changes along a path, by one and by more
  bool narrow;                   ///< eight disparities at a time, also where the processor can do sixteen
  // By column, then by disparity:
  const int16_t* columns;        ///< costs of pixels above one another
  const int16_t* square_before;  ///< of the square about the column before the first
  int16_t* squares;              ///< costs of squares
  int16_t* sums;                 ///< costs along all paths
};

/// Which disparity is best for a pixel, counted from the first of its costs.
struct Winner {
  int16_t cost, at;
  bool unique;
};

// Paths go on by [Hirschmuller2008] eq. (13): L(p, d) = C(p, d) + min(L(q, d), L(q, d - 1) + step, L(q, d + 1) + step,
// min L(q) + leap) - min L(q), where q is the pixel before p.

/// Sums squares, and the paths from the left, from above and from above on the right.
/// @param from_left  pixels 0 and 1 in turn. @param above, here  of the row above, and of this one.
/// @param from_above_right  one pixel more than the row has, the last zero: of the row above, then of this one.
void walk_right(const PathRow& row, PathCosts& from_left, PathCosts& above, PathCosts& here,
                PathCosts& from_above_right);

/// Adds the paths from the right and from above on the left, and chooses.
/// @param from_right  pixels 0 and 1 in turn. @param from_above_left  one pixel more than the row has, the first zero.
/// @param uniqueness_percent  0 to 99: by which the best sum must beat those not beside it.
/// @param winners  of each pixel: the last of the least sums.
void walk_left(const PathRow& row, PathCosts& from_right, PathCosts& from_above_left, int uniqueness_percent,
               Winner* winners);

}  // namespace hedgehop::vision::stereo
