#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace hedgehop::sim {

/// Returns the results of a folder tree, sorted by folder: `runs`, each with name, folder (relative), campaign (folder
/// of the innermost batch or sweep that it belongs to, or ""), module, seed (a text), build, date (UTC), outcome,
/// verdict, figures, tags, notes and report (whether it has one); `campaigns`, each with kind, folder, flights, passed,
/// build and date; `unread`, the folders whose results cannot be read, with the cause.
nlohmann::ordered_json runs_data(const std::filesystem::path& folder);

/// Writes `index.html` into the folder: a table of all results, sorted by a click. It needs no server.
/// @return the number of results. Throws InputError if there is no result, and PagesAbsent.
size_t write_runs_page(const std::filesystem::path& folder);

}  // namespace hedgehop::sim
