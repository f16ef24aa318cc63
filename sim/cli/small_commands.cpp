#include <fmt/format.h>

#include <optional>
#include <variant>

#include "sim/batch/campaign_file.h"
#include "sim/batch/flight_table.h"
#include "sim/batch/folders.h"
#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/plot_file.h"
#include "sim/cli/vehicle_commands.h"
#include "sim/config/input_error.h"
#include "sim/config/outline_texts.h"
#include "sim/evidence/conduct.h"
#include "sim/falsify/falsify_file.h"
#include "sim/flight/words.h"
#include "sim/pages/campaign_report.h"
#include "sim/pages/film_strip.h"
#include "sim/pages/replay.h"
#include "sim/pages/report.h"
#include "sim/pages/runs_page.h"
#include "sim/pages/sweep_analysis.h"
#include "sim/scenario/calibration.h"
#include "sim/scenario/flight_parts.h"
#include "sim/scenario/list_topics.h"
#include "sim/scenario/scenario.h"
#include "sim/sweep/sweep_file.h"

namespace hedgehop::sim::cli {
namespace {

/// Re-simulates the worst flights of a campaign for their strips, and prints the outcome.
void film_worst(const std::filesystem::path& folder, size_t count) {
  const std::vector<FlightRecord> flights = read_flights(folder).records;
  const std::vector<size_t> rows = worst_flights(flights, count);
  size_t begun = 0;
  const auto show = [&](const std::string& id) {
    notice(fmt::format("{}/{}: re-simulating {} for its film strip\n", ++begun, rows.size(), id));
  };
  for (const std::string& fault : write_film_strips(folder, flights, rows, show)) warn(fault);
}

}  // namespace

void warn_of_replay(const std::filesystem::path& folder, const std::string& fault) {
  if (fault.empty()) return;
  warn(fmt::format("{} has no images of cameras: {}", (folder / "replay.html").string(), fault));
}

void print_black_pixels(const RigConfig& rig) {
  for (const CameraConfig& camera : rig.cameras) {
    const double share = vision::camera::share_past_turn(camera.model());
    if (share == 0.0) continue;
    warn(fmt::format(
        "camera '{}': the polynomial of its lens turns over inside the image, so {:.1f} % of the pixels are "
        "black",
        camera.role, 100.0 * share));
  }
}

void print_remarks(const FlightParts& parts) {
  for (const std::string& line : parts.files.remarks) notice(line + "\n");
}

std::vector<std::string> list_topics() {
  std::vector<std::string> topics = document_topics();
  topics.insert(topics.end(), {"sweep", "campaign", "search", "plan"});
  return topics;
}

int list(const std::string& topic) {
  if (topic == "sweep") {
    fmt::print("{}\ndesign, one of:\n\n{}", document_fields(outline_fields(SweepConfig{}), 0),
               describe_choices<SweepDesign>());
  } else if (topic == "campaign") {
    fmt::print("{}\nchecks, each one of:\n\n{}", document_fields(outline_fields(CampaignConfig{}), 0),
               describe_choices<CampaignCheck>());
  } else if (topic == "search") {
    fmt::print("{}", document_fields(outline_fields(FalsifyConfig{}), 0));
  } else if (topic == "plan") {
    fmt::print("{}", document_fields(outline_fields(PlanConfig{}), 0));
  } else {
    fmt::print("{}{}", document(topic), topic == "vehicles" ? vehicle_files_text() : "");
  }
  return 0;
}

int schema(const std::string& kind) {
  if (kind == "sweep") {
    fmt::print("{}\n", schema_text(outline_fields(SweepConfig{}), "Hedgehop sweep"));
  } else if (kind == "campaign") {
    fmt::print("{}\n", schema_text(outline_fields(CampaignConfig{}), "Hedgehop campaign"));
  } else if (kind == "search") {
    fmt::print("{}\n", schema_text(outline_fields(FalsifyConfig{}), "Hedgehop failure search"));
  } else if (kind == "plan") {
    fmt::print("{}\n", schema_text(outline_fields(PlanConfig{}), "Hedgehop plan"));
  } else {
    fmt::print("{}\n", json_schema());
  }
  return 0;
}

int calibration(const CalibrationOptions& options) {
  const bool kalibr = options.format == "kalibr";
  if (options.opencv_header && !kalibr) throw InputError("--opencv-header is for --format kalibr");
  const Scenario scenario = load(options.scenario).scenario;
  const RigConfig& rig = scenario.rig;
  print_black_pixels(rig);
  const std::vector<CameraConfig> cameras = options.cameras.empty() ? rig.cameras : rig.select(options.cameras);
  const std::string text = build_part("rig", [&] {
    return kalibr ? kalibr_calibration(cameras, scenario.avionics.imu, options.opencv_header)
                  : opencv_calibration(cameras, scenario.avionics.imu);
  });
  if (options.out.empty()) {
    fmt::print("{}", text);
    return 0;
  }
  write_named_file(options.out, text);
  fmt::print("written: {}\n", options.out.string());
  return 0;
}

int runs(const std::filesystem::path& folder) {
  const RunsPage page = write_runs_page(folder);
  for (const std::string& line : page.unread) warn(line);
  fmt::print("{}; written: {}\n", counted(page.results, "result"), (folder / "index.html").string());
  return 0;
}

int report(const ReportOptions& options) {
  const std::string folder = options.folder.string();
  const auto written = [&](const char* name) { fmt::print("written: {}\n", (options.folder / name).string()); };
  if (!options.figures && !options.column.empty()) throw InputError("--column is for --figures");
  if (is_campaign(options.folder)) {
    if (options.replay) throw InputError(folder + ": --replay shows one flight; name the folder of one");
    if (options.film_strips > 0) film_worst(options.folder, options.film_strips);
    write_campaign_report(options.folder, options.against.empty() ? std::nullopt : std::optional(options.against));
    std::vector<std::string> files = {"report.html"};
    if (options.figures) {
      for (const std::string& file : write_sweep_figures(options.folder, options.folder / "figures", options.column))
        files.push_back("figures/" + file);
    }
    for (const std::string& file : files) written(file.c_str());
    return 0;
  }
  if (!has_file(options.folder, "result.json")) {
    throw InputError(folder + ": no result.json, batch.csv or sweep.csv: not the folder of a run, batch or sweep");
  }
  if (options.figures) throw InputError(folder + ": --figures is for sweeps, and this is one run");
  if (options.film_strips > 0)
    throw InputError(folder + ": --film-strips is for batches or sweeps, and this is one run");
  if (!options.against.empty() && !has_file(options.against, "result.json")) {
    throw InputError(fmt::format("{}: no result.json: a run is compared with another run", options.against.string()));
  }
  const RunRecord run = read_run(options.folder);
  if (options.replay) warn_of_replay(options.folder, write_replay(options.folder, run));
  // It links the replay.
  write_report(options.folder, run, options.against.empty() ? std::nullopt : std::optional(options.against));
  written("report.html");
  if (options.replay) written("replay.html");
  return 0;
}

}  // namespace hedgehop::sim::cli
