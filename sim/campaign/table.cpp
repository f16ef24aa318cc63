#include "sim/campaign/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "sim/record/csv_line.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

/// Figures of result.json that are the same whenever the flight is flown.
constexpr const char* kFigures[] = {
    "flight_time_s",          "path_length_m",   "mean_speed_mps", "min_clearance_m", "min_obstacle_clearance_m",
    "min_ground_clearance_m", "goal_distance_m", "decisions",      "trajectory_hash"};
constexpr const char* kTimes[] = {"wall_s", "realtime_factor"};
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

/// Checks of one name get numbers from the second on: a scenario may check a thing twice.
std::vector<std::pair<std::string, Cell>> check_cells(const Json& result) {
  std::vector<std::pair<std::string, Cell>> cells;
  if (!result.is_object()) return cells;
  for (const Json& check : result.at("checks")) {
    const std::string base = "check." + check.at("name").get<std::string>();
    std::string name = base;
    for (int i = 2; std::ranges::any_of(cells, [&](const auto& c) { return c.first == name; }); ++i) {
      name = fmt::format("{}.{}", base, i);
    }
    cells.emplace_back(std::move(name), field(check, "value"));
  }
  return cells;
}

/// A module's own figures; those of wall time stand among the times, which differ from flight to flight.
bool is_time(const std::string& metric) { return metric.find("_ms") != std::string::npos; }

std::vector<std::pair<std::string, Cell>> metric_cells(const Json& result, const std::string& group, bool times) {
  std::vector<std::pair<std::string, Cell>> cells;
  if (!result.is_object()) return cells;
  for (const auto& [name, value] : result.at("metrics").items()) {
    if (is_time(name) == times) cells.emplace_back(group + name, cell(value));
  }
  return cells;
}

/// Adds a column for every name that any record has, in the order of their first appearance.
template <class CellsOf>
void add_named(Table& table, const std::vector<FlightRecord>& records, CellsOf cells_of) {
  const size_t first = table.columns.size();
  for (size_t row = 0; row < records.size(); ++row) {
    for (auto& [name, value] : cells_of(records[row].result)) {
      const auto begin = table.columns.begin() + static_cast<std::ptrdiff_t>(first);
      const auto column = static_cast<size_t>(std::find(begin, table.columns.end(), name) - table.columns.begin());
      if (column == table.columns.size()) table.columns.push_back(name);
      if (table.rows[row].size() <= column) table.rows[row].resize(column + 1);
      table.rows[row][column] = std::move(value);
    }
  }
  for (auto& row : table.rows) row.resize(table.columns.size());
}

template <class CellOf>
void add(Table& table, const std::vector<FlightRecord>& records, const std::string& name, CellOf cell_of) {
  table.columns.push_back(name);
  for (size_t row = 0; row < records.size(); ++row) table.rows[row].push_back(cell_of(records[row]));
}

}  // namespace

Table flight_table(const std::vector<FlightRecord>& records, const std::vector<ExtraColumn>& extra) {
  Table table;
  table.rows.resize(records.size());
  add(table, records, "id", [](const FlightRecord& r) { return r.order.id; });
  add(table, records, "group", [](const FlightRecord& r) { return r.order.group; });
  add(table, records, "scenario", [](const FlightRecord& r) { return r.order.scenario.string(); });
  add(table, records, "seed", [](const FlightRecord& r) { return seed_cell(r.order.seed); });
  for (const ExtraColumn& column : extra) {
    table.columns.push_back(column.name);
    for (size_t row = 0; row < records.size(); ++row) table.rows[row].push_back(column.cells.at(row));
  }
  add(table, records, "status", [](const FlightRecord& r) { return std::string(to_string(r.status)); });
  add(table, records, "outcome", [](const FlightRecord& r) { return outcome_words(r); });
  add(table, records, "passed", [](const FlightRecord& r) { return static_cast<int64_t>(passed(r)); });
  add(table, records, "cause", [](const FlightRecord& r) {
    return r.status == FlightRecord::Status::flown ? field(r.result, "cause") : Cell(r.cause);
  });
  for (const std::string name : kFigures) {
    add(table, records, name, [&](const FlightRecord& r) { return field(r.result, name); });
  }
  add_named(table, records, [](const Json& result) { return metric_cells(result, "metric.", /*times=*/false); });
  add_named(table, records, check_cells);
  add(table, records, "build", [](const FlightRecord& r) { return build_of(r); });
  add(table, records, "command", [](const FlightRecord& r) { return rerun_command(r.order); });
  for (const std::string name : kTimes) {
    add(table, records, "time." + name, [&](const FlightRecord& r) { return field(r.result, name); });
  }
  add_named(table, records, [](const Json& result) { return metric_cells(result, "time.", /*times=*/true); });
  for (const std::string name : kStages) {
    for (const std::string which : {"median", "p95"}) {
      add(table, records, fmt::format("time.{}.{}", name, which), [&](const FlightRecord& r) {
        return r.result.is_object() && r.result.contains(name) ? field(r.result.at(name), which) : Cell{};
      });
    }
  }
  return table;
}

std::string csv_text(const Table& table) {
  fmt::memory_buffer out;
  {
    CsvLine header(out);
    for (const std::string& name : table.columns) header.add(name);
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

}  // namespace hedgehop::sim
