#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hedgehop::vision::mapping {

/// Distance of each cell of a grid to the nearest marked one, center to center, in cells; kFar where none is marked.
/// A distance field makes the test of a disk one look-up: [Oleynikova2017] sec. V. Differs: theirs is built as voxels
/// change, in three dimensions; ours from scratch in the plane of flight, which takes a fraction of a millisecond.
class DistanceField {
 public:
  static constexpr float kFar = 1e6F;

  /// @param marked  rows x cols, row by row; 0 is not marked.
  void build(const std::vector<uint8_t>& marked, int rows, int cols);
  float at(int row, int col) const { return distance_[static_cast<size_t>(row * cols_ + col)]; }

 private:
  int cols_ = 0;
  std::vector<float> distance_, column_;
  std::vector<int> parabola_;
  std::vector<float> from_;
};

}  // namespace hedgehop::vision::mapping
