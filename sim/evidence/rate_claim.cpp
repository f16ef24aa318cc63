#include "sim/evidence/rate_claim.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "sim/config/input_error.h"
#include "sim/evidence/anytime_valid.h"

namespace hedgehop::sim {

std::string_view to_string(Standing standing) {
  switch (standing) {
    case Standing::undecided:
      return "undecided";
    case Standing::shown:
      return "shown";
    case Standing::refuted:
      return "refuted";
  }
  return "";
}

RateClaim parse_rate_claim(const std::string& text) {
  static const std::regex kClaim(R"(\s*(.+?)\s*([<>])\s*([^\s<>()]+)\s*)");
  std::smatch parts;
  if (!std::regex_match(text, parts, kClaim)) {
    throw InputError(fmt::format(
        "'{}': expected such as 'collision < 0.01', 'success > 0.95' or 'rate(min_clearance_m < 0.5) < 0.05'", text));
  }
  RateClaim claim{.event = parse_event(parts[1].str(), text), .text = text};
  claim.kind = parts[2] == "<" ? RateClaim::Kind::below : RateClaim::Kind::above;
  claim.bound = parse_rule_number(parts[3], text);
  if (claim.bound <= 0.0 || claim.bound >= 1.0) {
    throw InputError(fmt::format("'{}': the limit of a rate lies between 0 and 1, both left out", text));
  }
  return claim;
}

RateClaim width_claim(double width, const std::string& event) {
  if (!(width > 0.0 && width < 1.0)) {
    throw InputError(fmt::format("--until-width {}: a width lies between 0 and 1, both left out", width));
  }
  return {.event = parse_event(event, "--of " + event),
          .kind = RateClaim::Kind::width,
          .bound = width,
          .text = fmt::format("{} known within {}", event, width)};
}

double RateTally::observe(const FlightRecord& record) const {
  const std::optional<bool> event = sim::observe(claim_.event, record);
  return event ? static_cast<double>(*event) : std::nan("");
}

void RateTally::count(double event) {
  bool happened = event == 1.0;
  if (std::isnan(event)) {
    happened = claim_.kind == RateClaim::Kind::below || (claim_.kind == RateClaim::Kind::width && claim_.event.bad());
  }
  ++events_.trials;
  events_.successes += happened ? 1 : 0;
}

Standing RateTally::standing() const {
  if (claim_.kind == RateClaim::Kind::width) {
    const Interval interval = anytime_interval(events_, confidence_);
    return interval.high - interval.low <= claim_.bound ? Standing::shown : Standing::undecided;
  }
  const double decided = -std::log1p(-confidence_);
  const bool below = ln_evidence_below(events_, claim_.bound) >= decided;
  const bool above = ln_evidence_above(events_, claim_.bound) >= decided;
  const bool claims_below = claim_.kind == RateClaim::Kind::below;
  if (claims_below ? below : above) return Standing::shown;
  return (claims_below ? above : below) ? Standing::refuted : Standing::undecided;
}

double RateTally::value() const {
  if (claim_.kind == RateClaim::Kind::below) return anytime_upper_limit(events_, confidence_);
  if (claim_.kind == RateClaim::Kind::above) return anytime_lower_limit(events_, confidence_);
  const Interval interval = anytime_interval(events_, confidence_);
  return interval.high - interval.low;
}

nlohmann::ordered_json RateTally::figures() const {
  const Interval interval = anytime_interval(events_, confidence_);
  nlohmann::ordered_json json{{"n", events_.trials}, {"k", events_.successes}};
  if (claim_.kind != RateClaim::Kind::width) {
    const double below = ln_evidence_below(events_, claim_.bound), above = ln_evidence_above(events_, claim_.bound);
    const bool claims_below = claim_.kind == RateClaim::Kind::below;
    json["ln_e_for"] = claims_below ? below : above;
    json["ln_e_against"] = claims_below ? above : below;
  }
  json["interval"] = {interval.low, interval.high};
  json[claim_.kind == RateClaim::Kind::width ? "width" : "limit"] = value();
  json["method"] = claim_.kind == RateClaim::Kind::width
                       ? "anytime-valid: beta-binomial mixture"
                       : "anytime-valid: mixture of likelihood ratios; interval: beta-binomial mixture";
  return json;
}

std::string RateTally::words() const {
  const Interval interval = anytime_interval(events_, confidence_);
  const std::string within = fmt::format("{:.4g} to {:.4g}", interval.low, interval.high);
  const std::string counts =
      fmt::format("{} in {} of {} flights; with {:g} % confidence, its rate lies", to_string(claim_.event),
                  events_.successes, events_.trials, 100.0 * confidence_);
  if (claim_.kind == RateClaim::Kind::width) return fmt::format("{} within {}", counts, within);
  const std::string_view side = claim_.kind == RateClaim::Kind::below ? "below" : "above";
  return fmt::format("{} {} {:.4g} (two-sided: {})", counts, side, value(), within);
}

}  // namespace hedgehop::sim
