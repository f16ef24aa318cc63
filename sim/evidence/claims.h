#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sim/batch/statistics.h"
#include "sim/evidence/anytime_valid.h"
#include "sim/evidence/flight_event.h"

namespace hedgehop::sim {

/// What flights have shown of a claim.
enum class Standing { undecided, shown, refuted };
std::string_view to_string(Standing standing);

/// What is claimed of an event's rate: that it lies below or above a limit, or that its interval is narrow enough.
struct RateClaim {
  enum class Kind { below, above, width };
  FlightEvent event;
  Kind kind = Kind::below;
  double bound = 0.0;  ///< the limit of the rate, or the width; in (0, 1)
  std::string text;    ///< as the user wrote it
};

/// Reads "collision < 0.01", "success > 0.95", "rate(min_clearance_m < 0.5) < 0.05". Throws InputError, one line.
RateClaim parse_rate_claim(const std::string& text);

/// The claim of `--until-width WIDTH --of EVENT`. Throws InputError, one line.
RateClaim width_claim(double width, const std::string& event);

/// The claim's evidence, looked at after each flight. Source: [HowardEtAl2021] sec. 3.3; see anytime_valid.h.
class RateTally {
 public:
  RateTally(RateClaim claim, double confidence) : claim_(std::move(claim)), confidence_(confidence) {}

  /// What is to be counted of a flight: the event, 1 or 0; NaN where nothing is known.
  double observe(const FlightRecord& record) const;
  /// @param event  as observe() has it. NaN counts against what is to be shown.
  void count(double event);
  Standing standing() const;

  int64_t units() const { return events_.trials; }
  const RateClaim& claim() const { return claim_; }
  /// One-sided limit of the rate on the claim's side; of a width, the interval's.
  double value() const;
  nlohmann::ordered_json figures() const;
  std::string words() const;

 private:
  RateClaim claim_;
  double confidence_;
  Count events_;
};

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

/// A claim that ends a batch once its flights show or refute it, and how surely.
struct StoppingRule {
  std::variant<RateClaim, PairClaim> claim;
  double confidence = 0.95;

  const std::string& text() const {
    return std::visit([](const auto& c) -> const std::string& { return c.text; }, claim);
  }
};

}  // namespace hedgehop::sim
