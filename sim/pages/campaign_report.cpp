#include "sim/pages/campaign_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "sim/batch/campaign_file.h"
#include "sim/batch/group_verdict.h"
#include "sim/config/input_error.h"
#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/evidence/batch_record.h"
#include "sim/evidence/conduct.h"
#include "sim/flight/build.h"
#include "sim/flight/json_file.h"
#include "sim/pages/campaign_changes.h"
#include "sim/pages/campaign_data.h"
#include "sim/pages/flight_maps.h"
#include "sim/pages/leaderboard_page.h"
#include "sim/pages/report_page.h"
#include "sim/pages/sweep_data.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the upper bound of the rate of an event that did not occur in n flights.
Json limit_without_event(int64_t n) {
  const auto flights = static_cast<double>(n);
  return {
      {"flights", n}, {"three_over_n", 3.0 / flights}, {"limit", -std::expm1(std::log1p(-kTableConfidence) / flights)}};
}

// Limit for all paths of a page together, so that pages with many flights remain small and fast.
constexpr size_t kMaxPointsOfPage = 300'000, kMaxPointsOfPath = 400, kMinPointsOfPath = 10;

std::string name_of(const std::filesystem::path& folder) {
  const std::filesystem::path whole = std::filesystem::absolute(folder / "").lexically_normal();
  return whole.parent_path().filename().string();
}

std::vector<std::optional<FlownPath>> read_paths(const std::filesystem::path& folder,
                                                 const std::vector<FlightRecord>& records) {
  const size_t share = kMaxPointsOfPage / std::max<size_t>(1, records.size());
  std::vector<std::optional<FlownPath>> paths;
  for (const FlightRecord& record : records) {
    paths.emplace_back(
        read_path(folder / record.order.id, record.order.seed, std::clamp(share, kMinPointsOfPath, kMaxPointsOfPath)));
  }
  return paths;
}

/// Returns the groups of flights of a leaderboard's control, which a mean over modules must not contain.
std::set<std::string> control_groups(const Json& board) {
  std::set<std::string> groups, names;
  if (board.is_null()) return groups;
  for (const Json& module : board.at("modules")) {
    if (module.at("control").get<bool>()) names.insert(module.at("name").get<std::string>());
  }
  for (const Json& cell : board.at("cells")) {
    if (names.contains(cell.at("module").get<std::string>())) groups.insert(cell.at("group").get<std::string>());
  }
  return groups;
}

/// Whether a stopping rule decided on the number of flights.
bool has_stopping_rule(const Json& conduct) { return !conduct.is_null() && !conduct.at("sequential").empty(); }

/// Returns the description that the file of a batch, a sweep or a search states; "" if it states none.
std::string description_of(const std::filesystem::path& folder, const Json& conduct) {
  if (conduct.is_object() && conduct.contains("description")) return conduct["description"].get<std::string>();
  for (const char* const name : {"sweep.json", "falsify.json"}) {
    if (!std::filesystem::exists(folder / name)) continue;
    const Json record = read_json(folder / name);
    if (record.is_object()) return record.value("description", "");
  }
  return "";
}

/// Returns the result of a search for failures with the paths of the stored failures; null for any other campaign.
Json search_data(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "falsify.csv")) return nullptr;
  const std::filesystem::path file = folder / "falsify.json";
  Json search = read_json(file);
  std::vector<std::optional<FlownPath>> paths;
  try {
    if (search.contains("seed")) search["seed"] = search["seed"].dump();  // a text is exact
    for (const Json& one : search.at("counterexamples")) {
      paths.push_back(
          read_path(folder / one.at("folder").get<std::string>(), one.at("seed").get<uint64_t>(), kMaxPointsOfPath));
    }
  } catch (const Json::exception& error) {
    throw InputError(json_fault(file, error, "the record of a search"));
  }
  search["paths"] = paths_data(flight_maps(paths), paths);
  return search;
}

}  // namespace

Json claims_data(const std::filesystem::path& folder, const std::vector<FlightRecord>& with_refused,
                 const std::set<std::string>& controls) {
  const std::vector<FlightRecord> records = without_refused(with_refused);
  const GroupSummary all = all_flights(records, controls);
  const Json conduct = conduct_data(folder);
  const bool sequential = has_stopping_rule(conduct);
  const auto interval = [&](Count count) -> Json {
    const Interval i = success_interval(count, sequential);
    return {i.low, i.high};
  };
  const int64_t of_controls = static_cast<int64_t>(records.size()) - all.flights;
  const int64_t planned = conduct.is_null() ? all.flights : conduct.at("planned").get<int64_t>() - of_controls;
  const int64_t discarded = sequential ? planned - all.flights : 0;
  const int64_t broken = all.fault + all.failed;
  Json data{{"counts",
             {{"planned", planned},
              {"counted", all.success.trials},
              {"passed", all.success.successes},
              {"failed_a_check", all.success.trials - all.success.successes - broken},
              {"broken", broken},
              {"missing", all.missing},
              {"discarded", discarded},
              {"no_checks", all.unchecked}}},
            {"method", sequential ? "anytime" : "wilson"},
            {"interval", interval(all.success)},
            {"if_missing", nullptr},
            {"no_collision", nullptr},
            {"conduct", conduct}};
  if (all.missing > 0) {
    const int64_t trials = all.success.trials + all.missing;
    data["if_missing"] = {interval({all.success.successes, trials}),
                          interval({all.success.successes + all.missing, trials})};
  }
  const int64_t ended = all.flights - all.missing;
  if (ended > 0 && all.collided + broken == 0 && !sequential) data["no_collision"] = limit_without_event(ended);
  return data;
}

void write_campaign_report(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& against) {
  const FlightList flights = read_flights(folder);
  const std::vector<FlightNotes> notes = read_notes(folder, flights.records);
  std::set<std::string> scenarios;
  for (const FlightRecord& record : flights.records) scenarios.insert(record.order.scenario.filename().string());

  Json data{{"name", name_of(folder)}, {"folder", folder.string()}, {"is_sweep", flights.is_sweep}};
  data["scenarios"] = scenarios;
  data["version"] = std::string(version());
  data["build"] = std::string(build_identity());
  data["builds"] = builds_of(flights.records);
  data["mixture"] = mixture_words(flights.records);
  data["truth_used"] = truth_words(flights.records);
  data["swept"] = swept_columns(flights);
  data["sweep"] = sweep_data(folder, flights);
  data["leaderboard"] = leaderboard_data(folder, flights);
  const std::set<std::string> controls = control_groups(data["leaderboard"]);
  data["controls"] = controls;
  data["claims"] = claims_data(folder, flights.records, controls);
  data["description"] = description_of(folder, data["claims"]["conduct"]);
  data["groups"] = groups_data(flights.records, data["claims"]["method"] == "anytime", controls);
  data["columns"] = columns_data(flights.table, notes);
  for (const char* key : {"why", "failed", "report", "replay"}) data[key] = Json::array();
  for (const FlightNotes& note : notes) {
    data["why"].push_back(note.why);
    data["failed"].push_back(note.first_failed);
    data["report"].push_back(note.has_report ? 1 : 0);
    data["replay"].push_back(note.has_replay ? 1 : 0);
  }
  data["strips"] = strips_data(folder, flights.records);
  const auto paths = read_paths(folder, flights.records);
  data["paths"] = paths_data(flight_maps(paths), paths);
  data["search"] = search_data(folder);
  data["against"] = nullptr;
  if (against) {
    const FlightList earlier = read_flights(*against);
    data["against"] = against_data(
        flights, earlier,
        {.now = has_stopping_rule(data["claims"]["conduct"]), .before = has_stopping_rule(conduct_data(*against))});
    data["against"]["name"] = against->string();
    data["against"]["settings"] = campaign_setting_changes(folder, flights.records, *against, earlier.records);
    std::vector<FlightRecord> both = flights.records;
    both.insert(both.end(), earlier.records.begin(), earlier.records.end());
    data["against"]["mixture"] = mixture_words(both);
  }
  const std::string text = json_text(data);
  write_file_whole(folder / "report.html", campaign_page(name_of(folder), text));
}

}  // namespace hedgehop::sim
