#pragma once

#include <span>
#include <vector>

namespace hedgehop::avoidance::flow_balance {

/// Remembers the inverse ranges of one camera's patches while flow hardly measures them, as around the focus of
/// expansion while a turn sweeps it across the image. A range that is not measured again changes with the vehicle's own
/// motion, and fades.
class RangeMemory {
 public:
  /// @param time_constant_s  of the fading; 0 remembers nothing.
  explicit RangeMemory(double time_constant_s) : time_constant_s_(time_constant_s) {}

  /// What one image measures of a patch.
  struct Measurement {
    double inverse_range_per_m = 0.0;  ///< times `weight`; NaN where the flow is not valid
    double weight = 0.0;               ///< 0 where the motion measures no range, 1 where it measures it in full
    double closing_mps = 0.0;          ///< speed towards the patch's direction
  };

  /// Takes in an image's patches, the same number every time.  @param dt_s  since the last image, > 0.
  /// @return inverse range of every patch, 1/m; NaN only where nothing has been measured yet.
  const std::vector<double>& update(std::span<const Measurement> measurements, double dt_s);

 private:
  double time_constant_s_;
  std::vector<double> inverse_ranges_per_m_;
};

}  // namespace hedgehop::avoidance::flow_balance
