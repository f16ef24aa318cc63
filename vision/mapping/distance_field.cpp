#include "vision/mapping/distance_field.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::vision::mapping {

void DistanceField::build(const std::vector<uint8_t>& marked, int rows, int cols) {
  cols_ = cols;
  const auto index = [&](int row, int col) { return static_cast<size_t>(row * cols + col); };
  distance_.resize(marked.size());
  // Along each column: distance to the nearest marked cell, from above and from below.
  for (int col = 0; col < cols; ++col) distance_[index(0, col)] = marked[index(0, col)] ? 0.0F : kFar;
  for (int row = 1; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      distance_[index(row, col)] =
          marked[index(row, col)] ? 0.0F : std::min(kFar, distance_[index(row - 1, col)] + 1.0F);
    }
  }
  for (int row = rows - 2; row >= 0; --row) {
    for (int col = 0; col < cols; ++col) {
      distance_[index(row, col)] = std::min(distance_[index(row, col)], distance_[index(row + 1, col)] + 1.0F);
    }
  }
  // Along each row: lower envelope of the parabolas on the squares of those distances.
  const auto n = static_cast<size_t>(cols);
  column_.resize(n);
  parabola_.resize(n);
  from_.resize(n + 1);
  for (int row = 0; row < rows; ++row) {
    const auto square = [&](int q) {
      const float d = distance_[index(row, q)];
      return d * d;
    };
    int last = -1;
    for (int q = 0; q < cols; ++q) {
      if (distance_[index(row, q)] >= kFar) continue;
      const auto x = static_cast<float>(q);
      float meets = -kFar;
      while (last >= 0) {
        const int p = parabola_[static_cast<size_t>(last)];
        const auto y = static_cast<float>(p);
        meets = (square(q) + x * x - square(p) - y * y) / (2.0F * (x - y));
        if (meets > from_[static_cast<size_t>(last)]) break;
        --last;
        meets = -kFar;
      }
      ++last;
      parabola_[static_cast<size_t>(last)] = q;
      from_[static_cast<size_t>(last)] = meets;
    }
    int k = 0;
    for (int q = 0; q < cols; ++q) {
      if (last < 0) {
        column_[static_cast<size_t>(q)] = kFar;
        continue;
      }
      const auto x = static_cast<float>(q);
      while (k < last && from_[static_cast<size_t>(k + 1)] < x) ++k;
      const int p = parabola_[static_cast<size_t>(k)];
      const auto off = static_cast<float>(q - p);
      column_[static_cast<size_t>(q)] = std::sqrt(off * off + square(p));
    }
    std::copy(column_.begin(), column_.end(), distance_.begin() + row * cols);
  }
}

}  // namespace hedgehop::vision::mapping
