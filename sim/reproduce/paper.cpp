#include "sim/reproduce/paper.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "sim/batch/record.h"
#include "sim/batch/seeds.h"
#include "sim/config/include.h"
#include "sim/config/numbers.h"
#include "sim/config/reader.h"
#include "sim/reproduce/calculations.h"

namespace hedgehop::sim {
namespace {

/// Finds faults in a paper's file that go beyond single fields.
class Examiner {
 public:
  Examiner(const Paper& paper, const Node& root, ErrorList& faults)
      : root_(root), faults_(faults), tuned_on_(paper.tuned_on) {
    for (const FlightGroup& group : flight_groups(paper)) names_.insert(group.name);
  }

  void examine(const PaperFlights& flights, const std::string& at) {
    if (!used_.insert(flights.name).second) fault(at, fmt::format("two flights are called '{}'", flights.name));
    if (flights.name.find('/') != std::string::npos)
      fault(at, "a name cannot contain '/', which separates the variant");
    const auto known = [](const std::string& sensor) { return sensor == "ideal" || sensor == "dull"; };
    if (!std::ranges::all_of(flights.sensors, known)) fault(at + ".sensors", "valid sensors: ideal, dull");
    if (flights.sensor_seeds && flights.sensors.empty()) fault(at + ".sensor_seeds", "'sensor_seeds' needs 'sensors'");
    if (flights.published_seeds && flights.published.empty())
      fault(at + ".published_seeds", "'published_seeds' needs 'published'");
    const std::string wrong = judging_fault(flights.tuned_on ? flights.tuned_on : tuned_on_, flights.seeds);
    if (!wrong.empty()) {
      fault(at + ".seeds", wrong);
      return;
    }
    part(flights.published_seeds, flights.seeds, at + ".published_seeds");
    part(flights.quick, flights.published_seeds.value_or(flights.seeds), at + ".quick");
    part(flights.sensor_seeds, flights.seeds, at + ".sensor_seeds");
  }

  void examine(const PaperRow& row, const std::string& at) {
    if (row.flights.empty() == row.calculation.empty()) fault(at, "needs either 'flights' or 'calculation'");
    if (!row.calculation.empty()) column(row.calculation, row.value, at);
    if (!row.flights.empty()) figure(row, at);
    if (row.missing.empty())
      fault(at + ".missing", "needs 'fails', a number, or the reason that the flight does not count");
    if (counts(row.statistic) && parse_number(row.missing, false).kind == ParsedNumber::Kind::number) {
      fault(at + ".missing", "a number is not valid with count and share");
    }
    if (counts(row.statistic) && row.unit == "%") fault(at + ".unit", "'%' is not valid with count and share");
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
  void fault(const std::string& at, const std::string& words) { faults_.add(position_of(root_, at), words); }

  /// Requires that seeds are a subset of the flights' seeds.
  void part(const std::optional<std::string>& seeds, const std::string& whole, const std::string& at) {
    try {
      if (seeds && !within(*seeds, whole)) {
        fault(at, fmt::format("seeds '{}' are not all of the flights' seeds '{}'", *seeds, whole));
      }
    } catch (const InputError& error) {
      fault(at, error.errors().front());
    }
  }

  void known_flights(const std::string& name, const std::string& at) {
    constexpr std::string_view kFormer = "/printed", kPresent = "/published";
    if (names_.contains(name)) return;
    const std::string present =
        name.ends_with(kFormer) ? name.substr(0, name.size() - kFormer.size()) + std::string(kPresent) : "";
    fault(at, fmt::format("no flights are called '{}'{}", name,
                          names_.contains(present) ? fmt::format("; their name is now '{}'", present) : ""));
  }

  void column(const std::string& calculation, const std::string& name, const std::string& at) {
    const Calculation* const found = find_calculation(calculation);
    if (!found) {
      fault(at,
            fmt::format("no calculation is called '{}'; valid: {}", calculation, fmt::join(calculation_names(), ", ")));
    } else if (std::ranges::find(found->columns, name) == found->columns.end()) {
      fault(at, fmt::format("'{}' has no column '{}'; valid: {}", calculation, name, fmt::join(found->columns, ", ")));
    }
  }

  void figure(const FlightFigure& figure, const std::string& at) {
    for (const std::string& name : figure.flights) known_flights(name, at);
    if (figure.column.empty()) fault(at, "needs a 'column'");
    const bool counting = counts(figure.statistic);
    if (counting == figure.is.empty()) {
      fault(at, counting ? "needs 'is', the counted value" : "'is' is valid with count and share only");
    }
  }

  void equal(size_t x, size_t y, const std::string& at) {
    if (x != y) fault(at, fmt::format("{} x values, but {} y values", x, y));
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
  ErrorList& faults_;
  std::optional<std::string> tuned_on_;
  std::set<std::string> names_, used_;
};

/// Returns the override that selects the sensors; the path is relative to the scenario's folder.
std::string sensor_override(const Paper& paper, const std::string& scenario, const std::string& sensor) {
  namespace fs = std::filesystem;
  const fs::path file = fs::absolute(paper.folder / ".." / "sensors" / (sensor + ".yaml")).lexically_normal();
  const fs::path folder = fs::absolute(scenario).lexically_normal().parent_path();
  return "rig.sensor.use=" + file.lexically_relative(folder).string();
}

constexpr FormerKey kFormerPaperKeys[] = {
    {.path = "flights.*", .key = "printed", .advice = "its name is now 'published'"},
    {.path = "flights.*", .key = "beside", .advice = "its name is now 'sensor_seeds'"},
    {.path = "rows.*", .key = "what", .advice = "its name is now 'claim'"},
    {.path = "rows.*", .key = "statistic", .value = "least", .advice = "its name is now 'min'"},
    {.path = "rows.*", .key = "statistic", .value = "greatest", .advice = "its name is now 'max'"},
    {.path = "charts.*.series.*", .key = "statistic", .value = "least", .advice = "its name is now 'min'"},
    {.path = "charts.*.series.*", .key = "statistic", .value = "greatest", .advice = "its name is now 'max'"},
};

}  // namespace

bool counts(FlightFigure::Statistic statistic) {
  return statistic == FlightFigure::Statistic::count || statistic == FlightFigure::Statistic::share;
}

std::vector<FlightGroup> flight_groups(const Paper& paper) {
  std::vector<FlightGroup> groups;
  for (const PaperFlights& flights : paper.flights) {
    const FlightGroup modified{flights.name, flights.scenario, flights.seeds, flights.quick, flights.set};
    groups.push_back(modified);
    if (!flights.published.empty()) {
      FlightGroup& published = groups.emplace_back(modified);
      published.name += "/published";
      published.seeds = flights.published_seeds.value_or(flights.seeds);
      published.set.insert(published.set.end(), flights.published.begin(), flights.published.end());
    }
    for (const std::string& sensor : flights.sensors) {
      FlightGroup& other = groups.emplace_back(modified);
      other.name += "/" + sensor;
      other.seeds = flights.sensor_seeds.value_or(flights.seeds);
      other.quick.reset();
      other.set.push_back(sensor_override(paper, flights.scenario, sensor));
    }
  }
  return groups;
}

Paper read_paper(const std::filesystem::path& file) {
  ErrorList faults("paper", kFormerPaperKeys);
  const Node root = load_tree(file, faults);
  Paper paper{.key = file.stem().string(), .folder = file.parent_path()};
  if (root.kind == Node::Kind::map) read_struct(root, "", "", paper, faults);
  faults.throw_if_any();
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
  faults.throw_if_any();
  return paper;
}

}  // namespace hedgehop::sim
