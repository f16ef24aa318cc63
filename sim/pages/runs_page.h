#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace hedgehop::sim {

/// Returns the results of a folder tree, sorted by folder: `runs`, each with name, folder (relative), campaign (folder
/// of the innermost batch or sweep that it belongs to, or ""), module, seed (a text), build, date (UTC), outcome,
/// verdict, figures, tags, notes and report (whether it has one); `campaigns`, each with kind, folder, flights, passed,
/// build and date; `unread`, the folders whose results cannot be read, with the cause.
nlohmann::ordered_json runs_data(const std::filesystem::path& folder);

/// Content of an index of results.
struct RunsPage {
  size_t results = 0;
  std::vector<std::string> unread;  ///< folders whose results cannot be read, with the cause
};

/// Writes `index.html` into the folder: a table of all results, sorted by a click. It needs no server.
/// Throws InputError if there is no readable result, with the cause for each unreadable one, and PagesAbsent.
RunsPage write_runs_page(const std::filesystem::path& folder);

}  // namespace hedgehop::sim
