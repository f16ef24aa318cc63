#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace hedgehop {

/// Returns the k-th smallest value and reorders the values. @param k  from 0, below the number of values.
template <class T>
T kth_smallest(std::vector<T>& values, size_t k) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(k);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Returns the median, the upper of the two middle values if their number is even, and reorders the values.
/// @param values  at least one.
template <class T>
T upper_median(std::vector<T>& values) {
  return kth_smallest(values, values.size() / 2);
}

/// Returns the median, the mean of the two middle values if their number is even; NaN without values.
inline double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace hedgehop
