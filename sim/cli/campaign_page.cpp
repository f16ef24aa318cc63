#include "sim/cli/campaign_page.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "sim/campaign/campaign_report.h"

namespace hedgehop::sim::cli {

void write_campaign_page(const std::filesystem::path& folder) {
  const std::string page = (folder / "report.html").string();
  try {
    write_campaign_report(folder, std::nullopt);
    fmt::print("written: {}\n", page);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: not written: {}\n", page, error.what());
  }
}

}  // namespace hedgehop::sim::cli
