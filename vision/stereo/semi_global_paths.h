#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vision/stereo/best_disparity.h"
#include "vision/stereo/cost_lanes.h"

namespace hedgehop::vision::stereo {

/// Parameters of path costs.
struct PathConfig {
  int width, disparities;        ///< a multiple of 16
  int half;                      ///< pixels of a block on each side of its center
  int16_t step_cost, leap_cost;  ///< for disparity changes along a path of one and of more
  int uniqueness_percent;        ///< 0 to 99: required margin of the best sum over those of non-adjacent disparities
  int max_lanes;                 ///< maximum number of disparities to process at a time
};

/// Costs of blocks aggregated along five paths, row by row from the top: from the left, the right, and the three
/// neighbors above. The costs of a pixel or block are in the order of disparities, largest first.
///
/// By [Hirschmuller2008] eq. (13), L(p, d) = C(p, d) + min(L(q, d), L(q, d - 1) + step, L(q, d + 1) + step,
/// min L(q) + leap) - min L(q), with q the previous pixel of p.
class PathCosts {
 public:
  /// Above all costs on a path; a step from it still fits 16 bits.
  static constexpr int16_t kFar = INT16_MAX - 8 * 13 * 13;

  explicit PathCosts(const PathConfig& config);

  /// Begins an image. @param columns  for each pixel the costs, summed over the rows of the block around the first row.
  void begin(const std::vector<int16_t>& columns);
  /// Aggregates the costs of a row. @param enters, leaves  costs of the pixels by which the rows of its blocks differ
  /// from those of the previous row.
  void add_row(const uint8_t* enters, const uint8_t* leaves);

  const WinnerRow& winners() const { return winners_; }
  /// Costs of a pixel: of the block around it, summed over all paths, and of the paths through the row above.
  enum Kind { kBlock, kSum, kAbove, kAboveLeft, kAboveRight, kKinds };

 private:
  /// A cache line, with the alignment of the widest registers.
  struct alignas(sizeof(Lanes32)) CostLine {
    int16_t costs[kLanes<Lanes32>] = {};
  };

  PathConfig config_;
  std::vector<CostLine> pixels_;  ///< the costs of all kinds for each pixel, and one more pixel at both ends
  std::vector<int16_t> columns_;
  std::vector<int16_t> last_left_, last_right_;  ///< costs of the previous pixel
  WinnerRow winners_;
};

}  // namespace hedgehop::vision::stereo
