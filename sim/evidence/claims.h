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

/// The verdict of flights on a claim.
enum class Standing { undecided, shown, refuted };
std::string_view to_string(Standing standing);

/// A claim about the rate of an event: it is below or above a limit, or its interval is narrow enough.
struct RateClaim {
  enum class Kind { below, above, width };
  FlightEvent event;
  Kind kind = Kind::below;
  double bound = 0.0;  ///< the limit of the rate, or the width; in (0, 1)
  std::string text;    ///< as written by the user
};

/// Reads "collision < 0.01", "success > 0.95", "rate(min_clearance_m < 0.5) < 0.05". Throws InputError, one line.
RateClaim parse_rate_claim(const std::string& text);

/// The claim of `--until-width WIDTH --of EVENT`. Throws InputError, one line.
RateClaim width_claim(double width, const std::string& event);

/// The evidence about a claim, evaluated after each flight. Source: [HowardEtAl2021] sec. 3.3; see anytime_valid.h.
class RateTally {
 public:
  RateTally(RateClaim claim, double confidence) : claim_(std::move(claim)), confidence_(confidence) {}

  /// Returns the event of a flight: 1 or 0; NaN if unknown.
  double observe(const FlightRecord& record) const;
  /// @param event  from observe(). NaN counts against the claim.
  void count(double event);
  Standing standing() const;

  int64_t units() const { return events_.trials; }
  const RateClaim& claim() const { return claim_; }
  /// Returns the one-sided limit of the rate on the side of the claim; for a width claim, the width of the interval.
  double value() const;
  nlohmann::ordered_json figures() const;
  std::string words() const;

 private:
  RateClaim claim_;
  double confidence_;
  Count events_;
};

/// A claim about two systems that are flown on the same seeds.
struct PairClaim {
  std::optional<FlightEvent> event;  ///< nullopt: compares a clearance
  std::string clearance;             ///< column, if there is no event
  double range_m = 0.0;              ///< clearances are limited to this value
  std::optional<double> margin;      ///< of "no worse by"; nullopt: "better"
  std::string text;                  ///< as written by the user
};

/// Reads "collision: better", "collision: no worse by 0.02", "min_clearance_m: better". Throws InputError, one line.
/// @param range_m  value of `--range`: required for clearances, invalid for events.
PairClaim parse_pair_claim(const std::string& text, std::optional<double> range_m);

/// The evidence of pairs of flights, base and candidate, evaluated after each pair. For events without a margin, it
/// tests the discordant pairs ([McNemar1947] p. 153) against a rate of one half, like RateTally. For events with a
/// margin and for clearances, it uses bets on the mean difference.
class PairTally {
 public:
  PairTally(PairClaim claim, double confidence);

  /// Returns the value of a flight: 1 for a failure and 0 otherwise, or the clearance, m; NaN if unknown.
  double observe(const FlightRecord& record) const;
  /// @param pair  base and candidate, from observe(). NaN counts against the candidate.
  void count(std::span<const double> pair);
  Standing standing() const;

  int64_t units() const { return pairs_; }
  const PairClaim& claim() const { return claim_; }
  /// Returns the share of discordant pairs that the candidate wins (events without a margin), otherwise the mean
  /// difference, candidate minus base.
  double value() const;
  nlohmann::ordered_json figures() const;
  std::string words() const;

 private:
  bool by_discordant_pairs() const { return claim_.event && !claim_.margin; }
  double ln_better() const;
  double ln_worse() const;
  double scale() const;  ///< of differences: divided by it they are in [-1, 1]

  PairClaim claim_;
  double confidence_;
  MeanBets bets_;               ///< on (difference / scale + 1) / 2
  std::vector<double> places_;  ///< those values, one per pair
  int64_t pairs_ = 0, wins_ = 0, losses_ = 0;
};

/// A claim that ends a batch as soon as the flights show or refute it, and the required confidence.
struct StoppingRule {
  std::variant<RateClaim, PairClaim> claim;
  double confidence = 0.95;

  const std::string& text() const {
    return std::visit([](const auto& c) -> const std::string& { return c.text; }, claim);
  }
};

}  // namespace hedgehop::sim
