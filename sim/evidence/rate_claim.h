#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "sim/batch/statistics.h"
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

}  // namespace hedgehop::sim
