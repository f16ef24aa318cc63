#pragma once

#include <span>
#include <vector>

namespace hedgehop::avoidance::flow_balance {

/// Carries the inverse ranges of one camera's patches over moments in which flow tells little of them, as around the
/// focus of expansion while a turn sweeps it across the image. What is not told anew goes on as the vehicle's own
/// motion would have it, and fades.
class RangeMemory {
 public:
  /// @param time_constant_s  in which what is not told again fades; 0 remembers nothing.
  explicit RangeMemory(double time_constant_s) : time_constant_s_(time_constant_s) {}

  /// What one image tells of a patch.
  struct Sight {
    double near_per_m = 0.0;   ///< inverse range times `weight`; NaN where the flow is not valid
    double weight = 0.0;       ///< how far the image tells a range, 0 to 1
    double closing_mps = 0.0;  ///< speed towards the patch's direction
  };

  /// Takes in an image's patches, the same number every time. @param dt_s  since the last image, > 0.
  /// @return inverse range of every patch, 1/m; NaN only where nothing has been told yet.
  const std::vector<double>& update(std::span<const Sight> sights, double dt_s);

 private:
  double time_constant_s_;
  std::vector<double> near_per_m_;
};

}  // namespace hedgehop::avoidance::flow_balance
