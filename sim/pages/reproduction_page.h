#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/reproduce/paper_row.h"
#include "sim/reproduce/results_page.h"

namespace hedgehop::sim {

/// Returns the data of a paper: its rows, and its charts as lines of points, or as paths over a scene. Flights without
/// a log are omitted.
nlohmann::ordered_json paper_data(const PaperOutcome& outcome, const std::vector<RowOutcome>& rows);

/// Returns the page for all papers. @param papers  of paper_data(). Throws PagesAbsent.
std::string reproduction_page(const nlohmann::ordered_json& papers, const PageFacts& facts);

}  // namespace hedgehop::sim
