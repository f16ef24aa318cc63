#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hedgehop::sim {

/// One stream of a blend: the normal numbers of a seed, and their weight.
struct BlendTerm {
  uint64_t seed = 0;
  double weight = 1.0;
  bool operator==(const BlendTerm&) const = default;
};

/// What chance does to a flight. The normal numbers of wind, sensors and start are blends of those of several seeds,
/// with weights whose squares sum to 1, so that each is standard normal again; what has no vector of numbers depends on
/// a seed.
struct Chance {
  std::vector<BlendTerm> blend;
  uint64_t seed = 0;  ///< of scene, module, cameras and failures
  bool operator==(const Chance&) const = default;

  /// What the seed alone does.
  static Chance of_seed(uint64_t seed) { return {{{seed, 1.0}}, seed}; }
  /// A step of preconditioned Crank-Nicolson: sqrt(1 - beta^2) of this and beta of a new seed's numbers; what
  /// depends on a seed is drawn again with probability 0.2. Leaves the distribution of flights as it is, whatever beta.
  /// Source: [CotterEtAl2013] p. 424. @param beta  in (0, 1].
  Chance step(double beta, uint64_t new_seed) const;
};

/// One flight of a subset simulation.
struct SubsetSample {
  size_t run = 0, level = 0, chain = 0, step = 0;
  Chance chance;
  double margin = 0.0;  ///< what is left of the limit; at 0 and below the event happens
  bool accepted = true;
};

struct SubsetLevel {
  double threshold = 0.0;    ///< of the margin, to the next level; 0 at the last
  double probability = 0.0;  ///< of a sample to be within it
  double correlation = 0.0;  ///< gamma: what the chains' dependence adds to the variance
  double beta = 0.0;         ///< the last; 0 at level 0
  double acceptance = 0.0;   ///< of the chains' steps
};

/// One run. Without an event in any level there is no estimate.
struct SubsetRun {
  std::vector<SubsetLevel> levels;
  std::optional<double> probability;
  double cov_low = 0.0, cov_high = 0.0;  ///< coefficient of variation: levels independent, and fully dependent
  std::vector<SubsetSample> samples;     ///< one a flight, in the order of flying
  std::string fault;                     ///< why there is no estimate
};

struct SubsetOptions {
  size_t samples = 500;  ///< of a level; a multiple of 50
  uint64_t seed = 1;
};

/// Margins of samples, one each, flown as one batch; nothing when interrupted.
using FlyMargins = std::function<std::optional<std::vector<double>>(const std::vector<SubsetSample>&)>;

/// Estimates the probability of a margin of 0 or less by levels: each level keeps the tenth of the samples with the
/// least margins and moves on from them by Markov chains that stay within. @param run  its number; equal seeds and
/// numbers give equal runs, however the margins were flown. Source: [AuBeck2001] sec. 4 to 6; chains and their steps by
/// [PapaioannouEtAl2015] sec. 5, adaptive conditional sampling.
/// @return nothing when interrupted.
std::optional<SubsetRun> simulate_subsets(const SubsetOptions& options, size_t run, const FlyMargins& fly);

/// Several runs together.
struct SubsetEstimate {
  double mean = 0.0;             ///< of the runs' probabilities
  double cov = 0.0;              ///< coefficient of variation of one run, from their spread
  double low = 0.0, high = 0.0;  ///< Student's interval (95 %) of the mean of ln P, as probabilities
};
/// @param runs  at least two, all with an estimate.
SubsetEstimate combine(const std::vector<SubsetRun>& runs);

}  // namespace hedgehop::sim
