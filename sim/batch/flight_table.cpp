#include "sim/batch/flight_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/batch/folders.h"
#include "sim/config/input_error.h"
#include "sim/config/numbers.h"
#include "sim/config/utf8.h"
#include "sim/flight/words.h"
#include "sim/scenario/judge_metrics.h"
#include "sim/scenario/validate.h"

namespace hedgehop::sim {
namespace {

using Numbers = std::vector<double>;
using Words = std::vector<std::string>;

/// Integers up to here are exact as doubles.
constexpr uint64_t kMaxExactInteger = uint64_t{1} << 53;

struct Figure {
  const char *name, *unit;
  double (*value)(const FlightResult& result);
  bool whole = false;
};
/// Figures of a result that are the same whenever the flight is flown again.
constexpr Figure kFigures[] = {
    {"flight_time_s", "s", [](const FlightResult& r) { return r.flight_time_s; }},
    {"path_length_m", "m", [](const FlightResult& r) { return r.path_length_m; }},
    {"mean_speed_mps", "m/s", [](const FlightResult& r) { return r.mean_speed_mps; }},
    {"min_clearance_m", "m", [](const FlightResult& r) { return closest_approach(r).distance_m; }},
    {"min_obstacle_clearance_m", "m", [](const FlightResult& r) { return r.closest_obstacle.distance_m; }},
    {"min_ground_clearance_m", "m", [](const FlightResult& r) { return r.closest_ground.distance_m; }},
    {"goal_distance_m", "m", [](const FlightResult& r) { return r.goal_distance_m.value_or(NAN); }},
    {"decisions", "", [](const FlightResult& r) { return static_cast<double>(r.decisions); }, /*whole=*/true}};
constexpr Figure kTimes[] = {{"time.wall_s", "s", [](const FlightResult& r) { return r.wall_s; }},
                             {"time.realtime_factor", "", [](const FlightResult& r) { return r.realtime_factor; }}};
constexpr std::pair<const char*, StageTime FlightResult::*> kStages[] = {
    {"decision_ms", &FlightResult::decision_ms},
    {"render_ms", &FlightResult::render_ms},
    {"velocimeter_ms", &FlightResult::velocimeter_ms},
    {"physics_ms", &FlightResult::physics_ms}};

/// A figure under the name of its column.
struct NamedFigure {
  std::string column;
  double value = 0.0;
  std::string unit;
  FigureKind kind = FigureKind::judged;
};

std::vector<NamedFigure> check_figures(const FlightResult& result) {
  std::vector<NamedFigure> figures;
  std::vector<std::string> names = check_columns(result.checks);
  for (size_t i = 0; i < names.size(); ++i) {
    figures.push_back({std::move(names[i]), result.checks[i].value, result.checks[i].unit, FigureKind::judged});
  }
  return figures;
}

/// Metrics of wall time, or all others.
std::vector<NamedFigure> metric_figures(const FlightResult& result, bool of_wall_time) {
  std::vector<NamedFigure> figures;
  for (const MetricValue& metric : result.metrics) {
    if ((metric.kind == FigureKind::wall_time) != of_wall_time) continue;
    figures.push_back({(of_wall_time ? "time." : "metric.") + metric.name, metric.value, metric.unit, metric.kind});
  }
  return figures;
}

double finite_or_unknown(double value) { return std::isfinite(value) ? value : NAN; }

/// Builds the columns of a table of flights, one row per record.
class FlightColumns {
 public:
  explicit FlightColumns(const std::vector<FlightRecord>& records) : records_(records) {}

  template <class WordOf>
  void add_words(const char* name, WordOf word_of, std::optional<FigureKind> kind = {}) {
    Words words;
    for (const FlightRecord& record : records_) words.push_back(word_of(record));
    table_.add({.name = name, .values = std::move(words), .kind = kind});
  }
  void add_figure(const Figure& figure, FigureKind kind) {
    add_numbers(figure.name, figure.unit, kind, figure.value, figure.whole);
  }
  template <class ValueOf>
  void add_numbers(std::string name, const char* unit, FigureKind kind, ValueOf value_of, bool whole = false) {
    Numbers numbers;
    for (const FlightRecord& record : records_) {
      numbers.push_back(record.result ? finite_or_unknown(value_of(record.result->flight)) : NAN);
    }
    table_.add({.name = std::move(name), .values = std::move(numbers), .unit = unit, .kind = kind, .whole = whole});
  }
  /// Adds a column for every name that any record has, in the order of their first appearance.
  template <class FiguresOf>
  void add_named(FiguresOf figures_of) {
    std::vector<Table::Column> columns;
    for (size_t row = 0; row < records_.size(); ++row) {
      if (!records_[row].result) continue;
      for (NamedFigure& figure : figures_of(records_[row].result->flight)) {
        auto column = std::ranges::find(columns, figure.column, &Table::Column::name);
        if (column == columns.end()) {
          column = columns.insert(columns.end(), {.name = std::move(figure.column),
                                                  .values = Numbers(records_.size(), NAN),
                                                  .unit = std::move(figure.unit),
                                                  .kind = figure.kind});
        }
        std::get<Numbers>(column->values)[row] = finite_or_unknown(figure.value);
      }
    }
    for (Table::Column& column : columns) table_.add(std::move(column));
  }
  /// A seed that no double holds exactly makes its column one of words.
  void add_seeds() {
    Words words;
    Numbers numbers;
    for (const FlightRecord& record : records_) {
      words.push_back(std::to_string(record.order.seed));
      numbers.push_back(static_cast<double>(record.order.seed));
    }
    const bool exact =
        std::ranges::all_of(records_, [](const FlightRecord& record) { return record.order.seed <= kMaxExactInteger; });
    if (exact) {
      table_.add({.name = "seed", .values = std::move(numbers), .whole = true});
    } else {
      table_.add("seed", std::move(words));
    }
  }
  void add_passed() {
    Numbers numbers;
    for (const FlightRecord& record : records_) {
      const Verdict verdict = verdict_of(record);
      const bool open = verdict == Verdict::unchecked || record.status == FlightRecord::Status::missing;
      numbers.push_back(open ? NAN : verdict == Verdict::passed ? 1.0 : 0.0);
    }
    table_.add({.name = "passed", .values = std::move(numbers), .whole = true});
  }
  void add(Table::Column column) { table_.add(std::move(column)); }
  Table take() { return std::move(table_); }

 private:
  const std::vector<FlightRecord>& records_;
  Table table_;
};

constexpr const char* kTables[] = {"falsify.csv", "sweep.csv", "batch.csv"};

std::filesystem::path table_of(const std::filesystem::path& folder) {
  for (const char* name : kTables) {
    if (has_file(folder, name)) return folder / name;
  }
  throw InputError(fmt::format("{}: no folder of a batch (batch.csv), a sweep (sweep.csv) or a search (falsify.csv)",
                               folder.string()));
}

FlightRecord::Status status_of(const std::string& word) {
  for (const auto status : {FlightRecord::Status::flown, FlightRecord::Status::failed}) {
    if (word == to_string(status)) return status;
  }
  return FlightRecord::Status::missing;
}

/// A column that tables of earlier versions lack.
std::vector<std::string> words_of(const Table& table, const std::string& name) {
  return table.has(name) ? table.words(name) : std::vector<std::string>(table.rows());
}

std::vector<FlightRecord> records_of(const Table& table) {
  const auto ids = table.words("id"), groups = table.words("group"), scenarios = table.words("scenario");
  const auto seeds = table.words("seed"), statuses = table.words("status"), outcomes = table.words("outcome");
  const auto causes = table.words("cause"), passes = table.words("passed");
  const auto clearances = table.numbers("min_obstacle_clearance_m"), times = table.numbers("flight_time_s");
  const auto builds = words_of(table, "build"), truths = words_of(table, "truth_used");
  const auto renderers = words_of(table, "renderer"), libraries = words_of(table, "libraries");
  std::vector<FlightRecord> records(table.rows());
  for (size_t i = 0; i < records.size(); ++i) {
    FlightRecord& record = records[i];
    record.order = {.id = ids[i], .group = groups[i], .scenario = raw_name(scenarios[i])};
    record.order.seed = parse_unsigned(seeds[i]).value_or(0);
    record.status = status_of(statuses[i]);
    record.cause = causes[i];
    if (record.status != FlightRecord::Status::flown) continue;
    RunResult& result = record.result.emplace();
    result.info.build = builds[i];
    result.flight.libraries = {.images = libraries[i], .functions = {}, .others = {}, .renderer = renderers[i]};
    result.flight.outcome = parse_outcome(outcomes[i]).value_or(Outcome::fault);
    result.flight.cause = causes[i];
    if (!truths[i].empty()) result.flight.truth_used.push_back(truths[i]);
    if (!passes[i].empty()) result.flight.checks.push_back({.name = {}, .passed = passes[i] == "1", .unit = {}});
    const bool has_clearance = !std::isnan(clearances[i]);
    result.flight.closest_obstacle.distance_m = has_clearance ? clearances[i] : std::numeric_limits<double>::infinity();
    result.flight.flight_time_s = times[i];
  }
  return records;
}

}  // namespace

Table flight_table(const std::vector<FlightRecord>& records, const std::vector<Table::Column>& extra) {
  FlightColumns columns(records);
  columns.add_words("id", [](const FlightRecord& r) { return r.order.id; });
  columns.add_words("group", [](const FlightRecord& r) { return r.order.group; });
  columns.add_words("scenario", [](const FlightRecord& r) { return name_text(r.order.scenario.string()); });
  columns.add_seeds();
  for (const Table::Column& column : extra) columns.add(column);
  columns.add_words("status", [](const FlightRecord& r) { return std::string(to_string(r.status)); });
  columns.add_words("outcome", [](const FlightRecord& r) { return outcome_words(r); });
  columns.add_passed();
  columns.add_words("cause", [](const FlightRecord& r) { return r.result ? r.result->flight.cause : r.cause; });
  for (const Figure& figure : kFigures) columns.add_figure(figure, FigureKind::judged);
  columns.add_words(
      "trajectory_hash",
      [](const FlightRecord& r) { return r.result ? r.result->flight.trajectory_hash : std::string(); },
      FigureKind::judged);
  columns.add_named([](const FlightResult& result) { return metric_figures(result, /*of_wall_time=*/false); });
  columns.add_named(check_figures);
  columns.add_words("truth_used",
                    [](const FlightRecord& r) { return fmt::format("{}", fmt::join(truth_used(r), "; ")); });
  columns.add_words("build", [](const FlightRecord& r) { return build_of(r); });
  columns.add_words("renderer", [](const FlightRecord& r) {
    return r.result ? renderer_words(r.result->flight.libraries) : std::string();
  });
  columns.add_words("libraries", [](const FlightRecord& r) {
    return r.result ? library_words(r.result->flight.libraries) : std::string();
  });
  columns.add_words("command", [](const FlightRecord& r) { return rerun_command(r.order); });
  for (const Figure& figure : kTimes) columns.add_figure(figure, FigureKind::wall_time);
  columns.add_named([](const FlightResult& result) { return metric_figures(result, /*of_wall_time=*/true); });
  for (const auto& [name, stage] : kStages) {
    const std::string column = fmt::format("time.{}.", name);
    columns.add_numbers(column + "median", "ms", FigureKind::wall_time,
                        [stage = stage](const FlightResult& result) { return (result.*stage).median_ms; });
    columns.add_numbers(column + "p95", "ms", FigureKind::wall_time,
                        [stage = stage](const FlightResult& result) { return (result.*stage).p95_ms; });
  }
  return columns.take();
}

std::vector<std::string> check_columns(const std::vector<CheckResult>& checks) {
  std::vector<std::string> names;
  for (const CheckResult& check : checks) {
    const std::string base = "check." + check.name;
    std::string name = base;
    for (int i = 2; std::ranges::find(names, name) != names.end(); ++i) name = fmt::format("{}.{}", base, i);
    names.push_back(std::move(name));
  }
  return names;
}

std::optional<double> figure_of(const FlightResult& result, std::string_view column) {
  const auto* const figure = std::ranges::find_if(kFigures, [&](const Figure& f) { return f.name == column; });
  if (figure == std::end(kFigures)) return {};
  const double value = figure->value(result);
  const bool clearance = column.ends_with("clearance_m");
  return std::isfinite(value) || (clearance && !std::isnan(value)) ? std::optional(value) : std::nullopt;
}

std::string column_fault(const std::string& column, const Scenario& scenario) {
  if (column.starts_with(fmt::format("metric.{}", kModulePrefix)) || column.starts_with("time.")) return "";
  std::vector<std::string> names;
  for (const Figure& figure : kFigures) names.emplace_back(figure.name);
  for (const std::string_view metric : judge_metrics()) names.push_back(fmt::format("metric.{}", metric));
  for (const std::string& check : check_names(scenario)) names.push_back("check." + check);
  if (std::ranges::find(names, column) != names.end()) return "";
  for (const std::string& name : names) {
    if (name.ends_with("." + column)) return fmt::format("no column '{}'; did you mean '{}'?", column, name);
  }
  return fmt::format("no column '{}'{}", column, suggestion(column, {names.begin(), names.end()}));
}

bool is_campaign(const std::filesystem::path& folder) {
  return std::ranges::any_of(kTables, [&](const char* name) { return has_file(folder, name); });
}

FlightList read_flights(const std::filesystem::path& folder) {
  const std::filesystem::path file = table_of(folder);
  FlightList list{.is_sweep = file.filename() != "batch.csv", .table = Table(file), .records = {}};
  list.records = records_of(list.table);
  return list;
}

}  // namespace hedgehop::sim
