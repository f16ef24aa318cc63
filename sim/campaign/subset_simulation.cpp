#include "sim/campaign/subset_simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "sim/campaign/statistics.h"
#include "sim/scenario/random_stream.h"

namespace hedgehop::sim {
namespace {

constexpr size_t kShare = 10;  // a tenth goes on: 1 / p0, and the length of a chain
constexpr size_t kBlocks = 5;  // of chains, between which the step is adapted
constexpr size_t kMostLevels = 8;
constexpr double kFirstScale = 0.6, kLeastScale = 0.02;
constexpr double kBestAcceptance = 0.44;  // [PapaioannouEtAl2015] p. 89

using Chain = std::vector<SubsetSample>;

double uniform(uint64_t bits) { return std::ldexp(static_cast<double>(bits >> 11), -53); }

/// One run as it goes.
class Run {
 public:
  Run(const SubsetOptions& options, size_t number, const FlyMargins& fly)
      : options_(options),
        number_(number),
        fly_(fly),
        seed_(stream_seed(options.seed, fmt::format("run.{}", number))) {}

  std::optional<SubsetRun> simulate();

 private:
  uint64_t sample_seed(size_t level, size_t chain, size_t step) const {
    return stream_seed(seed_, fmt::format("{}.{}.{}", level, chain, step));
  }
  bool fly_plain();
  bool fly_chains(size_t level, double threshold, std::vector<SubsetSample> starts, SubsetLevel& result);
  /// Moves chains of one block on by one step. @return how many were accepted; nothing when interrupted.
  std::optional<size_t> step(size_t level, size_t number, double threshold, std::vector<Chain*>& block);
  double finish(size_t level);

  const SubsetOptions& options_;
  size_t number_;
  const FlyMargins& fly_;
  uint64_t seed_;
  double scale_ = kFirstScale;
  std::vector<Chain> chains_;  ///< of this level
  SubsetRun run_;
};

bool Run::fly_plain() {
  std::vector<SubsetSample> plain;
  for (size_t i = 0; i < options_.samples; ++i) {
    plain.push_back({.run = number_, .level = 0, .chain = i, .chance = Chance::of_seed(sample_seed(0, i, 0))});
  }
  const auto margins = fly_(plain);
  if (!margins) return false;
  chains_.clear();
  for (size_t i = 0; i < plain.size(); ++i) {
    plain[i].margin = (*margins)[i];
    chains_.push_back({plain[i]});
    run_.samples.push_back(plain[i]);
  }
  return true;
}

std::optional<size_t> Run::step(size_t level, size_t number, double threshold, std::vector<Chain*>& block) {
  const double beta = std::min(1.0, scale_);
  std::vector<SubsetSample> candidates;
  for (Chain* chain : block) {
    const SubsetSample& last = chain->back();
    SubsetSample candidate{.run = number_, .level = level, .chain = last.chain, .step = number};
    candidate.chance = last.chance.step(beta, sample_seed(level, last.chain, number));
    candidates.push_back(std::move(candidate));
  }
  const auto margins = fly_(candidates);
  if (!margins) return {};
  size_t accepted = 0;
  for (size_t i = 0; i < block.size(); ++i) {
    candidates[i].margin = (*margins)[i];
    candidates[i].accepted = candidates[i].margin <= threshold;
    accepted += candidates[i].accepted ? 1 : 0;
    run_.samples.push_back(candidates[i]);
    block[i]->push_back(candidates[i].accepted ? candidates[i] : block[i]->back());
  }
  return accepted;
}

bool Run::fly_chains(size_t level, double threshold, std::vector<SubsetSample> starts, SubsetLevel& result) {
  std::mt19937_64 random(stream_seed(seed_, fmt::format("{}.order", level)));
  for (size_t i = starts.size(); i > 1; --i) std::swap(starts[i - 1], starts[random() % i]);
  chains_.clear();
  for (size_t i = 0; i < starts.size(); ++i) {
    starts[i].chain = i;
    chains_.push_back({starts[i]});
  }
  const size_t block_size = chains_.size() / kBlocks;
  size_t accepted_in_all = 0;
  for (size_t b = 0; b < kBlocks; ++b) {
    std::vector<Chain*> block;
    for (size_t i = 0; i < block_size; ++i) block.push_back(&chains_[b * block_size + i]);
    size_t accepted = 0;
    for (size_t number = 1; number < kShare; ++number) {
      const auto some = step(level, number, threshold, block);
      if (!some) return false;
      accepted += *some;
    }
    accepted_in_all += accepted;
    result.beta = std::min(1.0, scale_);
    const double acceptance = static_cast<double>(accepted) / static_cast<double>(block_size * (kShare - 1));
    scale_ = std::max(kLeastScale, scale_ * std::exp((acceptance - kBestAcceptance) / std::sqrt(b + 1.0)));
  }
  result.acceptance = static_cast<double>(accepted_in_all) / static_cast<double>(chains_.size() * (kShare - 1));
  return true;
}

/// gamma: what the autocorrelation of being within the threshold adds to the variance, [AuBeck2001] p. 263.
double correlation_of(const std::vector<Chain>& chains, double threshold, double probability) {
  const size_t length = chains.front().size();
  if (length == 1 || probability <= 0.0 || probability >= 1.0) return 0.0;
  double gamma = 0.0;
  for (size_t lag = 1; lag < length; ++lag) {
    double products = 0.0;
    for (const Chain& chain : chains) {
      for (size_t i = 0; i + lag < length; ++i) {
        products += chain[i].margin <= threshold && chain[i + lag].margin <= threshold ? 1.0 : 0.0;
      }
    }
    const double mean = products / static_cast<double>(chains.size() * (length - lag));
    const double rho = (mean - probability * probability) / (probability * (1.0 - probability));
    gamma += 2.0 * (1.0 - static_cast<double>(lag) / static_cast<double>(length)) * rho;
  }
  return gamma;
}

/// Adds this level's share to the coefficients of variation, and its numbers to the run. @return its threshold.
double Run::finish(size_t level) {
  std::vector<double> margins;
  for (const Chain& chain : chains_) {
    for (const SubsetSample& sample : chain) margins.push_back(sample.margin);
  }
  std::ranges::sort(margins);
  const size_t kept = options_.samples / kShare;
  const double threshold = std::max(0.0, 0.5 * (margins[kept - 1] + margins[kept]));
  const auto within = std::ranges::upper_bound(margins, threshold) - margins.begin();
  SubsetLevel& result = run_.levels[level];
  result.threshold = threshold;
  // A margin that a chain repeats may lie on the threshold more than once: a tenth goes on all the same.
  const bool last = threshold == 0.0;
  result.probability = last ? static_cast<double>(within) / static_cast<double>(margins.size()) : 1.0 / kShare;
  result.correlation = correlation_of(chains_, threshold, result.probability);
  const auto tied = static_cast<size_t>(std::ranges::count(margins, threshold));
  if (!last && tied > kept) {
    run_.fault = fmt::format("{} of {} flights have the same margin, {:g}: no level can be drawn between them", tied,
                             margins.size(), threshold);
  }
  const double p = result.probability, n = static_cast<double>(margins.size());
  const double cov = p > 0.0 ? std::sqrt((1.0 - p) * std::max(0.0, 1.0 + result.correlation) / (p * n)) : 0.0;
  run_.cov_low = std::hypot(run_.cov_low, cov);
  run_.cov_high += cov;
  return threshold;
}

std::optional<SubsetRun> Run::simulate() {
  double probability = 1.0, threshold = 0.0;
  for (size_t level = 0; level < kMostLevels; ++level) {
    SubsetLevel& result = run_.levels.emplace_back();
    if (level == 0) {
      if (!fly_plain()) return {};
    } else {
      std::vector<SubsetSample> starts;
      for (const Chain& chain : chains_) starts.insert(starts.end(), chain.begin(), chain.end());
      std::ranges::stable_sort(starts, {}, &SubsetSample::margin);
      starts.resize(options_.samples / kShare);
      if (!fly_chains(level, threshold, std::move(starts), result)) return {};
    }
    threshold = finish(level);
    if (!run_.fault.empty()) return run_;
    probability *= run_.levels[level].probability;
    if (threshold > 0.0) continue;
    run_.probability = probability;
    return run_;
  }
  run_.fault = fmt::format("no event in {} levels: it is rarer than 1e-{}, or cannot happen", kMostLevels, kMostLevels);
  return run_;
}

}  // namespace

Chance Chance::step(double beta, uint64_t new_seed) const {
  constexpr double kRedrawn = 0.2;
  Chance next = *this;
  const double kept = std::sqrt(1.0 - beta * beta);
  if (kept == 0.0) next.blend.clear();
  for (BlendTerm& term : next.blend) term.weight *= kept;
  next.blend.push_back({new_seed, beta});
  if (uniform(stream_seed(new_seed, "redraw")) < kRedrawn) next.seed = new_seed;
  return next;
}

std::optional<SubsetRun> simulate_subsets(const SubsetOptions& options, size_t run, const FlyMargins& fly) {
  return Run(options, run, fly).simulate();
}

SubsetEstimate combine(const std::vector<SubsetRun>& runs) {
  const auto n = static_cast<double>(runs.size());
  double mean = 0.0, mean_ln = 0.0, square = 0.0, square_ln = 0.0;
  for (const SubsetRun& run : runs) {
    mean += *run.probability / n;
    mean_ln += std::log(*run.probability) / n;
  }
  for (const SubsetRun& run : runs) {
    square += std::pow(*run.probability - mean, 2);
    square_ln += std::pow(std::log(*run.probability) - mean_ln, 2);
  }
  const double half = student_quantile(0.975, static_cast<int>(runs.size()) - 1) * std::sqrt(square_ln / (n - 1.0) / n);
  return {mean, std::sqrt(square / (n - 1.0)) / mean, std::exp(mean_ln - half),
          std::min(1.0, std::exp(mean_ln + half))};
}

}  // namespace hedgehop::sim
