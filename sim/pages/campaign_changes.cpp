#include "sim/pages/campaign_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "sim/batch/statistics.h"
#include "sim/config/include.h"
#include "sim/config/outline_texts.h"
#include "sim/config/whole_file.h"
#include "sim/evidence/batch_record.h"
#include "sim/flight/json_reader.h"
#include "sim/pages/campaign_data.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

/// Returns a key of scenario and seed, which is equal for flights that differ in their settings only.
std::string twin_key(const FlightRecord& record) {
  return fmt::format("{}\n{}", record.order.scenario.string(), record.order.seed);
}

Json rate(const Count& count, bool anytime) {
  const Interval interval = success_interval(count, anytime);
  return {{"passed", count.successes}, {"ended", count.trials}, {"low", interval.low}, {"high", interval.high}};
}

Json change_row(const GroupSummary& now, const GroupSummary& before, StoppedByRule stopped) {
  Json row{{"group", now.group},
           {"now", rate(now.success, stopped.now)},
           {"before", rate(before.success, stopped.before)},
           {"change", nullptr}};
  // The interval of a change requires numbers of flights that do not depend on the results.
  if (!stopped.now && !stopped.before && now.success.trials > 0 && before.success.trials > 0) {
    const Interval change = newcombe_difference(now.success, before.success, kTableConfidence);
    row["change"] = {now.success.rate() - before.success.rate(), change.low, change.high};
  }
  return row;
}

/// Returns the change over the flights that both campaigns have; over all flights if they have none in common.
Json total_row(std::vector<FlightRecord> now, const std::vector<FlightRecord>& before, const Partners& pairs,
               StoppedByRule stopped) {
  std::vector<FlightRecord> common_now, common_before;
  for (size_t i = 0; i < now.size(); ++i) {
    if (!pairs[i]) continue;
    common_now.push_back(now[i]);
    common_before.push_back(before[*pairs[i]]);
  }
  if (common_now.empty()) return change_row(all_flights(now), all_flights(before), stopped);
  Json row = change_row(all_flights(common_now), all_flights(common_before), stopped);
  if (common_now.size() < std::max(now.size(), before.size())) row["group"] = "flights in both";
  return row;
}

/// Returns the columns of the checks.
std::map<std::string, std::vector<double>> check_values(const Table& table) {
  std::map<std::string, std::vector<double>> columns;
  for (const std::string& name : table.names()) {
    if (name.starts_with("check.")) columns[name] = table.numbers(name);
  }
  return columns;
}

void collect(const Node& node, const std::string& path, std::map<std::string, std::string>& values) {
  const bool plain = std::ranges::all_of(node.items, [](const Node& item) { return item.kind == Node::Kind::scalar; });
  if (node.kind == Node::Kind::map) {
    for (const Entry& entry : node.entries) collect(entry.value, join_path(path, entry.key), values);
  } else if (node.kind == Node::Kind::list && !plain) {
    for (size_t i = 0; i < node.items.size(); ++i) collect(node.items[i], join_path(path, std::to_string(i)), values);
  } else {
    values[path] = flow_text(node);
  }
}

}  // namespace

Json setting_changes(const std::string& now_yaml, const std::string& before_yaml) {
  Json rows = Json::array();
  if (now_yaml == before_yaml) return rows;
  std::map<std::string, std::string> now, before;
  ErrorList ignored("scenario");
  collect(parse_yaml(now_yaml, "scenario.yaml", ignored), "", now);
  collect(parse_yaml(before_yaml, "scenario.yaml", ignored), "", before);
  for (const auto& [key, value] : before) now.try_emplace(key, "");
  for (const auto& [key, value] : now) {
    const auto found = before.find(key);
    const std::string old = found == before.end() ? "" : found->second;
    if (old != value) rows.push_back({key, old, value, unit_of_column(key, {})});
  }
  return rows;
}

Partners partners(const std::vector<FlightRecord>& now, const std::vector<FlightRecord>& before) {
  std::map<std::string, size_t> by_id;
  std::map<std::string, std::vector<size_t>> twins;
  std::map<std::string, size_t> count;
  for (size_t i = 0; i < before.size(); ++i) {
    by_id[before[i].order.id] = i;
    twins[twin_key(before[i])].push_back(i);
  }
  for (const FlightRecord& record : now) ++count[twin_key(record)];
  Partners found;
  for (const FlightRecord& record : now) {
    const auto same = by_id.find(record.order.id);
    const auto alike = twins.find(twin_key(record));
    if (same != by_id.end()) {
      found.emplace_back(same->second);
    } else if (alike != twins.end() && alike->second.size() == 1 && count.at(alike->first) == 1) {
      found.emplace_back(alike->second.front());
    } else {
      found.emplace_back();
    }
  }
  return found;
}

Json against_data(const FlightList& now, const FlightList& before, StoppedByRule stopped) {
  const Partners pairs = partners(now.records, before.records);
  const auto checks = check_values(before.table);
  const std::vector<std::string> commands = before.table.words("command");
  std::vector<double> goal_distances_m(before.records.size(), NAN);
  if (before.table.has("goal_distance_m")) goal_distances_m = before.table.numbers("goal_distance_m");
  Json json{{"flights", Json::array()}, {"groups", Json::array()}, {"gone", Json::array()}, {"no_change", nullptr}};
  if (stopped.now || stopped.before) {
    json["no_change"] =
        "The change has no interval, because flights were stopped depending on their results (--until). Each rate has "
        "its own 95 % interval.";
  }
  for (const std::optional<size_t>& pair : pairs) {
    if (!pair) {
      json["flights"].push_back(nullptr);
      continue;
    }
    const FlightRecord& old = before.records[*pair];
    const bool has_goal = !std::isnan(goal_distances_m[*pair]);
    Json row{{"outcome", old.result ? shown_outcome(old.result->flight.outcome, has_goal) : outcome_words(old)},
             {"passed", verdict_of(old) == Verdict::passed},
             {"command", commands[*pair]}};
    row["clearance_m"] = old.result ? json_number(old.result->flight.closest_obstacle.distance_m) : Json(nullptr);
    row["checks"] = Json::object();
    for (const auto& [name, values] : checks) row["checks"][name] = json_number(values[*pair]);
    row["time_s"] = old.result ? json_number(old.result->flight.flight_time_s) : Json(nullptr);
    json["flights"].push_back(std::move(row));
  }
  for (size_t i = 0; i < before.records.size(); ++i) {
    if (std::ranges::find(pairs, std::optional(i)) == pairs.end()) json["gone"].push_back(before.records[i].order.id);
  }

  json["groups"].push_back(total_row(now.records, before.records, pairs, stopped));
  const std::vector<GroupSummary> earlier = summarize(before.records), groups = summarize(now.records);
  for (const GroupSummary& group : groups) {
    const auto same = std::ranges::find(earlier, group.group, &GroupSummary::group);
    if (same != earlier.end() && groups.size() > 1) json["groups"].push_back(change_row(group, *same, stopped));
  }
  return json;
}

Json campaign_setting_changes(const std::filesystem::path& folder, const std::vector<FlightRecord>& now,
                              const std::filesystem::path& other_folder, const std::vector<FlightRecord>& before) {
  const Partners pairs = partners(now, before);
  std::set<std::string> seen;
  std::map<Json, std::vector<std::string>> groups;
  for (size_t i = 0; i < now.size(); ++i) {
    if (!pairs[i] || !seen.insert(now[i].order.group).second) continue;
    const std::filesystem::path own = folder / now[i].order.id / "scenario.yaml";
    const std::filesystem::path other = other_folder / before[*pairs[i]].order.id / "scenario.yaml";
    if (!std::filesystem::exists(own) || !std::filesystem::exists(other)) continue;
    for (const Json& change : setting_changes(read_file_whole(own), read_file_whole(other))) {
      groups[change].push_back(now[i].order.group);
    }
  }
  Json rows = Json::array();
  for (const auto& [change, names] : groups) {
    rows.push_back(change);
    rows.back().push_back(names);
  }
  return rows;
}

}  // namespace hedgehop::sim
