#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/batch/campaign_file.h"
#include "sim/batch/flight_table.h"

namespace hedgehop::sim {

/// Writes it beside the flights, so that a report needs the folder alone. @param folder  of the batch.
void write_leaderboard(const std::filesystem::path& folder, const Leaderboard& board);

/// Removes what an earlier batch wrote into the folder.
void forget_leaderboard(const std::filesystem::path& folder);

/// The matrix of a batch's flights; null where the folder has no leaderboard. `worlds` from the easiest to the hardest,
/// each with its `difficulty` (1 less the mean success rate of the modules that fly there, the control left out; null
/// without any), `modules`, `cells`: counts, Wilson intervals (95 %) of success and of collisions, least and median
/// clearance to obstacles, and medians of path excess, mean speed and decision time; and `totals`: the same for all
/// flights of each module. Throws std::runtime_error naming a file that cannot be read.
nlohmann::ordered_json leaderboard_data(const std::filesystem::path& folder, const FlightList& flights);

/// The matrix in Markdown: success of each module in each world, then collisions and speed of each module in all its
/// worlds together, then a row with all figures for each cell, then the reasons for what is not flown. @param data  of
/// leaderboard_data(), not null.
std::string leaderboard_text(const nlohmann::ordered_json& data);

}  // namespace hedgehop::sim
