#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace hedgehop::dynamics {

/// A generator of a blend and its weight.
struct BlendedSeed {
  uint64_t seed = 0;
  double weight = 1.0;
};

/// What a stream of random numbers is drawn from: one seed, or a blend of several, with weights whose squares sum to 1,
/// so that its normal numbers are standard normal again. A step from one flight to a similar one is a blend with a new
/// seed.
class SeedBlend {
 public:
  SeedBlend(uint64_t seed) : terms_{{seed, 1.0}} {}  // NOLINT(google-explicit-constructor): a seed is a blend of one
  explicit SeedBlend(std::vector<BlendedSeed> terms) : terms_(std::move(terms)) {}
  const std::vector<BlendedSeed>& terms() const { return terms_; }

 private:
  std::vector<BlendedSeed> terms_;
};

/// Standard normal numbers; equal blends give equal sequences. A blend of one seed draws what that seed draws. All
/// generators of a blend draw in step: how many draws a flight makes depends on time alone.
class NormalStream {
 public:
  explicit NormalStream(const SeedBlend& seeds);

  double draw();
  Eigen::Vector3d draw3();
  /// Evenly from [0, 1), of 53 random bits; of a blend, by way of the normal distribution.
  double even();
  /// True with probability `p`, 0..1.
  bool chance(double p) { return even() < p; }

 private:
  struct Term {
    double weight;
    std::mt19937_64 generator;
    std::normal_distribution<double> normal;
  };
  std::vector<Term> terms_;
};

/// The z with a share `probability` of the standard normal distribution below it, to 16 figures. @param probability  in
/// (0, 1). Source: [Wichura1988] p. 483, PPND16. Of logarithm and square root alone, so that it is the same everywhere.
double normal_quantile(double probability);

/// Share of the standard normal distribution below z: the inverse of normal_quantile(), by bisection.
double normal_distribution(double z);

}  // namespace hedgehop::dynamics
