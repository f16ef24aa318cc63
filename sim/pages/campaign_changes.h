#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/batch/flight_table.h"

/// Comparison of a campaign with an earlier one.
namespace hedgehop::sim {

/// For each flight of a campaign its row in the other campaign, if any.
using Partners = std::vector<std::optional<size_t>>;

/// Returns for each flight of `now` the flight of `before` with the same id, else the one with the same scenario and
/// seed if both are unique.
Partners partners(const std::vector<FlightRecord>& now, const std::vector<FlightRecord>& before);

/// Returns the keys of two resolved scenarios whose values differ: [key, value before, value now, unit], "" without
/// a value or unit.
/// Items of lists of maps or lists have a key each, such as `rig.cameras.0.width`.
nlohmann::ordered_json setting_changes(const std::string& now_yaml, const std::string& before_yaml);

/// Returns the setting_changes() of the first flight of each group: [key, value before, value now, unit,
/// groups].
/// @param folder, other_folder  of the campaigns. A flight without a stored scenario is left out.
nlohmann::ordered_json campaign_setting_changes(const std::filesystem::path& folder,
                                                const std::vector<FlightRecord>& now,
                                                const std::filesystem::path& other_folder,
                                                const std::vector<FlightRecord>& before);

/// Which of two campaigns was stopped depending on its results.
struct StoppedByRule {
  bool now = false, before = false;
};

/// Returns the comparison with an earlier campaign: `flights` (one per row of `now`; null if the earlier campaign lacks
/// the flight), `groups` with both rates and the 95 % interval of the change (the flights in both, then groups of equal
/// name), and the ids of removed flights. Flights are matched by id, else by scenario and seed if these are unique, so
/// that settings can be compared. With a stopping rule, that campaign's rates have intervals that are valid at any
/// time, and there is no change: `no_change` has the reason.
nlohmann::ordered_json against_data(const FlightList& now, const FlightList& before, StoppedByRule stopped = {});

}  // namespace hedgehop::sim
