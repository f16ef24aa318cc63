#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "sim/batch/record.h"

namespace hedgehop::sim {

/// What a page must state beside a rate: `counts` (planned, counted, passed, failed a check, broken, missing,
/// discarded, no checks), `method` and `interval` (95 %) of the success rate, `if_missing` (the interval with missing
/// flights as failures and as passes; null without any), `no_collision` (flights, 3/n and the exact one-sided limit,
/// where none collided or broke; else null), and `conduct` as conduct_data() has it (null for a sweep). Source of the
/// limits without an event: [HanleyLippmanHand1983] p. 1743, the rule of three.
/// @param folder  of the campaign. @param records  of its table.
nlohmann::ordered_json claims_data(const std::filesystem::path& folder, const std::vector<FlightRecord>& records);

/// Writes `report.html` into a batch's or sweep's folder from what lies there: its table of flights and each flight's
/// result.json, scenario.yaml, trajectory.csv and strip.jpg; a flight whose folder is gone keeps its row. One file, no
/// network.
/// @param against  folder of an earlier campaign; the same flights are compared, see against_data().
/// Throws as read_flights(), and std::runtime_error naming the file that cannot be written.
void write_campaign_report(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& against);

}  // namespace hedgehop::sim
