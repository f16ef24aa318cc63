#pragma once

#include <filesystem>
#include <string>

#include "scenes/scene.h"
#include "sim/record/run_record.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Writes `replay.html` into the folder of a run: the flight in three dimensions, with the surfaces of its scene and
/// the images of its cameras, which are rendered again. The page needs no network. Returns the reason why the page has
/// no images of cameras; empty without a fault. Throws PagesAbsent, and std::runtime_error with the file and the cause
/// if the page cannot be written.
std::string write_replay(const std::filesystem::path& run_folder, const RunRecord& run);

/// Returns the same page for a flight that has not begun. The page receives the flight as server-sent events from
/// `/events` (web/src/replay_live.js). Throws PagesAbsent.
std::string live_page(const Scenario& scenario, const scenes::Scene& scene);

}  // namespace hedgehop::sim
