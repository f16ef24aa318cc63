#pragma once

#include <string_view>

/// Texts of the pages, put into the program when it is built (web/).
namespace hedgehop::sim {

extern const std::string_view kReportPage;     ///< HTML with `{{name}}` where parts go
extern const std::string_view kReportStyle;    ///< CSS of all pages
extern const std::string_view kReportScripts;  ///< all that a run's report runs, but uPlot
extern const std::string_view kTrimPage;       ///< HTML of the page of a vehicle's trim, as kReportPage
extern const std::string_view kTrimScripts;
extern const std::string_view kPlotStyle;   ///< CSS of uPlot
extern const std::string_view kPlotScript;  ///< uPlot

}  // namespace hedgehop::sim
