#include "sim/evidence/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <regex>

#include "sim/config/input_error.h"
#include "sim/evidence/anytime_valid.h"

namespace hedgehop::sim {
namespace {

constexpr std::string_view kClearances[] = {"min_clearance_m", "min_obstacle_clearance_m", "min_ground_clearance_m"};

/// Returns the hypothetical mean in [0, 1] of the scaled differences: no difference, or the margin against the
/// candidate.
double place_of_hypothesis(const PairClaim& claim) {
  const double scale = claim.event ? 1.0 : claim.range_m;
  return 0.5 - 0.5 * claim.margin.value_or(0.0) / scale;
}

void require_margin(const PairClaim& claim) {
  const double max = claim.event ? 1.0 : claim.range_m;
  if (!claim.margin || (*claim.margin > 0.0 && *claim.margin < max)) return;
  throw InputError(fmt::format("'{}': the margin must be > 0 and < {:g}", claim.text, max));
}

}  // namespace

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
  require_short_rule(text);
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
    throw InputError(fmt::format("'{}': the limit of a rate must be > 0 and < 1", text));
  }
  return claim;
}

RateClaim width_claim(double width, const std::string& event) {
  if (!(width > 0.0 && width < 1.0)) {
    throw InputError(fmt::format("--until-width {}: the width must be > 0 and < 1", width));
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

PairClaim parse_pair_claim(const std::string& text, std::optional<double> range_m) {
  require_short_rule(text);
  static const std::regex kClaim(R"(\s*([^:]+?)\s*:\s*(?:better|no worse by\s+(\S+))\s*)");
  std::smatch parts;
  if (!std::regex_match(text, parts, kClaim)) {
    throw InputError(
        fmt::format("'{}': expected such as 'collision: better', 'collision: no worse by 0.02' or "
                    "'min_clearance_m: better'",
                    text));
  }
  PairClaim claim{.event = {}, .clearance = {}, .text = text};
  if (parts[2].matched) claim.margin = parse_rule_number(parts[2], text);
  if (std::ranges::find(kClearances, parts[1].str()) != std::end(kClearances)) {
    if (!range_m)
      throw InputError(fmt::format("'{}': requires --range, the maximum clearance that counts, such as 3", text));
    if (!(*range_m > 0.0)) throw InputError(fmt::format("--range {}: must be above 0", *range_m));
    claim.clearance = parts[1];
    claim.range_m = *range_m;
  } else {
    if (range_m) throw InputError(fmt::format("'{}': --range applies to clearances only", text));
    claim.event = parse_event(parts[1].str(), text);
    if (claim.event->kind == FlightEvent::Kind::figure) {
      throw InputError(
          fmt::format("'{}': it is not defined whether this event is good or bad; compare a clearance", text));
    }
  }
  require_margin(claim);
  return claim;
}

PairTally::PairTally(PairClaim claim, double confidence)
    : claim_(std::move(claim)), confidence_(confidence), bets_(place_of_hypothesis(claim_)) {}

double PairTally::scale() const { return claim_.event ? 1.0 : claim_.range_m; }

double PairTally::observe(const FlightRecord& record) const {
  if (!claim_.event) return figure_of(record, claim_.clearance).value_or(std::nan(""));
  const std::optional<bool> event = sim::observe(*claim_.event, record);
  return event ? static_cast<double>(*event == claim_.event->bad()) : std::nan("");
}

void PairTally::count(std::span<const double> pair) {
  // Larger is better. An unknown value counts as the worst case for the claim.
  const auto merit = [&](double observed, double unknown) {
    if (std::isnan(observed)) return unknown;
    return claim_.event ? 1.0 - observed : std::clamp(observed, 0.0, claim_.range_m);
  };
  const double base = merit(pair[0], scale()), candidate = merit(pair[1], 0.0);
  ++pairs_;
  wins_ += candidate > base ? 1 : 0;
  losses_ += candidate < base ? 1 : 0;
  places_.push_back(0.5 + 0.5 * (candidate - base) / scale());
  bets_.add(places_.back());
}

double PairTally::ln_better() const {
  return by_discordant_pairs() ? ln_evidence_above({wins_, wins_ + losses_}, 0.5) : bets_.ln_above();
}

double PairTally::ln_worse() const {
  return by_discordant_pairs() ? ln_evidence_below({wins_, wins_ + losses_}, 0.5) : bets_.ln_below();
}

Standing PairTally::standing() const {
  const double decided = -std::log1p(-confidence_);
  if (ln_better() >= decided) return Standing::shown;
  return ln_worse() >= decided ? Standing::refuted : Standing::undecided;
}

double PairTally::value() const {
  if (pairs_ == 0) return std::nan("");
  if (by_discordant_pairs()) {
    const int64_t deciding = wins_ + losses_;
    return deciding == 0 ? std::nan("") : static_cast<double>(wins_) / static_cast<double>(deciding);
  }
  const double mean = std::accumulate(places_.begin(), places_.end(), 0.0) / static_cast<double>(pairs_);
  return scale() * (2.0 * mean - 1.0);
}

nlohmann::ordered_json PairTally::figures() const {
  const double found = value();
  nlohmann::ordered_json json{{"n", pairs_},
                              {"candidate_better", wins_},
                              {"candidate_worse", losses_},
                              {"ln_e_for", ln_better()},
                              {"ln_e_against", ln_worse()}};
  if (by_discordant_pairs()) {
    const Interval share = anytime_interval({wins_, wins_ + losses_}, confidence_);
    json["share_of_pairs_that_differ"] = found;  // NaN is written as null
    json["interval"] = {share.low, share.high};
    json["method"] = "anytime-valid: pairs that differ, mixture of likelihood ratios; interval: beta-binomial mixture";
    return json;
  }
  const Interval places = anytime_mean_interval(places_, confidence_);
  json["mean_difference"] = found;  // NaN is written as null
  json["interval"] = {scale() * (2.0 * places.low - 1.0), scale() * (2.0 * places.high - 1.0)};
  json["method"] = "anytime-valid: bets on the mean difference";
  return json;
}

std::string PairTally::words() const {
  const nlohmann::ordered_json json = figures();
  const double low = json.at("interval").at(0), high = json.at("interval").at(1);
  const std::string counts =
      fmt::format("of {} pairs, the candidate does better in {} and worse in {}", pairs_, wins_, losses_);
  if (by_discordant_pairs()) {
    return fmt::format("{}; with {:g} % confidence, it wins {:.4g} to {:.4g} of the pairs that differ", counts,
                       100.0 * confidence_, low, high);
  }
  const std::string unit =
      claim_.event ? " of the flights that go well" : " m of clearance, each counted up to --range";
  return fmt::format("{}; with {:g} % confidence, the mean difference lies within {:+.4g} to {:+.4g}{}", counts,
                     100.0 * confidence_, low, high, unit);
}

}  // namespace hedgehop::sim
