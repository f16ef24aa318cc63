#pragma once

#include <filesystem>

#include "sim/record/run_record.h"

namespace hedgehop::sim {

/// Writes a run's `report.html` into its folder. One file, no network; a film (`video.webm` in the folder) below 40 MB
/// is inside it, a larger one is linked beside it. The page links `replay.html` where the folder has one.
/// Throws std::runtime_error naming the file and the cause when a film cannot be read or the page not be written.
void write_report(const std::filesystem::path& run_folder, const RunRecord& run);

/// Writes a run's `replay.html` into its folder: the flight in three dimensions, to be played in a browser without
/// network. Throws as write_report().
void write_replay(const std::filesystem::path& run_folder, const RunRecord& run);

}  // namespace hedgehop::sim
