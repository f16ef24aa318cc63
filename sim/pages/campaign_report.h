#pragma once

#include <filesystem>
#include <optional>

namespace hedgehop::sim {

/// Writes `report.html` into a batch's or sweep's folder from what lies there: its table of flights and each flight's
/// result.json, scenario.yaml, trajectory.csv and strip.jpg; a flight whose folder is gone keeps its row. One file, no
/// network.
/// @param against  folder of an earlier campaign; the same flights are compared, see against_data().
/// Throws as read_flights(), and std::runtime_error naming the file that cannot be written.
void write_campaign_report(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& against);

}  // namespace hedgehop::sim
