#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hedgehop::vision::mapping {

/// Distance of each cell of a grid to the nearest marked cell, center to center, in cells; kFar without marked cells.
/// With a distance field, the test of a disk is one lookup: [Oleynikova2017] sec. V. Differs: the paper updates a
/// three-dimensional field as voxels change; ours is recomputed in the plane of flight, in a fraction of a millisecond.
class DistanceField {
 public:
  static constexpr float kFar = 1e6F;

  /// Computes the field. @param marked  rows x cols, row by row; 0: not marked.
  void build(const std::vector<uint8_t>& marked, int rows, int cols);
  float at(int row, int col) const { return distance_[static_cast<size_t>(row * cols_ + col)]; }

 private:
  int cols_ = 0;
  std::vector<float> distance_, column_;
  std::vector<int> parabola_;
  std::vector<float> from_;
};

}  // namespace hedgehop::vision::mapping
