#include "sim/pages/runs_page.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "sim/batch/flight_table.h"
#include "sim/config/config_tree.h"
#include "sim/config/input_error.h"
#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/flight/json_reader.h"
#include "sim/flight/result_io.h"
#include "sim/pages/report_page.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Time of the last change of a file, UTC.
std::string date_of(const fs::path& file) {
  std::error_code missing;
  const auto time = fs::last_write_time(file, missing);
  if (missing) return "";
  const auto seconds = std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::file_clock::to_sys(time));
  return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)));
}

std::string text_of(const Node& map, std::string_view key) {
  const Node* const node = map.find(key);
  return node && node->kind == Node::Kind::scalar ? node->text : "";
}

/// Adds module, tags and notes, which only the scenario of the run has. Without notes, its description is shown.
void add_scenario(const fs::path& folder, Json& row) {
  for (const char* key : {"module", "notes"}) row[key] = "";
  row["tags"] = Json::array();
  if (!fs::exists(folder / "scenario.yaml")) return;
  ErrorList ignored("scenario");
  const Node root = parse_yaml(read_file_whole(folder / "scenario.yaml"), "scenario.yaml", ignored);
  if (const Node* const avoidance = root.find("avoidance")) {
    for (const char* key : {"module", "plugin", "python"}) {
      if (row["module"] == "") row["module"] = text_of(*avoidance, key);
    }
  }
  row["notes"] = text_of(root, "notes");
  if (row["notes"] == "") row["notes"] = text_of(root, "description");
  if (const Node* const tags = root.find("tags")) {
    for (const Node& tag : tags->items) row["tags"].push_back(tag.text);
  }
}

std::string verdict_words(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "passed";
    case Verdict::unchecked:
      return "no checks";
    default:
      return "failed";
  }
}

Json run_row(const fs::path& folder, const std::string& name) {
  const RunResult result = read_result(folder / "result.json");
  const FlightResult& flight = result.flight;
  Json row{{"name", result.info.scenario}, {"folder", name}};
  add_scenario(folder, row);
  row["seed"] = std::to_string(result.info.seed);  // exact, unlike a number of a page
  row["build"] = result.info.build;
  row["date"] = date_of(folder / "result.json");
  row["outcome"] = shown_outcome(flight.outcome, flight.goal_distance_m.has_value());
  row["verdict"] = verdict_words(verdict_of(flight));
  row["flight_time_s"] = json_number(flight.flight_time_s);
  row["min_obstacle_clearance_m"] = json_number(flight.closest_obstacle.distance_m);
  row["report"] = fs::exists(folder / "report.html");
  return row;
}

Json campaign_row(const fs::path& folder, const std::string& name) {
  const FlightList flights = read_flights(folder);
  const auto passed = std::ranges::count_if(
      flights.records, [](const FlightRecord& record) { return verdict_of(record) == Verdict::passed; });
  const std::set<std::string> builds = builds_of(flights.records);
  const bool is_search = fs::exists(folder / "falsify.csv");
  const char* const table = is_search ? "falsify.csv" : flights.is_sweep ? "sweep.csv" : "batch.csv";
  return {{"kind", is_search          ? "search"
                   : flights.is_sweep ? "sweep"
                                      : "batch"},
          {"folder", name},
          {"flights", flights.records.size()},
          {"passed", passed},
          {"build", builds.size() == 1 ? *builds.begin() : fmt::format("{} builds", builds.size())},
          {"date", date_of(folder / table)},
          {"report", fs::exists(folder / "report.html")}};
}

}  // namespace

Json runs_data(const fs::path& folder) {
  std::vector<fs::path> folders{folder};
  for (const auto& entry : fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied)) {
    if (entry.is_directory() && !entry.is_symlink()) folders.push_back(entry.path());
  }
  std::ranges::sort(folders);
  Json data{{"runs", Json::array()}, {"campaigns", Json::array()}, {"unread", Json::array()}};
  std::vector<std::string> campaigns;  // that contain the folder, the innermost last
  for (const fs::path& one : folders) {
    const std::string name = one == folder ? "." : one.lexically_relative(folder).string();
    while (!campaigns.empty() && campaigns.back() != "." && !name.starts_with(campaigns.back() + "/")) {
      campaigns.pop_back();
    }
    try {
      if (is_campaign(one)) {
        data["campaigns"].push_back(campaign_row(one, name));
        campaigns.push_back(name);
      } else if (fs::exists(one / "result.json")) {
        Json row = run_row(one, name);
        row["campaign"] = campaigns.empty() ? "" : campaigns.back();
        data["runs"].push_back(std::move(row));
      }
    } catch (const std::runtime_error& error) {
      data["unread"].push_back(fmt::format("{}: {}", name, one_line(error.what())));
    }
  }
  return data;
}

RunsPage write_runs_page(const fs::path& folder) {
  Json data = runs_data(folder);
  const RunsPage page{.results = data["runs"].size() + data["campaigns"].size(),
                      .unread = data["unread"].get<std::vector<std::string>>()};
  if (page.results == 0) {
    std::vector<std::string> lines{folder.string() +
                                   (page.unread.empty() ? ": no result.json, batch.csv or sweep.csv in this folder tree"
                                                        : ": no result in this folder tree can be read")};
    lines.insert(lines.end(), page.unread.begin(), page.unread.end());
    throw InputError(lines);
  }
  data["folder"] = fs::absolute(folder).lexically_normal().string();
  const std::string text = json_text(data);
  write_file_whole(folder / "index.html", runs_html("Runs", text));
  return page;
}

}  // namespace hedgehop::sim
