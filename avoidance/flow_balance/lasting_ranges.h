#pragma once

#include <cstddef>
#include <vector>

namespace hedgehop::avoidance::flow_balance {

/// Retains of every patch of one camera only what its last images agree on: a wrong flow vector seldom lasts, and a
/// vector missing from one image does not make a wall vanish.
class LastingRanges {
 public:
  /// @param images  how many are remembered, at least 1.
  explicit LastingRanges(int images) : latest_(static_cast<size_t>(images)) {}

  /// Takes in the inverse ranges of an image's patches, 1/m, NaN where unknown; the same number every time.
  void add(std::vector<double> inverse_ranges_per_m);
  /// The least known inverse range of each patch over the last images, 1/m; 0 where at most half know one.
  std::vector<double> lasting_per_m() const;

 private:
  std::vector<std::vector<double>> latest_;
  size_t next_ = 0;
};

}  // namespace hedgehop::avoidance::flow_balance
