#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "sim/cli/commands.h"
#include "sim/cli/load.h"
#include "sim/record/report.h"
#include "sim/scenario/calibration.h"
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

int calibration(const CalibrationOptions& options) {
  const RigConfig rig = load(options.scenario).rig;
  const std::string text =
      build_part("rig", [&] { return options.format == "kalibr" ? kalibr_calibration(rig) : opencv_calibration(rig); });
  if (options.out.empty()) {
    fmt::print("{}", text);
    return 0;
  }
  std::ofstream file(options.out, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be written", options.out.string()));
  fmt::print("written: {}\n", options.out.string());
  return 0;
}

int report(const std::filesystem::path& run_folder) {
  write_report(run_folder);
  fmt::print("written: {}\n", (run_folder / "report.html").string());
  return 0;
}

}  // namespace hedgehop::sim::cli
