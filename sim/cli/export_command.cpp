#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/progress.h"
#include "sim/config/input_error.h"
#include "sim/export/export.h"
#include "sim/flight/build.h"
#include "sim/record/run_record.h"
#include "sim/scenario/flight_parts.h"
#include "sim/scenario/inputs.h"

namespace hedgehop::sim::cli {
namespace {

struct NamedFormat {
  const char* name;
  DataFormat format;
};
constexpr NamedFormat kDataFormats[] = {{"euroc", DataFormat::euroc},     {"tum", DataFormat::tum},
                                        {"kitti", DataFormat::kitti},     {"mcap", DataFormat::mcap},
                                        {"rosbag2", DataFormat::rosbag2}, {"ulog", DataFormat::ulog}};

DataFormat format_of(const std::string& name) {
  return std::ranges::find_if(kDataFormats, [&](const NamedFormat& f) { return name == f.name; })->format;
}

ChunkCompression compression_of(const std::string& name) {
  if (name == "none") return ChunkCompression::none;
  return name == "lz4" ? ChunkCompression::lz4 : ChunkCompression::zstd;
}

/// Returns the result that the run left.
RunResult result_of_run(const std::filesystem::path& folder) {
  for (const char* const name : {"scenario.yaml", "result.json"}) {
    if (!std::filesystem::exists(folder / name)) {
      throw InputError(fmt::format("{}: no {}: not the folder of a run", folder.string(), name));
    }
  }
  try {
    return read_result(folder / "result.json");
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: no whole run: {}", folder.string(), error.what()));
  }
}

/// Whether a file of this name has this hash, in any folder.
bool has(const Inputs& inputs, const std::filesystem::path& name, const std::string& hash) {
  return std::ranges::any_of(inputs, [&](const auto& input) {
    return std::filesystem::path(input.first).filename() == name && input.second == hash;
  });
}

/// Returns why a flight may differ from the run. @param inputs  of the flight of the run's resolved scenario. Files are
/// compared by their names without folders, because the two scenarios lie in different folders.
std::string cause_of_difference(const RunInfo& run, const Inputs& inputs) {
  for (const auto& [file, hash] : inputs) {
    const std::filesystem::path name = std::filesystem::path(file).filename();
    if (name == "scenario.yaml") continue;  // the resolved scenario, which is no input of the run
    if (has(run.inputs, name, hash)) continue;
    for (const auto& [run_file, run_hash] : run.inputs) {
      if (std::filesystem::path(run_file).filename() == name && !has(inputs, name, run_hash))
        return run_file + " has changed since";
    }
  }
  return run.build == build_identity() ? "another kind of processor" : "another build";
}

}  // namespace

int export_run(const ExportOptions& options) {
  const bool is_run = !std::filesystem::is_regular_file(options.source);
  const RunResult run = is_run ? result_of_run(options.source) : RunResult();
  const LoadedScenario loaded = load_flight(is_run ? options.source / "scenario.yaml" : options.source);
  const Scenario& scenario = loaded.scenario;
  const std::filesystem::path folder =
      is_run ? options.source : std::filesystem::path("out") / fmt::format("{}-seed{}", scenario.name, scenario.seed);
  const ExportRequest request{format_of(options.format),
                              options.cameras,
                              options.truth,
                              options.float_depth ? DepthFormat::float_m : DepthFormat::png_mm,
                              compression_of(options.compression),
                              options.compressed_images,
                              options.out.empty() ? folder / options.format : options.out};
  if (options.truth && request.format == DataFormat::ulog)
    notice("warning: --truth has no effect on ulog, which has no images; valid: euroc, tum, kitti, mcap, rosbag2\n");
  if (options.float_depth && is_log(request.format))
    notice("warning: --float-depth has no effect on a log; valid: euroc, tum, kitti\n");
  FlightProgress progress(scenario.name);
  const Flight flight = export_flight(
      scenario, request,
      [&](double t_s, double duration_s, double goal_distance_m) { progress.show(t_s, duration_s, goal_distance_m); },
      is_run ? options.source : std::filesystem::path());
  progress.close();
  if (is_run && flight.result.trajectory_hash != run.flight.trajectory_hash) {
    notice(fmt::format(
        "warning: the re-simulated trajectory differs from the run's ({} instead of {}): {}; the data "
        "agree with each other\n",
        flight.result.trajectory_hash, run.flight.trajectory_hash, cause_of_difference(run.info, loaded.inputs)));
  }
  fmt::print("written: {} ({:.1f} s of flight)\n", request.out.string(), flight.result.flight_time_s);
  return 0;
}

}  // namespace hedgehop::sim::cli
