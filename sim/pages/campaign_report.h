#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/batch/record.h"

namespace hedgehop::sim {

/// Returns the statistical summary of a page: `counts` (planned, counted, passed, failed a check, broken, missing,
/// discarded, no checks), `method` and `interval` (95 %) of the success rate, `if_missing` (the interval with missing
/// flights as failures and as passes; null if no flight is missing), `no_collision` (flights, 3/n and the exact
/// one-sided bound; null if a flight collided or broke), and `conduct` of conduct_data() (null for a sweep). Source of
/// the bounds without an event: [HanleyLippmanHand1983] p. 1743, the rule of three.
/// @param folder  of the campaign. @param records  of its table; those of refused orders do not count.
/// @param controls  groups that do not count.
nlohmann::ordered_json claims_data(const std::filesystem::path& folder, const std::vector<FlightRecord>& records,
                                   const std::set<std::string>& controls = {});

/// Writes `report.html` into the folder of a batch or sweep from its table of flights and the result.json,
/// scenario.yaml, trajectory.csv and strip.jpg of each flight. A flight without a folder keeps its row. The page is one
/// file and needs no network.
/// @param against  folder of an earlier campaign for a comparison, see against_data().
/// Throws as read_flights(), PagesAbsent, and std::runtime_error that names a file that cannot be written.
void write_campaign_report(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& against);

}  // namespace hedgehop::sim
