#include "sim/reproduce/outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "sim/campaign/campaign_file.h"
#include "sim/campaign/table.h"
#include "sim/record/csv_line.h"

namespace hedgehop::sim {
namespace {

using Statistic = FlightFigure::Statistic;

std::vector<uint64_t> seeds_of(const PaperFlights& flights, bool quick) {
  if (!quick) return parse_seeds(flights.seeds);
  return flights.quick ? parse_seeds(*flights.quick) : std::vector<uint64_t>{};
}

std::string text_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* integer = std::get_if<int64_t>(&cell)) return std::to_string(*integer);
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  return "";
}

std::vector<FlightRecord> flights_with(FlightRecord::Status status, const FlightFigure& figure,
                                       const PaperOutcome& outcome) {
  std::vector<FlightRecord> chosen;
  for (const std::string& name : figure.flights) {
    const auto found = outcome.flights.find(name);
    if (found == outcome.flights.end()) continue;
    std::ranges::copy_if(found->second, std::back_inserter(chosen),
                         [status](const FlightRecord& record) { return record.status == status; });
  }
  return chosen;
}

/// A column's cells over the flights that ended.
std::vector<Cell> cells_of(const FlightFigure& figure, const PaperOutcome& outcome) {
  const Table table = flight_table(flights_with(FlightRecord::Status::flown, figure, outcome));
  const size_t column = column_index(table, figure.column);
  std::vector<Cell> cells;
  if (column == table.columns.size()) return cells;
  for (const auto& row : table.rows) cells.push_back(row[column]);
  return cells;
}

std::vector<double> numbers_of(const std::vector<Cell>& cells) {
  std::vector<double> numbers;
  for (const Cell& cell : cells) {
    if (const auto* integer = std::get_if<int64_t>(&cell)) numbers.push_back(static_cast<double>(*integer));
    if (const auto* number = std::get_if<double>(&cell); number && std::isfinite(*number)) numbers.push_back(*number);
  }
  std::ranges::sort(numbers);
  return numbers;
}

double statistic_of(Statistic statistic, const std::vector<double>& sorted) {
  if (sorted.empty()) return NAN;
  const size_t count = sorted.size();
  switch (statistic) {
    case Statistic::least:
      return sorted.front();
    case Statistic::greatest:
      return sorted.back();
    case Statistic::median:
      return (sorted[(count - 1) / 2] + sorted[count / 2]) / 2.0;
    default:
      return std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(count);
  }
}

bool counts(Statistic statistic) { return statistic == Statistic::count || statistic == Statistic::share; }

std::string asked_words(const PaperRow& row) {
  if (row.at_least && row.at_most) return fmt::format("{:g} to {:g}", *row.at_least, *row.at_most);
  if (row.at_least) return fmt::format("at least {:g}", *row.at_least);
  if (row.at_most) return fmt::format("at most {:g}", *row.at_most);
  return "";
}

std::string value_words(const RowOutcome& row) {
  if (std::isnan(row.value)) return row.ended == 0 ? "not measured" : "unknown";
  if (row.row.flights.empty() || !counts(row.row.statistic)) return fmt::format("{:.4g}", row.value);
  const auto ended = static_cast<double>(row.ended);
  const double successes = row.row.statistic == Statistic::count ? row.value : row.value * ended;
  return fmt::format("{:.0f} of {}", successes, row.ended);
}

std::string ours_words(const RowOutcome& row) {
  return value_words(row) + (row.broken > 0 ? fmt::format(", {} flights broken", row.broken) : "");
}

std::string command_of(const PaperRow& row, const Paper& paper) {
  std::string command;
  for (const PaperFlights& flights : paper.flights) {
    if (std::ranges::find(row.flights, flights.name) == row.flights.end()) continue;
    command += fmt::format("{}hedgehop batch {} --seeds {}", command.empty() ? "" : "; ",
                           shell_quoted(flights.scenario), flights.seeds);
    for (const std::string& text : flights.set) command += " --set " + shell_quoted(text);
  }
  return command;
}

RowOutcome row_outcome(const PaperRow& row, const PaperOutcome& outcome) {
  RowOutcome result{.row = row, .asked = asked_words(row), .ours = {}, .command = command_of(row, outcome.paper)};
  if (row.calculation.empty()) {
    result.ended = cells_of(row, outcome).size();
    result.broken = flights_with(FlightRecord::Status::failed, row, outcome).size();
    result.value = figure_of(row, outcome);
  } else {
    result.value = outcome.calculations.at(row.calculation).at(row.value).back();
  }
  if ((row.at_least || row.at_most) && !std::isnan(result.value)) {
    result.holds = result.value >= row.at_least.value_or(-INFINITY) && result.value <= row.at_most.value_or(INFINITY);
  }
  if (result.broken > 0) result.holds = false;
  result.ours = ours_words(result);
  return result;
}

std::string holds_words(const RowOutcome& row) { return row.holds ? (*row.holds ? "yes" : "**no**") : "-"; }

}  // namespace

std::vector<Order> paper_orders(const Paper& paper, bool quick) {
  std::vector<Order> orders;
  std::vector<std::string> faults;
  for (const PaperFlights& flights : paper.flights) {
    const std::vector<uint64_t> seeds = seeds_of(flights, quick);
    if (seeds.empty()) continue;
    BatchOrders batch = read_batch({flights.scenario}, seeds, flights.set);
    faults.insert(faults.end(), batch.faults.begin(), batch.faults.end());
    for (Order& order : batch.orders) {
      order.id = fmt::format("{}/seed{}", flights.name, order.seed);
      order.group = flights.name;
      orders.push_back(std::move(order));
    }
  }
  if (!faults.empty()) throw InputError(faults);
  return orders;
}

PaperOutcome paper_outcome(const Paper& paper, const std::filesystem::path& folder,
                           const std::vector<FlightRecord>& records) {
  PaperOutcome outcome{.paper = paper, .folder = folder, .flights = {}, .calculations = {}};
  for (const FlightRecord& record : records) outcome.flights[record.order.group].push_back(record);
  std::set<std::string> names;
  for (const PaperRow& row : paper.rows) names.insert(row.calculation);
  for (const PaperChart& chart : paper.charts) {
    for (const PaperSeries& series : chart.series) {
      if (const auto* calculated = std::get_if<CalculationSeries>(&series)) names.insert(calculated->calculation);
    }
  }
  names.erase("");
  for (const std::string& name : names) outcome.calculations[name] = find_calculation(name)->calculate();
  return outcome;
}

double figure_of(const FlightFigure& figure, const PaperOutcome& outcome) {
  const std::vector<Cell> cells = cells_of(figure, outcome);
  if (!counts(figure.statistic)) return statistic_of(figure.statistic, numbers_of(cells));
  if (cells.empty()) return NAN;
  const auto count = std::ranges::count_if(cells, [&](const Cell& cell) { return text_of(cell) == figure.is; });
  const double all = figure.statistic == Statistic::share ? static_cast<double>(cells.size()) : 1.0;
  return static_cast<double>(count) / all;
}

std::vector<RowOutcome> row_outcomes(const PaperOutcome& outcome) {
  std::vector<RowOutcome> rows;
  for (const PaperRow& row : outcome.paper.rows) rows.push_back(row_outcome(row, outcome));
  return rows;
}

std::string rows_text(const Paper& paper, const std::vector<RowOutcome>& rows) {
  std::string text = fmt::format("## {} [{}]\n\n| what | paper | asked | ours | holds |\n|---|---|---|---|---|\n",
                                 paper.title, paper.source);
  for (const RowOutcome& row : rows) {
    const std::string unit = row.row.unit.empty() ? "" : ", " + row.row.unit;
    text += fmt::format("| {}{} | {} | {} | {} | {} |\n", row.row.what, unit, row.row.paper, row.asked, row.ours,
                        holds_words(row));
  }
  return text;
}

std::string rows_csv(const std::vector<std::pair<std::string, std::vector<RowOutcome>>>& rows_of_papers) {
  fmt::memory_buffer out;
  {
    CsvLine header(out);
    for (const char* name :
         {"paper", "what", "unit", "printed", "at_least", "at_most", "ours", "flights", "holds", "command"}) {
      header.add(std::string_view(name));
    }
  }
  for (const auto& [key, rows] : rows_of_papers) {
    for (const RowOutcome& row : rows) {
      CsvLine(out)
          .add(std::string_view(key))
          .add(std::string_view(row.row.what))
          .add(std::string_view(row.row.unit))
          .add(std::string_view(row.row.paper))
          .add(row.row.at_least)
          .add(row.row.at_most)
          .add(row.value)
          .add(static_cast<double>(row.ended))
          .add(std::string_view(row.holds ? (*row.holds ? "yes" : "no") : ""))
          .add(std::string_view(row.command));
    }
  }
  return fmt::to_string(out);
}

}  // namespace hedgehop::sim
