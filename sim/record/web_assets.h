#pragma once

#include <string_view>

/// Texts of the pages, put into the program when it is built (web/).
namespace hedgehop::sim {

extern const std::string_view kReportPage;     ///< HTML with `{{name}}` where parts go
extern const std::string_view kReportStyle;    ///< CSS of the report
extern const std::string_view kPlotStyle;      ///< CSS of uPlot
extern const std::string_view kPlotScript;     ///< uPlot
extern const std::string_view kFiguresScript;  ///< what the next ones share
extern const std::string_view kPlanScript;     ///< the plan view
extern const std::string_view kChartsScript;   ///< plots over time or speed
extern const std::string_view kReportScript;   ///< the rest of the page, runs last
extern const std::string_view kTrimPage;       ///< HTML of the page of a vehicle's trim, as kReportPage
extern const std::string_view kTrimScript;     ///< the rest of that page, runs last

}  // namespace hedgehop::sim
