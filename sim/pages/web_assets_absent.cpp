// Built without npm: there are no pages.
#include "sim/pages/web_assets.h"

namespace hedgehop::sim {

const std::string_view kPage, kReportBody, kReportStyle, kReportScripts, kTrimBody, kTrimScripts, kCampaignBody,
    kCampaignStyle, kCampaignScripts, kReproductionBody, kReproductionScripts, kRunsBody, kRunsScripts, kReplayBody,
    kReplayStyle, kReplayScripts, kPlotStyle, kPlotScript;

}  // namespace hedgehop::sim
