#pragma once

#include <cstdint>
#include <span>
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

/// Sums of products of images over a grid of equal, possibly overlapping patches, at a cost per pixel that does not
/// depend on patch size or overlap: columns are summed downwards, stored at the rows where patches begin or end, and
/// summed sideways once per row of patches. Exact integers.
class PatchSums {
 public:
  /// @param rows, cols  patches; column ranges begin and end at even pixels.
  /// @param padded_width  a multiple of 8.  @param channels  sums computed side by side.
  /// Throws std::invalid_argument on odd columns or ranges outside the image.
  PatchSums(std::span<const PatchRange> rows, std::span<const PatchRange> cols, int padded_width, int height,
            int channels);

  /// First row that must be given and one past the last.
  int first_row() const { return boundaries_.front(); }
  int end_row() const { return boundaries_.back(); }
  /// Columns that count, widened to multiples of 8.
  PatchRange columns() const { return {2 * first_pair_, 2 * end_pair_}; }

  /// Starts again at first_row().
  void begin();
  /// Adds products of the current row. A patch's columns of a channel must sum up within 31 bits:
  /// 2 * |a| * |b| * patch height < 2^31. Reads columns() alone.
  void add(int channel, const int16_t* a, const int16_t* b);
  /// Moves to the next row; after the row before end_row() the sums stand.
  void next_row();
  /// Sum over the patch at (row, col), after the last row.
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
  int first_pair_ = 0, end_pair_ = 0;  ///< that a patch may hold
  std::vector<int> boundaries_;        ///< image rows where a patch begins or ends, rising
  int row_ = 0;                        ///< the current image row
  size_t next_boundary_ = 0;
  std::vector<int32_t> columns_;   ///< channels x pairs: running sums, wrapping
  std::vector<int32_t> kept_;      ///< boundaries x channels x pairs
  std::vector<int64_t> sideways_;  ///< pairs + 1, from first_pair_ on
  std::vector<int64_t> sums_;      ///< channels x rows x cols
};

}  // namespace hedgehop::vision::flow
