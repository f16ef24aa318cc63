#include "sim/batch/flight_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/config/input_error.h"
#include "sim/config/numbers.h"
#include "sim/record/json_number.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

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
