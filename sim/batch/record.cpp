#include "sim/batch/record.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "sim/flight/build.h"
#include "sim/record/run_record.h"
#include "sim/record/whole_file.h"

namespace hedgehop::sim {

std::string resolved_yaml(Scenario scenario, uint64_t seed) {
  scenario.seed = seed;
  scenario.film.enabled = false;
  return to_yaml(scenario);
}

std::vector<std::string> run_arguments(const Order& order) {
  std::vector<std::string> arguments{"run", order.scenario.string(), "--seed", std::to_string(order.seed)};
  for (const std::string& text : order.overrides) {
    arguments.emplace_back("--set");
    arguments.push_back(text);
  }
  return arguments;
}

std::string rerun_command(const Order& order) {
  std::string command = "hedgehop";
  for (const std::string& argument : run_arguments(order)) command += " " + shell_quoted(argument);
  return command;
}

std::string shell_quoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string_view to_string(FlightRecord::Status status) {
  switch (status) {
    case FlightRecord::Status::flown:
      return "flown";
    case FlightRecord::Status::failed:
      return "failed";
    case FlightRecord::Status::missing:
      return "missing";
  }
  return "";
}

bool passed(const FlightRecord& record) {
  if (record.status != FlightRecord::Status::flown || record.result.at("outcome") == "fault") return false;
  const auto& checks = record.result.at("checks");
  return !checks.empty() &&
         std::ranges::all_of(checks, [](const auto& c) { return c.at("passed").template get<bool>(); });
}

bool unchecked(const FlightRecord& record) {
  return record.status == FlightRecord::Status::flown && record.result.at("outcome") != "fault" &&
         record.result.at("checks").empty();
}

std::string outcome_words(const FlightRecord& record) {
  if (record.status == FlightRecord::Status::flown) return record.result.at("outcome").get<std::string>();
  return std::string(to_string(record.status));
}

std::string build_of(const FlightRecord& record) {
  return record.result.is_object() ? record.result.value("build", "") : "";
}

std::vector<std::string> truth_used(const FlightRecord& record) {
  if (!record.result.is_object()) return {};
  return record.result.value("truth_used", std::vector<std::string>{});
}

std::string truth_words(const std::vector<FlightRecord>& records) {
  std::set<std::string> all;
  size_t flights = 0;
  for (const FlightRecord& record : records) {
    const std::vector<std::string> truth = truth_used(record);
    flights += truth.empty() ? 0 : 1;
    all.insert(truth.begin(), truth.end());
  }
  return flights == 0 ? "" : fmt::format("Truth used by {} flights: {}\n", flights, fmt::join(all, "; "));
}

std::set<std::string> builds_of(const std::vector<FlightRecord>& records) {
  std::set<std::string> builds;
  for (const FlightRecord& record : records) {
    if (record.status == FlightRecord::Status::flown) builds.insert(build_of(record));
  }
  return builds;
}

std::string several_builds_words(const std::vector<FlightRecord>& records) {
  const std::set<std::string> builds = builds_of(records);
  if (builds.size() < 2) return "";
  return fmt::format("Flights of {} builds: {}\n", builds.size(), fmt::join(builds, ", "));
}

std::optional<nlohmann::ordered_json> result_left_by(const Order& order, const std::filesystem::path& folder,
                                                     bool other_builds) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder / "result.json", ignored)) return {};
  try {
    if (read_file_whole(folder / "scenario.yaml") != order.scenario_yaml) return {};
    nlohmann::ordered_json result = read_result(folder / "result.json");
    if (!other_builds && result.value("build", "") != build_identity()) return {};
    if (result.value("seed", uint64_t{0}) != order.seed) return {};
    if (result.value("inputs", decltype(order.inputs){}) != order.inputs) return {};
    return result;
  } catch (const nlohmann::json::exception&) {
  } catch (const std::runtime_error&) {
  }
  return {};
}

}  // namespace hedgehop::sim
