#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "sim/pages/panels.h"
#include "sim/record/run_record.h"

namespace hedgehop::sim {

/// Returns the plots that both runs have, with the curves of both over common times.
std::vector<Panel> overlaid_panels(const std::vector<Panel>& own, const std::vector<Panel>& other);

/// Returns the comparison of a run with another one for the report, without its plots: `name`, `result` of the other
/// run, `first` (lines that name the first difference), `settings` ([key, other value, own value]), `path` {n, e} of
/// the other run in m, and `film` (base64, or a link).
/// @param folder  of the run, to which the link is relative. @param other_folder  of the other run.
nlohmann::ordered_json run_against_data(const std::filesystem::path& folder, const RunRecord& run,
                                        const std::filesystem::path& other_folder, const RunRecord& other);

}  // namespace hedgehop::sim
