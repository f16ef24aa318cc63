#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/batch/record.h"

namespace hedgehop::sim {

/// What a flight either does or does not: "collision", "timeout", "success" (all checks hold), or
/// "rate(COLUMN < NUMBER)", of a figure that every result has.
struct FlightEvent {
  enum class Kind { collision, timeout, success, figure };
  Kind kind = Kind::collision;
  std::string figure;  ///< of Kind::figure: a column of the batch's table
  bool below = true;   ///< of Kind::figure: whether the event is a figure below the threshold, or above
  double threshold = 0.0;

  /// Whether a flight does better without it.
  bool bad() const { return kind != Kind::success; }
};

/// Throws InputError for events and columns that do not exist, naming the nearest. @param rule  for the message.
FlightEvent parse_event(std::string_view text, std::string_view rule);

/// The event in words, as parse_event() reads it.
std::string to_string(const FlightEvent& event);

/// Whether the flight does it; nothing of a flight that left no result, ended by a fault, or lacks the figure. Nothing
/// to be asked of a flight (no checks) is no success.
std::optional<bool> observe(const FlightEvent& event, const FlightRecord& record);

/// The figure of a flight's result; nothing where it lacks it. A clearance without anything near is infinite.
std::optional<double> figure_of(const FlightRecord& record, const std::string& figure);

/// A number of a rule. Throws InputError naming the rule.
double parse_rule_number(const std::string& text, std::string_view rule);

}  // namespace hedgehop::sim
