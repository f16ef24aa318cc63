#include "sim/evidence/flight_event.h"

#include <fmt/format.h>

#include <regex>
#include <vector>

#include "sim/batch/flight_table.h"
#include "sim/config/config_tree.h"
#include "sim/config/input_error.h"
#include "sim/config/numbers.h"
#include "sim/fields/shortened.h"

namespace hedgehop::sim {
namespace {

struct NamedKind {
  std::string_view name;
  FlightEvent::Kind kind;
};
constexpr NamedKind kKinds[] = {{"collision", FlightEvent::Kind::collision},
                                {"timeout", FlightEvent::Kind::timeout},
                                {"success", FlightEvent::Kind::success}};

/// Requires a column that every result fills: a judged figure of a table without flights.
void require_figure(const std::string& name, std::string_view rule) {
  const Table table = flight_table({});
  std::vector<std::string_view> allowed;
  for (const std::string& column : table.names()) {
    if (table.column(column).kind == FigureKind::judged && column != "trajectory_hash") allowed.push_back(column);
    if (!allowed.empty() && allowed.back() == name) return;
  }
  throw InputError(fmt::format("'{}': no column '{}' of every flight{}", rule, name, suggestion(name, allowed)));
}

bool flew(const FlightRecord& record) { return record.result && verdict_of(record) != Verdict::fault; }

}  // namespace

void require_short_rule(std::string_view text) {
  constexpr size_t kMaxBytes = 200;
  if (text.size() <= kMaxBytes) return;
  throw InputError(
      fmt::format("'{}': has {} bytes; a claim has at most {}", shortened(text, 40), text.size(), kMaxBytes));
}

FlightEvent parse_event(std::string_view text, std::string_view rule) {
  require_short_rule(text);
  const std::string whole(text);
  static const std::regex kRate(R"(rate\(\s*([\w.]+)\s*([<>])\s*(\S+?)\s*\))");
  if (std::smatch parts; std::regex_match(whole, parts, kRate)) {
    require_figure(parts[1], rule);
    return {.kind = FlightEvent::Kind::figure,
            .figure = parts[1],
            .below = parts[2] == "<",
            .threshold = parse_rule_number(parts[3], rule)};
  }
  std::vector<std::string_view> allowed;
  for (const auto& [name, kind] : kKinds) {
    if (text == name) return {.kind = kind, .figure = {}};
    allowed.push_back(name);
  }
  allowed.emplace_back("rate(COLUMN < NUMBER)");
  throw InputError(fmt::format("'{}': no event '{}'{}", rule, text, suggestion(text, allowed)));
}

std::string to_string(const FlightEvent& event) {
  for (const auto& [name, kind] : kKinds) {
    if (event.kind == kind) return std::string(name);
  }
  return fmt::format("rate({} {} {})", event.figure, event.below ? '<' : '>', event.threshold);
}

std::optional<bool> observe(const FlightEvent& event, const FlightRecord& record) {
  if (!flew(record)) return {};
  switch (event.kind) {
    case FlightEvent::Kind::collision:
      return record.result->flight.outcome == Outcome::collided;
    case FlightEvent::Kind::timeout:
      return record.result->flight.outcome == Outcome::timeout;
    case FlightEvent::Kind::success:
      return verdict_of(record) == Verdict::passed;
    case FlightEvent::Kind::figure:
      break;
  }
  const std::optional<double> value = figure_of(record, event.figure);
  if (!value) return {};
  return event.below ? *value < event.threshold : *value > event.threshold;
}

std::optional<double> figure_of(const FlightRecord& record, const std::string& figure) {
  return flew(record) ? figure_of(record.result->flight, figure) : std::nullopt;
}

double parse_rule_number(const std::string& text, std::string_view rule) {
  const ParsedNumber number = parse_number(text, /*degrees=*/false);
  if (number.kind == ParsedNumber::Kind::number) return number.member;
  throw InputError(fmt::format("'{}': '{}' is not a finite number", rule, text));
}

}  // namespace hedgehop::sim
