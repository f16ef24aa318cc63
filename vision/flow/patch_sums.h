#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vision/flow/patch_grid.h"

namespace hedgehop::vision::flow {

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
