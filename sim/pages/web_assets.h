#pragma once

#include <string_view>

/// Texts of the pages, put into the program when it is built (web/).
namespace hedgehop::sim {

extern const std::string_view kPage;           ///< HTML that all pages share, with `{{name}}` where parts go
extern const std::string_view kReportBody;     ///< HTML of a run's report
extern const std::string_view kReportStyle;    ///< CSS of all pages
extern const std::string_view kReportScripts;  ///< all that a run's report runs, but uPlot
extern const std::string_view kTrimBody;       ///< HTML of the page of a vehicle's trim
extern const std::string_view kTrimScripts;
extern const std::string_view kCampaignBody;   ///< HTML of a batch's or sweep's report
extern const std::string_view kCampaignStyle;  ///< CSS that it adds
extern const std::string_view kCampaignScripts;
extern const std::string_view kReproductionBody;  ///< HTML of papers' figures beside ours
extern const std::string_view kReproductionScripts;
extern const std::string_view kReplayBody;     ///< HTML of the replay
extern const std::string_view kReplayStyle;    ///< CSS that it adds
extern const std::string_view kReplayScripts;  ///< with three.js bundled in
extern const std::string_view kPlotStyle;      ///< CSS of uPlot
extern const std::string_view kPlotScript;     ///< uPlot

}  // namespace hedgehop::sim
