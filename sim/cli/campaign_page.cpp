#include "sim/cli/campaign_page.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "sim/cli/exit_status.h"
#include "sim/pages/campaign_report.h"

namespace hedgehop::sim::cli {

void print_failed(const std::vector<FlightRecord>& records) {
  for (const FlightRecord& record : records) {
    if (record.status != FlightRecord::Status::failed) continue;
    fmt::print("FAIL  {}: {}\n      {}\n", record.order.id, record.cause, rerun_command(record.order));
  }
}

void write_campaign_page(const std::filesystem::path& folder) {
  const std::string page = (folder / "report.html").string();
  try {
    write_campaign_report(folder, std::nullopt);
    fmt::print("written: {}\n", page);
  } catch (const std::exception& error) {
    notice(fmt::format("{}: not written: {}\n", page, error.what()));
  }
}

}  // namespace hedgehop::sim::cli
