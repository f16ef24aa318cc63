#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hedgehop::vision::flow {

/// Rows or columns [begin, end) of a patch.
struct PatchRange {
  int begin = 0, end = 0;
  /// Returns the pixel coordinate of the center.
  double center() const { return 0.5 * (begin + end - 1); }
};

/// Patches of an image: all combinations of row and column ranges.
struct PatchGrid {
  std::vector<PatchRange> rows, cols;
};

/// Returns evenly spaced square patches, symmetric about the image's center, outside a border of `margin_px`.
/// @param alignment_px  rows begin and end at its multiples, columns at multiples of twice its value, >= 1; `patch_px`
///                      and the spacing are rounded accordingly.
/// Throws std::invalid_argument if the patches do not fit.
PatchGrid make_patch_grid(int rows, int cols, int patch_px, int margin_px, int alignment_px, int width_px,
                          int height_px);

/// Returns the same patches on an image reduced by `reduction`, with columns at even pixels.
/// @param width_px, height_px  of the reduced image.  @param first_row_px  its first row in the full image.
PatchGrid reduce_patch_grid(const PatchGrid& grid, int reduction, int first_row_px, int width_px, int height_px);

/// Sums of products of images over a grid of equal, possibly overlapping patches, in exact integers. The cost per pixel
/// does not depend on patch size or overlap: columns are summed downwards, stored at the first and last rows of
/// patches, and summed horizontally once per row of patches.
class PatchSums {
 public:
  /// @param rows, cols  patches; column ranges begin and end at even pixels.
  /// @param padded_width  a multiple of 8.  @param channels  number of sums.
  /// Throws std::invalid_argument on odd columns or ranges outside the image.
  PatchSums(std::span<const PatchRange> rows, std::span<const PatchRange> cols, int padded_width, int height,
            int channels);

  /// Returns the first required row and the row after the last one.
  int first_row() const { return boundaries_.front(); }
  int end_row() const { return boundaries_.back(); }
  /// Returns the columns of all patches, extended to multiples of 8.
  PatchRange columns() const { return {2 * first_pair_, 2 * end_pair_}; }

  /// Restarts at first_row().
  void begin();
  /// Adds products of the current row, reading only columns(). The sums of a patch's columns must fit 31 bits:
  /// 2 * |a| * |b| * patch height < 2^31.
  void add(int channel, const int16_t* a, const int16_t* b);
  /// Moves to the next row. The sums are complete after the row before end_row().
  void next_row();
  /// Returns the sum over the patch at (row, col), after the last row.
  int64_t sum(int channel, int row, int col) const { return sums_[index(channel, row, col)]; }

 private:
  size_t index(int channel, int row, int col) const {
    return (static_cast<size_t>(channel) * rows_.size() + static_cast<size_t>(row)) * cols_.size() +
           static_cast<size_t>(col);
  }
  void keep_columns();
  void sum_sideways();

  std::vector<PatchRange> rows_, cols_;  ///< rows: indices of boundaries; columns: pairs of pixels
  int pairs_, channels_;
  int first_pair_ = 0, end_pair_ = 0;  ///< pairs of pixels that belong to patches
  std::vector<int> boundaries_;        ///< image rows at which patches begin or end, increasing
  int row_ = 0;                        ///< the current image row
  size_t next_boundary_ = 0;
  std::vector<int32_t> columns_;   ///< channels x pairs: running sums, wrapping
  std::vector<int32_t> kept_;      ///< boundaries x channels x pairs
  std::vector<int64_t> sideways_;  ///< pairs + 1, from first_pair_ on
  std::vector<int64_t> sums_;      ///< channels x rows x cols
};

}  // namespace hedgehop::vision::flow
