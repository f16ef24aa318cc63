#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/batch/campaign_file.h"
#include "sim/batch/flight_table.h"

namespace hedgehop::sim {

/// Writes the leaderboard into the folder of the batch, so that a report needs this folder only.
void write_leaderboard(const std::filesystem::path& folder, const Leaderboard& board);

/// Removes the leaderboard of an earlier batch from the folder.
void forget_leaderboard(const std::filesystem::path& folder);

/// Returns the matrix of a batch; null if the folder has no leaderboard. `worlds` in the order of increasing
/// difficulty, each with its `difficulty` (1 minus the mean success rate of the modules that fly there, without the
/// control; null without modules), `modules`, `cells`: counts, Wilson intervals (95 %) of success and of collisions,
/// minimum and median clearance to obstacles, and medians of path excess, mean speed and decision time; and `totals`:
/// the same for all flights of each module. Throws std::runtime_error that names a file that cannot be read.
nlohmann::ordered_json leaderboard_data(const std::filesystem::path& folder, const FlightList& flights);

/// Returns the matrix in Markdown: success of each module in each world; collisions and speed of each module over all
/// its worlds; a row with all figures for each cell; the reasons for missing cells. @param data  of leaderboard_data(),
/// not null.
std::string leaderboard_text(const nlohmann::ordered_json& data);

}  // namespace hedgehop::sim
