#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/evidence/betting.h"
#include "sim/evidence/rate_claim.h"

namespace hedgehop::sim {

/// What is claimed of two systems flown on the same seeds.
struct PairClaim {
  std::optional<FlightEvent> event;  ///< none: graded by a clearance
  std::string clearance;             ///< column, where there is no event
  double range_m = 0.0;              ///< clearances count up to it
  std::optional<double> margin;      ///< "no worse by" it; none: "better"
  std::string text;                  ///< as the user wrote it
};

/// Reads "collision: better", "collision: no worse by 0.02", "min_clearance_m: better". Throws InputError, one line.
/// @param range_m  of `--range`, which clearances need and events do not take.
PairClaim parse_pair_claim(const std::string& text, std::optional<double> range_m);

/// The evidence of pairs of flights, base and candidate, looked at after each pair. Events: the pairs whose flights
/// differ, as in [McNemar1947] p. 153, by RateTally's test of a rate of one half; with a margin, and clearances: bets
/// on the mean difference.
class PairTally {
 public:
  PairTally(PairClaim claim, double confidence);

  /// What is to be counted of a flight: 1 where it fails, or its clearance; NaN where nothing is known.
  double observe(const FlightRecord& record) const;
  /// @param pair  base and candidate, as observe() has them. NaN counts against the candidate.
  void count(std::span<const double> pair);
  Standing standing() const;

  int64_t units() const { return pairs_; }
  const PairClaim& claim() const { return claim_; }
  /// Events: share of the deciding pairs that the candidate wins; else the mean difference, candidate less base.
  double value() const;
  nlohmann::ordered_json figures() const;
  std::string words() const;

 private:
  bool by_discordant_pairs() const { return claim_.event && !claim_.margin; }
  double ln_better() const;
  double ln_worse() const;
  double scale() const;  ///< of a difference, to -1 .. 1

  PairClaim claim_;
  double confidence_;
  MeanBets bets_;               ///< on (difference / scale + 1) / 2
  std::vector<double> places_;  ///< those, one a pair
  int64_t pairs_ = 0, wins_ = 0, losses_ = 0;
};

}  // namespace hedgehop::sim
