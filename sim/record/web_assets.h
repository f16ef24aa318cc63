#pragma once

#include <string_view>

/// Texts of the report's page, put into the program when it is built (web/).
namespace hedgehop::sim {

extern const std::string_view kReportPage;     ///< HTML with `{{name}}` where parts go
extern const std::string_view kReportStyle;    ///< CSS of the report
extern const std::string_view kPlotStyle;      ///< CSS of uPlot
extern const std::string_view kPlotScript;     ///< uPlot
extern const std::string_view kFiguresScript;  ///< what the next ones share
extern const std::string_view kPlanScript;     ///< the plan view
extern const std::string_view kChartsScript;   ///< the time plots
extern const std::string_view kReportScript;   ///< the rest of the page, runs last

}  // namespace hedgehop::sim
