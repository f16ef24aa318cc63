#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/progress.h"
#include "sim/config/input_error.h"
#include "sim/export/export.h"
#include "sim/record/run_record.h"

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

/// Of the trajectory that the run left.
std::string hash_of_run(const std::filesystem::path& folder) {
  for (const char* const name : {"scenario.yaml", "result.json"}) {
    if (!std::filesystem::exists(folder / name)) {
      throw InputError(fmt::format("{}: no {}: not the folder of a run", folder.string(), name));
    }
  }
  try {
    return read_result(folder / "result.json").flight.trajectory_hash;
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: no whole run: {}", folder.string(), error.what()));
  }
}

}  // namespace

int export_run(const ExportOptions& options) {
  const bool is_run = !std::filesystem::is_regular_file(options.source);
  const std::string hash = is_run ? hash_of_run(options.source) : "";
  const Scenario scenario = load_scenario(is_run ? options.source / "scenario.yaml" : options.source);
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
  if (is_run && flight.result.trajectory_hash != hash) {
    notice(
        fmt::format("warning: the re-simulated trajectory differs from the run's ({} instead of {}): another build or "
                    "another kind of processor; the data agree with each other\n",
                    flight.result.trajectory_hash, hash));
  }
  fmt::print("written: {} ({:.1f} s of flight)\n", request.out.string(), flight.result.flight_time_s);
  return 0;
}

}  // namespace hedgehop::sim::cli
