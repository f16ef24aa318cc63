#include "sim/reproduce/measured_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/batch/flight_table.h"
#include "sim/batch/statistics.h"
#include "sim/config/numbers.h"

namespace hedgehop::sim {
namespace {

using Statistic = FlightFigure::Statistic;

std::string text_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* integer = std::get_if<int64_t>(&cell)) return std::to_string(*integer);
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  return "";
}

std::optional<double> number_of(const Cell& cell) {
  if (const auto* integer = std::get_if<int64_t>(&cell)) return static_cast<double>(*integer);
  if (const auto* number = std::get_if<double>(&cell); number && std::isfinite(*number)) return *number;
  return {};
}

double statistic_of(Statistic statistic, std::vector<double> values) {
  if (values.empty()) return NAN;
  std::ranges::sort(values);
  const size_t count = values.size();
  switch (statistic) {
    case Statistic::min:
      return values.front();
    case Statistic::max:
      return values.back();
    case Statistic::median:
      return (values[(count - 1) / 2] + values[count / 2]) / 2.0;
    case Statistic::count:
      return std::accumulate(values.begin(), values.end(), 0.0);
    default:
      return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(count);
  }
}

/// A flight without a goal flies its full time; one with a goal must reach it.
bool unfinished(const FlightRecord& record) {
  const std::string outcome = outcome_words(record);
  const auto distance = record.result.find("goal_distance_m");
  const bool has_goal = distance != record.result.end() && distance->is_number();
  return outcome == "timeout" && has_goal;
}

/// Returns the figure of one flight: 1 or 0 for a count.
std::optional<double> figure_of_flight(const FlightFigure& figure, const Cell& cell) {
  if (!counts(figure.statistic)) return number_of(cell);
  const std::string text = text_of(cell);
  if (text.empty()) return {};
  return text == figure.is ? 1.0 : 0.0;
}

std::vector<FlightRecord> records_of(const FlightFigure& figure, const PaperOutcome& outcome) {
  std::vector<FlightRecord> records;
  for (const std::string& name : figure.flights) {
    const auto found = outcome.flights.find(name);
    if (found != outcome.flights.end()) records.insert(records.end(), found->second.begin(), found->second.end());
  }
  return records;
}

void add_origin(const FlightRecord& record, MeasuredFigure& measured) {
  measured.builds.insert(build_of(record));
  for (const std::string& truth : truth_used(record)) measured.truth_used.insert(truth);
}

}  // namespace

MeasuredFigure measure(const FlightFigure& figure, const PaperOutcome& outcome, const std::string& missing) {
  const std::vector<FlightRecord> records = records_of(figure, outcome);
  const Table table = flight_table(records);
  const size_t column = column_index(table, figure.column);
  const ParsedNumber stand_in = parse_number(missing, false);
  MeasuredFigure measured{.required = records.size()};
  std::vector<double> values;
  for (size_t row = 0; row < records.size(); ++row) {
    if (records[row].status != FlightRecord::Status::flown) continue;
    ++measured.flown;
    add_origin(records[row], measured);
    if (outcome_words(records[row]) == "fault") {
      ++measured.faulted;
      continue;
    }
    measured.unfinished += unfinished(records[row]) ? 1 : 0;
    std::optional<double> value;
    if (column < table.columns.size()) value = figure_of_flight(figure, table.rows[row][column]);
    if (!value && stand_in.kind == ParsedNumber::Kind::number) {
      value = stand_in.member;
      ++measured.stand_ins;
    }
    if (value) values.push_back(*value);
  }
  measured.with_figure = values.size();
  measured.value = statistic_of(figure.statistic, values);
  if (counts(figure.statistic) && !values.empty()) {
    const auto successes = static_cast<int64_t>(std::accumulate(values.begin(), values.end(), 0.0));
    measured.interval = wilson_interval({successes, static_cast<int64_t>(values.size())}, kTableConfidence);
  }
  return measured;
}

std::string figure_words(const FlightFigure& figure, const MeasuredFigure& measured) {
  if (std::isnan(measured.value)) return "not measured";
  std::string words = fmt::format("{:.4g}", measured.value);
  if (counts(figure.statistic)) {
    const double all = figure.statistic == Statistic::share ? static_cast<double>(measured.with_figure) : 1.0;
    words = fmt::format("{:.0f} of {}", measured.value * all, measured.with_figure);
  }
  if (measured.with_figure < measured.required) {
    words += fmt::format(" ({} of {} flights)", measured.with_figure, measured.required);
  }
  return words;
}

}  // namespace hedgehop::sim
