#pragma once

#include <vector>

namespace hedgehop::vision::flow {

/// Rows or columns [begin, end) of a patch.
struct PatchRange {
  int begin = 0, end = 0;
  /// Pixel coordinate of the middle.
  double center() const { return 0.5 * (begin + end - 1); }
};

/// Patches of an image: every row range with every column range.
struct PatchGrid {
  std::vector<PatchRange> rows, cols;
};

/// Returns evenly spaced square patches, mirrored about the image's middle, that stay out of its rim.
/// @param alignment_px  rows begin and end at multiples of it, columns at multiples of twice as much, >= 1; `patch_px`
///                      and the spacing are rounded to that.
/// Throws std::invalid_argument when the patches do not fit.
PatchGrid make_patch_grid(int rows, int cols, int patch_px, int margin_px, int alignment_px, int width_px,
                          int height_px);

/// The same patches on the image reduced `reduction` times, columns at even pixels.
/// @param width_px, height_px  of the reduced image.  @param first_row_px  row of the full image it begins at.
PatchGrid reduce_patch_grid(const PatchGrid& grid, int reduction, int first_row_px, int width_px, int height_px);

}  // namespace hedgehop::vision::flow
