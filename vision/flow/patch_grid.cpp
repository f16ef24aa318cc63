#include "vision/flow/patch_grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hedgehop::vision::flow {
namespace {

// All in units of the alignment, so that rounding keeps the mirror symmetry.
std::vector<PatchRange> make_ranges(int count, int patch_px, int margin_px, int unit_px, int length_px) {
  const int length = length_px / unit_px;
  const int patch = std::max(1, patch_px / unit_px);
  const int margin = (margin_px + unit_px - 1) / unit_px;
  const int room = length - patch - 2 * margin;
  if (count < 1 || room < 0) {
    throw std::invalid_argument("flow: patches of " + std::to_string(patch_px) + " px within a margin of " +
                                std::to_string(margin_px) + " px do not fit " + std::to_string(length_px) + " px");
  }
  std::vector<PatchRange> ranges;
  for (int i = 0; i < count; ++i) {
    const int mirrored = std::min(i, count - 1 - i);
    int begin = (length - patch) / 2;
    if (2 * i + 1 != count) begin = margin + static_cast<int>(std::lround(room * mirrored / (count - 1.0)));
    if (2 * i + 1 > count) begin = length - patch - begin;
    ranges.push_back({begin * unit_px, (begin + patch) * unit_px});
  }
  return ranges;
}

std::vector<PatchRange> reduce_ranges(const std::vector<PatchRange>& ranges, int reduction, int first_px, int unit,
                                      int length) {
  std::vector<PatchRange> reduced;
  for (const PatchRange& range : ranges) {
    const double scale = static_cast<double>(reduction) * unit;
    const int size = std::max(1, static_cast<int>(std::lround((range.end - range.begin) / scale)));
    const int begin = static_cast<int>(std::lround((range.begin - first_px) / scale));
    const int last = length / unit - size;
    const int kept = std::clamp(begin, 0, std::max(last, 0));
    reduced.push_back({kept * unit, (kept + size) * unit});
  }
  return reduced;
}

}  // namespace

PatchGrid make_patch_grid(int rows, int cols, int patch_px, int margin_px, int alignment_px, int width_px,
                          int height_px) {
  return {make_ranges(rows, patch_px, margin_px, alignment_px, height_px),
          make_ranges(cols, patch_px, margin_px, 2 * alignment_px, width_px)};
}

PatchGrid reduce_patch_grid(const PatchGrid& grid, int reduction, int first_row_px, int width_px, int height_px) {
  return {reduce_ranges(grid.rows, reduction, first_row_px, 1, height_px),
          reduce_ranges(grid.cols, reduction, 0, 2, width_px)};
}

}  // namespace hedgehop::vision::flow
