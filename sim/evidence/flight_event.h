#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/batch/record.h"

namespace hedgehop::sim {

/// A binary event of a flight: "collision", "timeout", "success" (all checks pass), or "rate(COLUMN < NUMBER)" for a
/// figure that every result contains.
struct FlightEvent {
  enum class Kind { collision, timeout, success, figure };
  Kind kind = Kind::collision;
  std::string figure;  ///< of Kind::figure: a column of the batch's table
  bool below = true;   ///< of Kind::figure: whether the event is a figure below (true) or above the threshold
  double threshold = 0.0;

  /// Returns whether the event is undesired.
  bool bad() const { return kind != Kind::success; }
};

/// Reads an event. Throws InputError for unknown events and columns, with the nearest name. @param rule  for the
/// message.
FlightEvent parse_event(std::string_view text, std::string_view rule);

/// Returns the event as text that parse_event() reads.
std::string to_string(const FlightEvent& event);

/// Returns whether the event occurred; nullopt if the flight has no result, ended with a fault, or lacks the figure. A
/// flight without checks is not a success.
std::optional<bool> observe(const FlightEvent& event, const FlightRecord& record);

/// Returns a figure of a flight's result; nullopt if missing. A clearance with no obstacle in range is infinite.
std::optional<double> figure_of(const FlightRecord& record, const std::string& figure);

/// Throws InputError if the text of a rule is longer than any rule.
void require_short_rule(std::string_view text);

/// Reads a number of a rule. Throws InputError that names the rule.
double parse_rule_number(const std::string& text, std::string_view rule);

}  // namespace hedgehop::sim
