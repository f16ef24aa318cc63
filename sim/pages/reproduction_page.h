#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/reproduce/paper_row.h"
#include "sim/reproduce/results_page.h"

namespace hedgehop::sim {

/// What the page draws of a paper: its rows, and its charts as lines of points or, of paths, over the scene. Flights
/// that left no log are left out.
nlohmann::ordered_json paper_data(const PaperOutcome& outcome, const std::vector<RowOutcome>& rows);

/// One HTML text for all papers. @param papers  each as paper_data() gives it.
std::string reproduction_page(const nlohmann::ordered_json& papers, const PageFacts& facts);

}  // namespace hedgehop::sim
