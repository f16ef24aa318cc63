#include "sim/reproduce/measured_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/batch/flight_table.h"
#include "sim/batch/statistics.h"
#include "sim/config/numbers.h"
#include "sim/flight/words.h"

namespace hedgehop::sim {
namespace {

using Statistic = FlightFigure::Statistic;

/// A column of the table of a figure's flights.
struct FigureColumn {
  std::vector<std::string> words;
  std::vector<double> numbers;  ///< NaN in a column of words
};

FigureColumn column_of(const Table& table, const std::string& name) {
  FigureColumn column{.words = std::vector<std::string>(table.rows()),
                      .numbers = std::vector<double>(table.rows(), NAN)};
  if (!table.has(name)) return column;
  column.words = table.words(name);
  if (const auto* numbers = std::get_if<std::vector<double>>(&table.column(name).values)) column.numbers = *numbers;
  return column;
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
  const FlightResult& result = record.result->flight;
  return result.outcome == Outcome::timeout && result.goal_distance_m.has_value();
}

/// Returns the figure of one flight: 1 or 0 for a count.
std::optional<double> figure_of_flight(const FlightFigure& figure, const FigureColumn& column, size_t row) {
  if (!counts(figure.statistic)) {
    return std::isnan(column.numbers[row]) ? std::nullopt : std::optional(column.numbers[row]);
  }
  if (column.words[row].empty()) return {};
  return column.words[row] == figure.is ? 1.0 : 0.0;
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
  const FigureColumn column = column_of(flight_table(records), figure.column);
  const ParsedNumber stand_in = parse_number(missing, false);
  MeasuredFigure measured{.required = records.size()};
  std::vector<double> values;
  for (size_t row = 0; row < records.size(); ++row) {
    const Verdict verdict = verdict_of(records[row]);
    if (verdict == Verdict::not_flown) continue;
    ++measured.flown;
    add_origin(records[row], measured);
    if (verdict == Verdict::fault) {
      ++measured.faulted;
      continue;
    }
    measured.unfinished += unfinished(records[row]) ? 1 : 0;
    std::optional<double> value = figure_of_flight(figure, column, row);
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

std::string figure_words(const FlightFigure& figure, const MeasuredFigure& measured, double other) {
  if (std::isnan(measured.value)) return "not measured";
  std::string words = distinct_figures(measured.value, other);
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
