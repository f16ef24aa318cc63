#include "sim/batch/flight_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/config/input_error.h"
#include "sim/config/numbers.h"
#include "sim/record/csv_table.h"
#include "sim/record/json_number.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

struct Figure {
  const char *name, *unit;
};
/// Figures of result.json that are the same whenever the flight is re-simulated.
constexpr Figure kFigures[] = {{"flight_time_s", "s"},
                               {"path_length_m", "m"},
                               {"mean_speed_mps", "m/s"},
                               {"min_clearance_m", "m"},
                               {"min_obstacle_clearance_m", "m"},
                               {"min_ground_clearance_m", "m"},
                               {"goal_distance_m", "m"},
                               {"decisions", ""},
                               {"trajectory_hash", ""}};
constexpr Figure kTimes[] = {{"wall_s", "s"}, {"realtime_factor", ""}};
constexpr const char* kStages[] = {"decision_ms", "render_ms", "velocimeter_ms", "physics_ms"};

Cell cell(const Json& value) {
  if (value.is_number_integer()) return value.get<int64_t>();
  if (value.is_number()) return value.get<double>();
  if (value.is_boolean()) return static_cast<int64_t>(value.get<bool>());
  if (value.is_string()) return value.get<std::string>();
  return {};
}

Cell field(const Json& object, const std::string& key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found == object.end() || !object.is_object() ? Cell{} : cell(*found);
}

/// SQLite's integers have a sign; a seed that needs all 64 bits is a text.
Cell seed_cell(uint64_t seed) {
  if (seed > static_cast<uint64_t>(std::numeric_limits<int64_t>::max())) return std::to_string(seed);
  return static_cast<int64_t>(seed);
}

struct NamedCell {
  TableColumn column;
  Cell cell;
};

/// Checks of one name get numbers from the second on: a scenario may check a thing twice.
std::vector<NamedCell> check_cells(const Json& result) {
  std::vector<NamedCell> cells;
  if (!result.is_object()) return cells;
  for (const Json& check : result.at("checks")) {
    const std::string base = "check." + check.at("name").get<std::string>();
    std::string name = base;
    for (int i = 2; std::ranges::any_of(cells, [&](const auto& c) { return c.column.name == name; }); ++i) {
      name = fmt::format("{}.{}", base, i);
    }
    cells.push_back({{std::move(name), check.value("unit", ""), FigureKind::judged}, field(check, "value")});
  }
  return cells;
}

FigureKind kind_of(const Json& result, const std::string& metric) {
  const auto kinds = result.find("metric_kinds");
  const std::string kind = kinds == result.end() ? "" : kinds->value(metric, "");
  for (const FigureKind known : {FigureKind::module, FigureKind::wall_time}) {
    if (kind == to_string(known)) return known;
  }
  return FigureKind::judged;
}

/// Metrics of wall time, or all others.
std::vector<NamedCell> metric_cells(const Json& result, bool of_wall_time) {
  std::vector<NamedCell> cells;
  if (!result.is_object()) return cells;
  const Json units = result.value("metric_units", Json::object());
  for (const auto& [name, value] : result.at("metrics").items()) {
    const FigureKind kind = kind_of(result, name);
    if ((kind == FigureKind::wall_time) != of_wall_time) continue;
    cells.push_back({{(of_wall_time ? "time." : "metric.") + name, units.value(name, ""), kind}, cell(value)});
  }
  return cells;
}

/// Adds a column for every name that any record has, in the order of their first appearance.
template <class CellsOf>
void add_named(Table& table, const std::vector<FlightRecord>& records, CellsOf cells_of) {
  const size_t first = table.columns.size();
  for (size_t row = 0; row < records.size(); ++row) {
    for (NamedCell& named : cells_of(records[row].result)) {
      const auto begin = table.columns.begin() + static_cast<std::ptrdiff_t>(first);
      const auto found = std::ranges::find(begin, table.columns.end(), named.column.name, &TableColumn::name);
      const auto column = static_cast<size_t>(found - table.columns.begin());
      if (column == table.columns.size()) table.columns.push_back(std::move(named.column));
      if (table.rows[row].size() <= column) table.rows[row].resize(column + 1);
      table.rows[row][column] = std::move(named.cell);
    }
  }
  for (auto& row : table.rows) row.resize(table.columns.size());
}

template <class CellOf>
void add(Table& table, const std::vector<FlightRecord>& records, TableColumn column, CellOf cell_of) {
  table.columns.push_back(std::move(column));
  for (size_t row = 0; row < records.size(); ++row) table.rows[row].push_back(cell_of(records[row]));
}

constexpr const char* kTables[] = {"falsify.csv", "sweep.csv", "batch.csv"};

std::filesystem::path table_of(const std::filesystem::path& folder) {
  for (const char* name : kTables) {
    if (std::filesystem::exists(folder / name)) return folder / name;
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
std::vector<std::string> words_of(const CsvTable& table, const std::string& name) {
  const bool has = std::ranges::find(table.names(), name) != table.names().end();
  return has ? table.words(name) : std::vector<std::string>(table.rows());
}

std::vector<FlightRecord> records_of(const CsvTable& table) {
  const auto ids = table.words("id"), groups = table.words("group"), scenarios = table.words("scenario");
  const auto seeds = table.words("seed"), statuses = table.words("status"), outcomes = table.words("outcome");
  const auto causes = table.words("cause"), passes = table.words("passed");
  const auto clearances = table.numbers("min_obstacle_clearance_m"), times = table.numbers("flight_time_s");
  const auto builds = words_of(table, "build"), truths = words_of(table, "truth_used");
  std::vector<FlightRecord> records(table.rows());
  for (size_t i = 0; i < records.size(); ++i) {
    FlightRecord& record = records[i];
    record.order = {.id = ids[i], .group = groups[i], .scenario = scenarios[i]};
    record.order.seed = parse_unsigned(seeds[i]).value_or(0);
    record.status = status_of(statuses[i]);
    record.cause = causes[i];
    if (record.status != FlightRecord::Status::flown) continue;
    record.result =
        Json{{"outcome", outcomes[i]},
             {"build", builds[i]},
             {"truth_used", truths[i].empty() ? Json::array() : Json::array({truths[i]})},
             {"checks", passes[i].empty() ? Json::array() : Json::array({Json{{"passed", passes[i] == "1"}}})},
             {"min_obstacle_clearance_m", json_number(clearances[i])},
             {"flight_time_s", times[i]}};
  }
  return records;
}

}  // namespace

Table flight_table(const std::vector<FlightRecord>& records, const std::vector<ExtraColumn>& extra) {
  Table table;
  table.rows.resize(records.size());
  add(table, records, {"id", "", {}}, [](const FlightRecord& r) { return r.order.id; });
  add(table, records, {"group", "", {}}, [](const FlightRecord& r) { return r.order.group; });
  add(table, records, {"scenario", "", {}}, [](const FlightRecord& r) { return r.order.scenario.string(); });
  add(table, records, {"seed", "", {}}, [](const FlightRecord& r) { return seed_cell(r.order.seed); });
  for (const ExtraColumn& column : extra) {
    table.columns.push_back({column.name, "", {}});
    for (size_t row = 0; row < records.size(); ++row) table.rows[row].push_back(column.cells.at(row));
  }
  add(table, records, {"status", "", {}}, [](const FlightRecord& r) { return std::string(to_string(r.status)); });
  add(table, records, {"outcome", "", {}}, [](const FlightRecord& r) { return outcome_words(r); });
  add(table, records, {"passed", "", {}},
      [](const FlightRecord& r) { return unchecked(r) ? Cell() : Cell(static_cast<int64_t>(passed(r))); });
  add(table, records, {"cause", "", {}}, [](const FlightRecord& r) {
    return r.status == FlightRecord::Status::flown ? field(r.result, "cause") : Cell(r.cause);
  });
  for (const auto& [name, unit] : kFigures) {
    add(table, records, {name, unit, FigureKind::judged},
        [key = std::string(name)](const FlightRecord& r) { return field(r.result, key); });
  }
  add_named(table, records, [](const Json& result) { return metric_cells(result, /*of_wall_time=*/false); });
  add_named(table, records, check_cells);
  add(table, records, {"truth_used", "", {}},
      [](const FlightRecord& r) { return fmt::format("{}", fmt::join(truth_used(r), "; ")); });
  add(table, records, {"build", "", {}}, [](const FlightRecord& r) { return build_of(r); });
  add(table, records, {"command", "", {}}, [](const FlightRecord& r) { return rerun_command(r.order); });
  for (const auto& [name, unit] : kTimes) {
    add(table, records, {"time." + std::string(name), unit, FigureKind::wall_time},
        [key = std::string(name)](const FlightRecord& r) { return field(r.result, key); });
  }
  add_named(table, records, [](const Json& result) { return metric_cells(result, /*of_wall_time=*/true); });
  for (const std::string name : kStages) {
    for (const std::string which : {"median", "p95"}) {
      add(table, records, {fmt::format("time.{}.{}", name, which), "ms", FigureKind::wall_time},
          [&](const FlightRecord& r) {
            return r.result.is_object() && r.result.contains(name) ? field(r.result.at(name), which) : Cell{};
          });
    }
  }
  return table;
}

size_t column_index(const Table& table, std::string_view name) {
  return static_cast<size_t>(std::ranges::find(table.columns, name, &TableColumn::name) - table.columns.begin());
}

std::string csv_text(const Table& table) {
  fmt::memory_buffer out;
  {
    CsvLine header(out);
    for (const TableColumn& column : table.columns) header.add(std::string_view(column.name));
  }
  for (const std::vector<Cell>& row : table.rows) {
    CsvLine line(out);
    for (const Cell& value : row) {
      if (const auto* integer = std::get_if<int64_t>(&value)) {
        line.add(std::to_string(*integer));
      } else if (const auto* number = std::get_if<double>(&value)) {
        line.add(*number);
      } else if (const auto* text = std::get_if<std::string>(&value)) {
        line.add(*text);
      } else {
        line.add(std::string_view());
      }
    }
  }
  return fmt::to_string(out);
}

bool is_campaign(const std::filesystem::path& folder) {
  return std::ranges::any_of(kTables, [&](const char* name) { return std::filesystem::exists(folder / name); });
}

FlightList read_flights(const std::filesystem::path& folder) {
  const std::filesystem::path file = table_of(folder);
  FlightList list{.is_sweep = file.filename() != "batch.csv", .table = CsvTable(file), .records = {}};
  list.records = records_of(list.table);
  return list;
}

}  // namespace hedgehop::sim
