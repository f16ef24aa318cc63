#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace hedgehop::dynamics {

/// Standard normal and uniform numbers from one seed. Equal seeds give equal sequences.
class NormalStream {
 public:
  explicit NormalStream(uint64_t seed) : generator_(seed) {}

  double draw() { return normal_(generator_); }
  Eigen::Vector3d draw3();
  /// Uniform in [0, 1), of 53 random bits.
  double even();
  /// True with probability `p`, 0..1.
  bool chance(double p) { return even() < p; }

 private:
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

/// The z with a share `probability` of the standard normal distribution below it, to 16 figures. @param probability  in
/// (0, 1). Source: [Wichura1988] p. 483, PPND16. Of logarithm and square root alone, so that it is the same everywhere.
double normal_quantile(double probability);

}  // namespace hedgehop::dynamics
