#include "sim/reproduce/paper.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "sim/campaign/order.h"
#include "sim/reproduce/calculations.h"
#include "sim/scenario/include.h"
#include "sim/scenario/reader.h"

namespace hedgehop::sim {
namespace {

/// Finds what in a paper's file makes no sense.
class Examiner {
 public:
  Examiner(const Paper& paper, const Node& root, Faults& faults) : root_(root), faults_(faults) {
    for (const PaperFlights& flights : paper.flights) names_.insert(flights.name);
  }

  void examine(const PaperFlights& flights, const std::string& at) {
    if (!used_.insert(flights.name).second) fault(at, fmt::format("two flights are called '{}'", flights.name));
    for (const auto& seeds : {std::optional(flights.seeds), flights.quick}) {
      try {
        if (seeds) parse_seeds(*seeds);
      } catch (const InputError& error) {
        fault(at, error.faults().front());
      }
    }
  }

  void examine(const PaperRow& row, const std::string& at) {
    if (row.flights.empty() == row.calculation.empty()) fault(at, "needs either 'flights' or 'calculation'");
    if (!row.calculation.empty()) column(row.calculation, row.value, at);
    if (!row.flights.empty()) figure(row, at);
  }

  void examine(const PaperChart& chart, const std::string& at) {
    const auto is_path = [](const PaperSeries& series) { return std::holds_alternative<PathSeries>(series); };
    if (std::ranges::any_of(chart.series, is_path) && !std::ranges::all_of(chart.series, is_path)) {
      fault(at, "paths and other series cannot share a chart");
    }
    for (size_t i = 0; i < chart.series.size(); ++i) {
      const std::string place = fmt::format("{}.series.{}", at, i);
      std::visit([&](const auto& series) { examine_series(series, place); }, chart.series[i]);
    }
  }

 private:
  void fault(const std::string& at, const std::string& words) { faults_.add(place_of(root_, at), words); }

  void known_flights(const std::string& name, const std::string& at) {
    if (!names_.contains(name)) fault(at, fmt::format("no flights are called '{}'", name));
  }

  void column(const std::string& calculation, const std::string& name, const std::string& at) {
    const Calculation* const found = find_calculation(calculation);
    if (!found) {
      fault(at, fmt::format("no calculation is called '{}'; there are: {}", calculation,
                            fmt::join(calculation_names(), ", ")));
    } else if (std::ranges::find(found->columns, name) == found->columns.end()) {
      fault(at, fmt::format("'{}' has no column '{}', but: {}", calculation, name, fmt::join(found->columns, ", ")));
    }
  }

  void figure(const FlightFigure& figure, const std::string& at) {
    for (const std::string& name : figure.flights) known_flights(name, at);
    if (figure.column.empty()) fault(at, "needs a 'column'");
    const bool counts =
        figure.statistic == FlightFigure::Statistic::count || figure.statistic == FlightFigure::Statistic::share;
    if (counts == figure.is.empty()) fault(at, counts ? "needs 'is', what to count" : "'is' goes with count and share");
  }

  void equal(size_t x, size_t y, const std::string& at) {
    if (x != y) fault(at, fmt::format("{} places across, but {} up", x, y));
  }

  void examine_series(const PrintedSeries& series, const std::string& at) {
    equal(series.x.size(), series.y.size(), at);
  }
  void examine_series(const GroupSeries& series, const std::string& at) {
    equal(series.x.size(), series.flights.size(), at);
    figure(series, at);
  }
  void examine_series(const LogSeries& series, const std::string& at) { known_flights(series.flights, at); }
  void examine_series(const PathSeries& series, const std::string& at) { known_flights(series.flights, at); }
  void examine_series(const CalculationSeries& series, const std::string& at) {
    column(series.calculation, series.x, at);
    column(series.calculation, series.y, at);
  }

  const Node& root_;
  Faults& faults_;
  std::set<std::string> names_, used_;
};

}  // namespace

Paper read_paper(const std::filesystem::path& file) {
  Faults faults;
  const Node root = load_tree(file, faults);
  Paper paper{.key = file.stem().string()};
  read_struct(root, "", "", paper, faults);
  faults.raise();
  for (PaperFlights& flights : paper.flights) {
    flights.scenario = (file.parent_path() / flights.scenario).lexically_normal().string();
    if (flights.name.empty()) flights.name = std::filesystem::path(flights.scenario).stem().string();
  }
  Examiner examiner(paper, root, faults);
  const auto each = [&](const auto& items, const char* name) {
    for (size_t i = 0; i < items.size(); ++i) examiner.examine(items[i], fmt::format("{}.{}", name, i));
  };
  each(paper.flights, "flights");
  each(paper.rows, "rows");
  each(paper.charts, "charts");
  faults.raise();
  return paper;
}

}  // namespace hedgehop::sim
