#include "sim/record/result_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/record/flight_columns.h"
#include "sim/record/run_record.h"

namespace hedgehop::sim {

std::string trajectory_csv(const Flight& flight) { return trajectory_columns(flight).csv(); }

std::string decisions_csv(const Flight& flight) { return decision_columns(flight).csv(); }

void forget_flight(const std::filesystem::path& run_folder) {
  std::error_code ignored;
  for (const char* name : {"result.json", "report.html", "replay.html", "map.json", "strip.jpg"}) {
    std::filesystem::remove(run_folder / name, ignored);
  }
  // Left by a killed process if the file system has no unnamed files: see PendingFile.
  for (const char* name : {"scenario.yaml", "trajectory.csv", "decisions.csv", "result.json", "report.html",
                           "replay.html", "map.json", "video.webm"}) {
    std::filesystem::remove((run_folder / name) += ".part", ignored);
  }
}

void write_result_files(const std::filesystem::path& run_folder, const RunInfo& info, const Flight& flight) {
  std::error_code error;
  std::filesystem::create_directories(run_folder, error);
  if (error) throw std::runtime_error(fmt::format("cannot create {}: {}", run_folder.string(), error.message()));
  forget_flight(run_folder);
  write_file_whole(run_folder / "scenario.yaml", info.scenario_yaml);
  write_file_whole(run_folder / "trajectory.csv", trajectory_csv(flight));
  write_file_whole(run_folder / "decisions.csv", decisions_csv(flight));
  if (!flight.map.empty()) write_file_whole(run_folder / "map.json", json_text(map_data(flight.map)) + "\n");
  write_file_whole(run_folder / "result.json",
                   result_json(info, flight.result));  // last: a run with a result is complete
}

}  // namespace hedgehop::sim
