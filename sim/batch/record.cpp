#include "sim/batch/record.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "sim/flight/build.h"
#include "sim/flight/words.h"

namespace hedgehop::sim {

std::string resolved_yaml(Scenario scenario, uint64_t seed) {
  scenario.seed = seed;
  scenario.film.enabled = false;
  return to_yaml(scenario);
}

std::vector<std::string> run_arguments(const Order& order) {
  // A file whose name begins with '-' is no option.
  const std::string file = order.scenario.string();
  std::vector<std::string> arguments{"run", file.starts_with('-') ? "./" + file : file, "--seed",
                                     std::to_string(order.seed)};
  for (const std::string& text : order.overrides) {
    arguments.emplace_back("--set");
    arguments.push_back(text);
  }
  return arguments;
}

nlohmann::ordered_json read_batch_json(const std::filesystem::path& file) {
  try {
    nlohmann::ordered_json batch = read_json(file);
    for (const auto& group : batch.at("groups")) {
      if (!group.contains("least_clearance_m")) continue;
      throw InputError(
          fmt::format("{}: key 'groups.least_clearance_m' of an earlier version is now 'min_clearance_m'; fly again",
                      file.string()));
    }
    return batch;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(json_fault(file, error, kRecordOfBatch));
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
}

std::string rerun_command(const Order& order) {
  std::string command = "hedgehop";
  for (const std::string& argument : run_arguments(order)) command += " " + shell_quoted(argument);
  return command;
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

Verdict verdict_of(const FlightRecord& record) {
  return record.status == FlightRecord::Status::flown ? verdict_of(record.result->flight) : Verdict::not_flown;
}

std::string outcome_words(const FlightRecord& record) {
  const bool flown = record.status == FlightRecord::Status::flown;
  return std::string(flown ? to_string(record.result->flight.outcome) : to_string(record.status));
}

std::string shown_outcome(Outcome outcome, bool has_goal) {
  return outcome == Outcome::timeout && !has_goal ? "completed" : std::string(to_string(outcome));
}

std::string shown_outcome(const FlightRecord& record) {
  if (record.status != FlightRecord::Status::flown) return outcome_words(record);
  const FlightResult& flight = record.result->flight;
  return shown_outcome(flight.outcome, flight.goal_distance_m.has_value());
}

std::string build_of(const FlightRecord& record) { return record.result ? record.result->info.build : ""; }

std::vector<std::string> truth_used(const FlightRecord& record) {
  return record.result ? record.result->flight.truth_used : std::vector<std::string>();
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

std::string mixture_words(const std::vector<FlightRecord>& records) {
  std::set<std::string> renderers, libraries;
  for (const FlightRecord& record : records) {
    if (record.status != FlightRecord::Status::flown) continue;
    renderers.insert(renderer_words(record.result->flight.libraries));
    libraries.insert(library_words(record.result->flight.libraries));
  }
  renderers.erase("");  // tables of earlier versions do not name them
  libraries.erase("");
  const auto line = [](const std::set<std::string>& all, const char* format) {
    return all.size() < 2 ? "" : fmt::format(fmt::runtime(format), all.size(), fmt::join(all, "; "));
  };
  const std::set<std::string> builds = builds_of(records);
  std::string words =
      builds.size() < 2 ? "" : fmt::format("Flights of {} builds: {}\n", builds.size(), fmt::join(builds, ", "));
  words += line(renderers, "Flights with {} renderers, whose images differ: {}\n");
  words += line(libraries, "Flights with {} versions of libraries: {}\n");
  return words;
}

std::optional<RunResult> result_left_by(const Order& order, const std::filesystem::path& folder, bool other_builds) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder / "result.json", ignored)) return {};
  try {
    if (read_file_whole(folder / "scenario.yaml") != order.scenario_yaml) return {};
    RunResult result = read_result(folder / "result.json");
    const bool same_build = result.info.build == build_identity();
    if (!(same_build || other_builds) || result.info.seed != order.seed || result.info.inputs != order.inputs)
      return {};
    return result;
  } catch (const std::runtime_error&) {  // not a whole result of this version
    return {};
  }
}

}  // namespace hedgehop::sim
