#include "sim/pages/leaderboard_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "sim/batch/campaign_file.h"
#include "sim/batch/group_verdict.h"
#include "sim/batch/statistics.h"
#include "sim/config/input_error.h"
#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/fields/order_statistics.h"
#include "sim/flight/build.h"
#include "sim/flight/json_file.h"
#include "sim/flight/json_reader.h"
#include "sim/flight/words.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kLeaderboardFile = "leaderboard.json";  // in the folder of the batch

/// Returns the median of a column over some rows, without empty fields.
double median_of(const Table& table, const std::string& column, const std::vector<size_t>& rows) {
  if (!table.has(column)) return std::nan("");
  const std::vector<double> all = table.numbers(column);
  std::vector<double> some;
  for (const size_t row : rows) {
    if (!std::isnan(all[row])) some.push_back(all[row]);
  }
  return median(some);
}

/// Returns the figures of some groups. Without checks: only the number of flights. Without flights: an empty object.
Json figures(const FlightList& flights, const std::set<std::string>& groups) {
  std::vector<FlightRecord> records;
  std::vector<size_t> rows;
  for (size_t i = 0; i < flights.records.size(); ++i) {
    const Order& order = flights.records[i].order;
    if (is_refused(order) || !groups.contains(order.group)) continue;
    records.push_back(flights.records[i]);
    records.back().order.group.clear();  // one group for all
    rows.push_back(i);
  }
  Json data = Json::object();
  if (records.empty()) return data;
  const GroupSummary group = summarize(records).front();
  if (group.unchecked > 0) data["no_checks"] = group.unchecked;
  if (group.success.trials == 0) return data;
  const Interval passed = wilson_interval(group.success, kTableConfidence);
  // Flights without checks can collide, too. Whether a flight with a fault would have collided is unknown.
  const int64_t flown = group.flights - group.missing - group.failed - group.fault;
  const Interval collided = wilson_interval({group.collided, flown}, kTableConfidence);
  data["flights"] = group.success.trials;
  data["passed"] = group.success.successes;
  data["low"] = passed.low;
  data["high"] = passed.high;
  data["flown"] = flown;
  data["collided"] = group.collided;
  data["collided_low"] = collided.low;
  data["collided_high"] = collided.high;
  data["timeout"] = group.timeout;
  data["broken"] = group.fault + group.failed;
  data["min_clearance_m"] = json_number(group.min_clearance_m);
  data["median_clearance_m"] = json_number(group.median_clearance_m);
  data["path_excess"] = json_number(median_of(flights.table, "metric.path_excess", rows));
  data["mean_speed_mps"] = json_number(median_of(flights.table, "mean_speed_mps", rows));
  data["decision_ms"] = json_number(median_of(flights.table, "time.decision_ms.median", rows));
  return data;
}

Json cell_data(const Json& cell, const FlightList& flights) {
  Json data{{"world", cell.at("world")},
            {"module", cell.at("module")},
            {"group", cell.at("group")},
            {"reason", cell.at("reason")}};
  data.update(figures(flights, {cell.at("group").get<std::string>()}));
  return data;
}

/// Returns the figures of a module over all worlds.
Json total_data(const Json& module, const Json& cells, const FlightList& flights) {
  std::set<std::string> groups;
  int64_t worlds = 0;
  for (const Json& cell : cells) {
    if (cell.at("module") != module.at("name")) continue;
    groups.insert(cell.at("group").get<std::string>());
    worlds += cell.at("reason") == "" ? 1 : 0;
  }
  Json data{{"module", module.at("name")}, {"worlds", worlds}};
  data.update(figures(flights, groups));
  return data;
}

/// Returns lines with the builds, renderers and libraries if there are several, the build, and the truth used.
std::string origin_words(const std::vector<FlightRecord>& records) {
  return fmt::format("{}Build {}, Hedgehop {}\n{}", mixture_words(records), build_identity(), version(),
                     truth_words(records));
}

/// Returns the difficulty of a world; NaN if no module except the control has flown there.
double difficulty(const Json& world, const Json& modules, const Json& cells) {
  double sum = 0.0, count = 0.0;
  for (const Json& cell : cells) {
    if (cell.at("world") != world || cell.value("flights", 0) == 0) continue;
    const auto module = std::ranges::find_if(modules, [&](const Json& m) { return m.at("name") == cell.at("module"); });
    if (module->at("control").get<bool>()) continue;
    sum += cell.at("passed").get<double>() / cell.at("flights").get<double>();
    count += 1.0;
  }
  return 1.0 - sum / count;
}

const Json& cell_of(const Json& data, const Json& world, const Json& module) {
  return *std::ranges::find_if(data.at("cells"), [&](const Json& cell) {
    return cell.at("world") == world.at("name") && cell.at("module") == module.at("name");
  });
}

std::string words(const Json& value, const char* format = "{:.2f}") {
  if (!value.is_number()) return "-";
  std::string text = fmt::format(fmt::runtime(format), value.get<double>());
  if (text.find_first_of("123456789") == std::string::npos) std::erase(text, '-');  // no -0.00
  return text;
}

std::string name_cell(const Json& one, const char* key = "name") {
  return markdown_cell(one.at(key).get<std::string>());
}

/// Returns the number of collisions, with the number of flights that it refers to if that is not `flights`.
std::string collided_text(const Json& cell) {
  const auto collided = cell.at("collided").get<int64_t>(), flown = cell.at("flown").get<int64_t>();
  return flown == cell.at("flights") ? std::to_string(collided) : fmt::format("{} of {}", collided, flown);
}

std::string matrix_text(const Json& data) {
  std::string text = "| world | difficulty |";
  for (const Json& module : data.at("modules")) text += fmt::format(" {} |", name_cell(module));
  text += "\n|---|---|";
  for (size_t i = 0; i < data.at("modules").size(); ++i) text += "---|";
  for (const Json& world : data.at("worlds")) {
    text += fmt::format("\n| {} | {} |", name_cell(world), words(world.at("difficulty")));
    for (const Json& module : data.at("modules")) {
      const Json& cell = cell_of(data, world, module);
      if (cell.contains("passed")) {
        text +=
            fmt::format(" {} of {} ({:.2f} to {:.2f}) |", cell.at("passed").get<int64_t>(),
                        cell.at("flights").get<int64_t>(), cell.at("low").get<double>(), cell.at("high").get<double>());
      } else {
        const bool no_checks = cell.contains("no_checks");
        text += no_checks ? " no checks |" : cell.at("reason") == "" ? " missing |" : " not flown |";
      }
    }
  }
  return text + "\n";
}

/// Returns the table of collisions and speed of each module over all worlds.
std::string totals_text(const Json& data) {
  std::string text =
      "| module, all worlds | worlds | flights | passed | collided | 95 % interval of collisions | speed, m/s |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Json& total : data.at("totals")) {
    if (!total.contains("passed")) continue;
    const std::string interval = total.at("flown") == 0
                                     ? "-"
                                     : fmt::format("{:.3f} to {:.3f}", total.at("collided_low").get<double>(),
                                                   total.at("collided_high").get<double>());
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", name_cell(total, "module"),
                        total.at("worlds").get<int64_t>(), total.at("flights").get<int64_t>(),
                        total.at("passed").get<int64_t>(), collided_text(total), interval,
                        words(total.at("mean_speed_mps")));
  }
  return text;
}

std::string rows_text(const Json& data) {
  std::string text =
      "| world | module | flights | passed | collided | timeout | fault | minimum clearance, m | median minimum "
      "clearance, m | "
      "path excess | speed, m/s | decision, ms |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Json& world : data.at("worlds")) {
    for (const Json& module : data.at("modules")) {
      const Json& cell = cell_of(data, world, module);
      if (!cell.contains("passed")) continue;
      text += fmt::format("| {} | {} |", name_cell(world), name_cell(module));
      text +=
          fmt::format(" {} | {} | {} | {} | {} |", cell.at("flights").get<int64_t>(), cell.at("passed").get<int64_t>(),
                      collided_text(cell), cell.at("timeout").get<int64_t>(), cell.at("broken").get<int64_t>());
      for (const char* key : {"min_clearance_m", "median_clearance_m", "path_excess", "mean_speed_mps"}) {
        text += " " + words(cell.at(key)) + " |";
      }
      text += " " + words(cell.at("decision_ms"), "{:.1f}") + " |\n";
    }
  }
  return text;
}

/// Returns one line for each module with flights that have no checks, a fault or no result.
std::string collision_notes(const Json& data) {
  std::string text;
  for (const Json& total : data.at("totals")) {
    if (!total.contains("passed") || (total.at("broken") == 0 && total.at("flown") == total.at("flights"))) continue;
    text += fmt::format(
        "Collisions of {}: among its {} flights without a fault, with or without checks; fault or no result: {}.\n",
        total.at("module").get<std::string>(), total.at("flown").get<int64_t>(), total.at("broken").get<int64_t>());
  }
  return text;
}

/// Returns one line for each module and reason.
std::string reasons_text(const Json& data) {
  std::string text;
  std::set<std::string> listed;
  for (const Json& cell : data.at("cells")) {
    const auto module = cell.at("module").get<std::string>(), reason = cell.at("reason").get<std::string>();
    if (reason.empty() || !listed.insert(module + "\n" + reason).second) continue;
    std::string worlds;
    for (const Json& other : data.at("cells")) {
      if (other.at("module") != module || other.at("reason") != reason) continue;
      worlds += (worlds.empty() ? "" : ", ") + other.at("world").get<std::string>();
    }
    text += fmt::format("Not flown: {} in {}: {}.\n", module, worlds, reason);
  }
  return text;
}

}  // namespace

void write_leaderboard(const std::filesystem::path& folder, const Leaderboard& board) {
  Json json{{"worlds", Json::array()}, {"modules", Json::array()}, {"cells", Json::array()}};
  for (const LeaderboardWorld& world : board.worlds) json["worlds"].push_back({{"name", world.name}});
  for (const LeaderboardModule& module : board.modules) {
    json["modules"].push_back({{"name", module.name}, {"control", module.control}});
  }
  for (const LeaderboardCell& cell : board.cells) {
    json["cells"].push_back(
        {{"world", cell.world}, {"module", cell.module}, {"group", cell.group}, {"reason", cell.reason}});
  }
  std::filesystem::create_directories(folder);
  write_file_whole(folder / kLeaderboardFile, json_text(json, 1) + "\n");
}

void forget_leaderboard(const std::filesystem::path& folder) {
  std::filesystem::remove(folder / kLeaderboardFile);
  std::filesystem::remove(folder / "leaderboard.md");
}

Json leaderboard_data(const std::filesystem::path& folder, const FlightList& flights) {
  const std::filesystem::path file = folder / kLeaderboardFile;
  if (!std::filesystem::exists(file)) return nullptr;
  const Json board = read_json(file);
  try {
    Json data{{"origin", origin_words(flights.records)},
              {"worlds", board.at("worlds")},
              {"modules", board.at("modules")},
              {"cells", Json::array()},
              {"totals", Json::array()}};
    for (const Json& cell : board.at("cells")) data["cells"].push_back(cell_data(cell, flights));
    for (const Json& module : board.at("modules")) {
      data["totals"].push_back(total_data(module, board.at("cells"), flights));
    }
    for (Json& world : data["worlds"]) {
      world["difficulty"] = json_number(difficulty(world.at("name"), data["modules"], data["cells"]));
    }
    // Worlds of equal difficulty keep the order of the campaign. Worlds without flights are last.
    const auto key = [](const Json& world) {
      return world.at("difficulty").is_number() ? world.at("difficulty").get<double>() : 2.0;
    };
    auto worlds = data["worlds"].get<std::vector<Json>>();
    std::ranges::stable_sort(worlds, {}, key);
    data["worlds"] = worlds;
    return data;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(json_fault(file, error, "the record of a leaderboard"));
  }
}

std::string leaderboard_text(const Json& data) {
  return data.at("origin").get<std::string>() + "\n" + matrix_text(data) + "\n" + totals_text(data) + "\n" +
         rows_text(data) + "\n" + collision_notes(data) + reasons_text(data);
}

}  // namespace hedgehop::sim
