#include "sim/pages/campaign_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "sim/batch/group_verdict.h"
#include "sim/batch/statistics.h"
#include "sim/config/config_outline.h"
#include "sim/config/numbers.h"
#include "sim/config/whole_file.h"
#include "sim/evidence/batch_record.h"
#include "sim/flight/json_reader.h"
#include "sim/flight/result_io.h"
#include "sim/pages/report_page.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMaxStripBytes = 2'500'000;  // limit for pages below 10 MB; base64 adds a third
const std::set<std::string> kWordColumns = {"id",       "group",           "scenario", "status", "outcome",
                                            "cause",    "trajectory_hash", "command",  "build",  "truth_used",
                                            "renderer", "libraries",       "point"};

/// Returns a number with six significant figures.
Json six(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == std::round(value) && std::abs(value) < 1e15) return static_cast<int64_t>(value);
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

/// Returns the numbers of a column; none if a field is not a number.
std::optional<std::vector<double>> all_numbers(const std::vector<std::string>& words) {
  std::vector<double> numbers(words.size(), NAN);
  for (size_t i = 0; i < words.size(); ++i) {
    if (words[i].empty()) continue;
    const char* const end = words[i].data() + words[i].size();
    const auto [stop, error] = std::from_chars(words[i].data(), end, numbers[i]);
    if (error != std::errc() || stop != end) return {};
  }
  return numbers;
}

/// Adds the units of all fields with this path, such as "avoidance.speed", for any choice of type.
void add_units(const ConfigOutline& node, std::string_view path, std::set<std::string_view>& units) {
  if (path.empty()) units.insert(node.field.unit);
  const size_t dot = std::min(path.find('.'), path.size());
  const std::string_view rest = path.substr(std::min(dot + 1, path.size()));
  for (const ConfigOutline& item : node.item) add_units(item, rest, units);
  for (const ConfigOutline& choice : node.all) add_units(choice, path, units);
  for (const ConfigOutline& part : node.parts) {
    if (!path.empty() && part.key == path.substr(0, dot)) add_units(part, rest, units);
  }
}

std::string unit_of_parameter(const std::string& path) {
  static const ConfigOutline scenario{.parts = outline_fields(Scenario{})};
  std::set<std::string_view> units;
  add_units(scenario, path, units);
  return units.size() == 1 ? std::string(*units.begin()) : "";
}

Json group_row(const GroupSummary& group, bool anytime) {
  const Interval interval = success_interval(group.success, anytime);
  return {{"group", group.group},
          {"flights", group.flights},
          {"passed", group.success.successes},
          {"ended", group.success.trials},
          {"low", interval.low},
          {"high", interval.high},
          {"reached", group.reached},
          {"collided", group.collided},
          {"timeout", group.timeout},
          {"broken", group.fault + group.failed},
          {"missing", group.missing},
          {"no_checks", group.unchecked},
          {"min_clearance_m", json_number(group.min_clearance_m)},
          {"median_clearance_m", json_number(group.median_clearance_m)},
          {"median_time_s", json_number(group.median_time_s)}};
}

/// Returns the name of the failed check with the earliest time; checks of the whole flight are last. A collision counts
/// as the check for collisions, because a check of the clearance fails before it.
std::string first_failed(const FlightRecord& record) {
  const Verdict verdict = verdict_of(record);
  if (holds(verdict)) return "";
  if (verdict == Verdict::not_flown) return outcome_words(record);
  if (record.result->flight.outcome == Outcome::collided) return "no_collision";
  const CheckResult* first = nullptr;
  const auto time_s = [](const CheckResult& check) { return check.t_s.value_or(INFINITY); };
  for (const CheckResult& check : record.result->flight.checks) {
    if (!check.passed && (first == nullptr || time_s(check) < time_s(*first))) first = &check;
  }
  if (first == nullptr) return outcome_words(record);
  return first->name.empty() ? "unknown check" : first->name;  // a table without the flights' own files has no names
}

}  // namespace

std::string unit_of_column(const std::string& name, const std::vector<FlightNotes>& notes) {
  for (const FlightNotes& note : notes) {
    if (const auto found = note.units.find(name); found != note.units.end()) return found->second;
  }
  if (name.starts_with("time.") && name.find("_ms") != std::string::npos) return "ms";
  if (name.ends_with("_mps")) return "m/s";
  if (name.ends_with("_m")) return "m";
  return name.ends_with("_s") ? "s" : unit_of_parameter(name);
}

GroupSummary all_flights(std::vector<FlightRecord> records, const std::set<std::string>& without) {
  std::erase_if(records, [&](const FlightRecord& record) { return without.contains(record.order.group); });
  for (FlightRecord& record : records) record.order.group = "all flights";
  return records.empty() ? GroupSummary{.group = "all flights"} : summarize(records).front();
}

std::vector<FlightNotes> read_notes(const std::filesystem::path& folder, const std::vector<FlightRecord>& records) {
  std::vector<FlightNotes> notes(records.size());
  for (size_t i = 0; i < records.size(); ++i) {
    const std::filesystem::path flight = folder / records[i].order.id;
    const Verdict verdict = verdict_of(records[i]);
    if (verdict != Verdict::passed) {
      notes[i].why = verdict == Verdict::unchecked ? std::string(kNoChecks) : outcome_words(records[i]);
    }
    notes[i].first_failed = first_failed(records[i]);
    if (!records[i].cause.empty()) notes[i].why += ": " + records[i].cause;
    notes[i].has_report = std::filesystem::exists(flight / "report.html");
    notes[i].has_replay = std::filesystem::exists(flight / "replay.html");
    if (records[i].status != FlightRecord::Status::flown || !std::filesystem::exists(flight / "result.json")) continue;
    try {
      FlightRecord whole = records[i];
      whole.result = read_result(flight / "result.json");
      notes[i].why = failure_words(whole);
      notes[i].first_failed = first_failed(whole);
      for (const CheckResult& check : whole.result->flight.checks) {
        notes[i].units["check." + check.name] = check.unit;
      }
      for (const MetricValue& metric : whole.result->flight.metrics) {
        notes[i].units["metric." + metric.name] = metric.unit;
      }
    } catch (const std::runtime_error&) {  // incomplete result.json: the table is used
    }
  }
  return notes;
}

Json columns_data(const Table& table, const std::vector<FlightNotes>& notes) {
  Json columns = Json::array();
  const auto is_seed = [](const std::string& word) { return word.empty() || parse_unsigned(word); };
  for (const std::string& name : table.names()) {
    const std::vector<std::string> words = table.words(name);
    if (std::ranges::all_of(words, &std::string::empty)) continue;
    const auto numbers = kWordColumns.contains(name) ? std::nullopt : all_numbers(words);
    const bool is_seeds = name == "seed" && std::ranges::all_of(words, is_seed);
    Json column{
        {"name", name}, {"unit", unit_of_column(name, notes)}, {"is_text", !numbers && !is_seeds}, {"values", words}};
    if (numbers && !is_seeds) {
      column["values"] = Json::array();
      for (const double value : *numbers) column["values"].push_back(six(value));
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

Json strips_data(const std::filesystem::path& folder, const std::vector<FlightRecord>& records) {
  Json images = Json::array();
  size_t bytes = 0, omitted = 0;
  for (size_t row = 0; row < records.size(); ++row) {
    const std::filesystem::path file = folder / records[row].order.id / "strip.jpg";
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    if (error) continue;
    if (bytes + size > kMaxStripBytes) {
      ++omitted;
      continue;
    }
    bytes += size;
    images.push_back({row, base64(read_file_whole(file))});
  }
  return {{"images", images}, {"omitted", omitted}};
}

std::vector<std::string> swept_columns(const FlightList& flights) {
  if (!flights.is_sweep) return {};
  const auto& names = flights.table.names();
  const auto point = std::ranges::find(names, "point"), status = std::ranges::find(names, "status");
  return point < status ? std::vector<std::string>(point + 1, status) : std::vector<std::string>();
}

Json groups_data(const std::vector<FlightRecord>& records, bool anytime, const std::set<std::string>& controls) {
  const std::vector<GroupSummary> groups = summarize(records);
  Json rows = Json::array({group_row(all_flights(records, controls), anytime)});
  if (groups.size() > 1) {
    for (const GroupSummary& group : groups) rows.push_back(group_row(group, anytime));
  }
  return rows;
}

}  // namespace hedgehop::sim
