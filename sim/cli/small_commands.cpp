#include <fmt/format.h>

#include "sim/cli/commands.h"
#include "sim/record/report.h"
#include "sim/scenario/document.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim::cli {

int list(const std::string& topic) {
  fmt::print("{}", document(topic));
  return 0;
}

int schema() {
  fmt::print("{}\n", json_schema());
  return 0;
}

int report(const std::filesystem::path& run_folder) {
  write_report(run_folder);
  fmt::print("written: {}\n", (run_folder / "report.html").string());
  return 0;
}

}  // namespace hedgehop::sim::cli
