#include "sim/export/log_export.h"

#include <fmt/format.h>

#include <memory>

#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "sim/export/foxglove_log.h"
#include "sim/export/log_recorder.h"
#include "sim/export/rosbag_log.h"
#include "sim/export/ulog_log.h"
#include "sim/link/open_link.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim {
namespace {

std::unique_ptr<LogSink> log_of(const ExportRequest& request) {
  if (request.format == DataFormat::ulog) return ulog_log(request.out / "flight.ulg");
  if (request.format == DataFormat::mcap) return foxglove_log(request.out / "flight.mcap", request.compression);
  return rosbag_log(request.out, {request.compression, request.compressed_images});
}

}  // namespace

Flight export_log(const Scenario& scenario, const ExportRequest& request,
                  const std::function<void(double, double, double)>& progress,
                  const std::filesystem::path& run_folder) {
  require_empty(request.out);
  const std::unique_ptr<LogSink> log = log_of(request);
  LogRecorder recorder(scenario, request.cameras, request.truth, *log, request.out, progress);
  const std::unique_ptr<OutsideAutopilot> autopilot = link::recorded_link(scenario, run_folder);
  Flight flight = Simulation(scenario, {}, &recorder, autopilot.get()).run();
  recorder.close(flight);
  return flight;
}

int64_t start_time_ns(DataFormat format) {
  return format == DataFormat::mcap || format == DataFormat::ulog ? 0 : kStartTimeNs;
}

void require_empty(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder, error) && !std::filesystem::is_empty(folder, error)) {
    throw InputError(fmt::format("{}: is not an empty folder; select another with --out", folder.string()));
  }
  require_writable(folder);
}

}  // namespace hedgehop::sim
