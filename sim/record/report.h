#pragma once

#include <filesystem>

namespace hedgehop::sim {

/// Writes `report.html` into a run's folder from what lies there: scenario.yaml, result.json, trajectory.csv,
/// decisions.csv and, when there is one, video.webm. The scene is made anew from the scenario and its seed. One file,
/// no network; a film below 40 MB is inside it, a larger one is linked beside it.
/// Throws std::runtime_error naming the file and the cause when one is missing, malformed or cannot be written.
void write_report(const std::filesystem::path& run_folder);

/// Writes `replay.html` into a run's folder, from the same files: the flight in three dimensions, to be played in a
/// browser without network. Throws as write_report().
void write_replay(const std::filesystem::path& run_folder);

}  // namespace hedgehop::sim
