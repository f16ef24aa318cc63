#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/pages/sweep_analysis.h"

namespace hedgehop::sim {

/// All points of a sweep, the best first, each with the command that flies its first seed.
std::string ranking_csv(const FlightList& flights, const SweepAnalysis& analysis);
/// The ten best points as a LaTeX table (package booktabs).
std::string ranking_latex(const SweepAnalysis& analysis);

/// Returns the indices of the points that no other beats in both columns, sorted by `figures`. Only points without
/// failed flights take part, if there are any.
/// @param figures  of the other column. @param less  whether less of it is better.
std::vector<size_t> pareto_front(const SweepAnalysis& analysis, const std::vector<PointFigure>& figures, bool less);
std::string pareto_csv(const SweepAnalysis& analysis, const std::string& other,
                       const std::vector<PointFigure>& figures);

/// The Sobol indices of the column. @param effects  of sweep_data(). Indices of a grid are exact: without intervals.
std::string indices_csv(const SweepAnalysis& analysis, const nlohmann::ordered_json& effects);
std::string indices_latex(const SweepAnalysis& analysis, const nlohmann::ordered_json& effects);

}  // namespace hedgehop::sim
