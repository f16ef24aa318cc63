#pragma once

#include <string_view>

/// Texts of the pages, embedded at build time from web/. All are empty if Hedgehop was built without npm.
namespace hedgehop::sim {

extern const std::string_view kPage;           ///< HTML of all pages, with `{{name}}` as placeholders
extern const std::string_view kReportBody;     ///< HTML of the report of a run
extern const std::string_view kReportStyle;    ///< CSS of all pages
extern const std::string_view kReportScripts;  ///< scripts of the report of a run, without uPlot
extern const std::string_view kTrimBody;       ///< HTML of the trim of a vehicle
extern const std::string_view kTrimScripts;
extern const std::string_view kCampaignBody;   ///< HTML of the report of a batch or sweep
extern const std::string_view kCampaignStyle;  ///< additional CSS
extern const std::string_view kCampaignScripts;
extern const std::string_view kReproductionBody;  ///< HTML of the results compared with the papers
extern const std::string_view kReproductionScripts;
extern const std::string_view kRunsBody;  ///< HTML of the index of results
extern const std::string_view kRunsScripts;
extern const std::string_view kReplayBody;     ///< HTML of the replay
extern const std::string_view kReplayStyle;    ///< additional CSS
extern const std::string_view kReplayScripts;  ///< including three.js
extern const std::string_view kPlotStyle;      ///< CSS of uPlot
extern const std::string_view kPlotScript;     ///< uPlot

}  // namespace hedgehop::sim
