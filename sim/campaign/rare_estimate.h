#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/campaign/flight_event.h"
#include "sim/campaign/fly_orders.h"
#include "sim/campaign/subset_simulation.h"
#include "sim/campaign/table.h"

namespace hedgehop::sim {

/// What is left until an event happens: of a collision the least clearance, m; of a figure its distance from the
/// threshold. 0 or less where the event happens, -infinity where a flight left no result.
double margin_of(const FlightEvent& event, const FlightRecord& record);

/// Reads an event that has a margin. Throws InputError, one line, for others and for those that do not exist.
FlightEvent parse_graded_event(const std::string& text);

/// The scenario that is estimated, as the user named it.
struct EstimatedScenario {
  std::filesystem::path file;
  std::vector<std::string> overrides;
};

/// Name of a sample's flight, unique in its estimate; its folder.
std::string flight_id(const SubsetSample& sample);

/// The order that flies a sample: its seed and `chance` as an override, so that its command flies it again alone.
/// Throws InputError when the scenario is bad.
Order order_of(const EstimatedScenario& scenario, const SubsetSample& sample);

/// What became of the samples' flights, by flight_id().
using EstimateRecords = std::map<std::string, FlightRecord>;

/// One row a flight: run, level, chain, step, accepted, margin, and all of flight_table().
Table estimate_table(const std::vector<SubsetRun>& runs, const EstimateRecords& records);

/// All that was found, and how.
nlohmann::ordered_json estimate_json(const FlightEvent& event, const SubsetOptions& options,
                                     const std::vector<SubsetRun>& runs, const EstimateRecords& records);

/// The same for people: the estimate, its interval, the levels of each run, and the worst flights with their commands.
std::string estimate_text(const nlohmann::ordered_json& estimate);

}  // namespace hedgehop::sim
