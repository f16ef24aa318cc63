#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <functional>
#include <sstream>
#include <string_view>
#include <vector>

#include "sim/cli/campaign_options.h"
#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/features.h"
#include "sim/cli/manual.h"
#include "sim/cli/vehicle_commands.h"
#include "sim/config/input_error.h"
#include "sim/flight/build.h"
#include "sim/scenario/drawing.h"
#include "sim/scenario/list_topics.h"

namespace hedgehop::sim::cli {
namespace {

/// Declares the options that override a scenario.
void add_layers(CLI::App& command, ScenarioOptions& scenario) {
  command.add_option("--seed", scenario.seed, "seed of every random stream; overrides the scenario's")
      ->transform(whole_number());
  add_overrides(command, scenario.overrides,
                "override a value of the scenario, e.g. --set avoidance.speed=1.5; may be repeated");
  const std::vector<std::string> names(kRendererNames.begin(), kRendererNames.end());
  CLI::Option* const renderer =
      command
          .add_option("--renderer", scenario.renderer,
                      "renderer of the camera images: osmesa, egl (the GPU, if the machine has one) or tiles (fastest "
                      "without a GPU); overrides the scenario's")
          ->check(CLI::IsMember(names));
  command
      .add_option_function<std::string>("--gl",
                                        [&scenario](const std::string& name) {
                                          scenario.renderer = name;
                                          warn("--gl is deprecated: use --renderer");
                                        })
      ->check(CLI::IsMember(names))
      ->excludes(renderer)
      ->group("");                                        // hidden
  renderer->remove_excludes(command.get_option("--gl"));  // one direction suffices; the help names no hidden option
}

void add_scenario(CLI::App& command, ScenarioOptions& scenario) {
  command.add_option("SCENARIO", scenario.file, "scenario file (YAML)")->required();
  add_layers(command, scenario);
}

// Each function declares one command. Parsing stores the call of the selected command in `chosen`.

void declare_run(CLI::App& app, std::function<int()>& chosen, RunOptions& run) {
  CLI::App* const command =
      app.add_subcommand("run", "fly a scenario and write its results: verdict, tables, video, report");
  add_scenario(*command, run.scenario);
  command->add_option("--out", run.out, "output folder; default out/<name>-seed<seed>")->type_name("DIR");
  command->add_flag("--no-video", run.no_video, "do not write a video");
  command->add_flag("--no-report", run.no_report, "do not write report.html; `hedgehop report DIR` writes it later");
  command->add_flag("--view", run.view, "show the flight in a browser while it is flown; prints the address");
  command
      ->add_option(
          "--pace", run.pace,
          "seconds of flight per second of wall time, such as 1 for real time; default as fast as possible. The "
          "results are equal")
      ->transform(number())
      ->check(positive())
      ->type_name("SPEED");
  command
      ->add_option("--bind", run.bind, "numeric address on which a link to an autopilot is served; default 127.0.0.1")
      ->type_name("ADDRESS");
  command
      ->add_option("--replay-link", run.replay_link,
                   "fly a linked scenario again with the packets of an earlier run, link.bin, without an autopilot")
      ->type_name("FILE");
  command->add_option("--link-worker", run.link_worker)->group("");  // hidden: for batch and sweep
  command->add_option("--worker-of", run.worker_of)->group("");      // hidden: for batch and sweep
  command->add_option("--keep-if-failed", run.keep_if_failed)->delimiter(',')->group("");  // hidden: for batch
  command->add_flag("--json", run.json, "print result.json instead of the verdict");
  command->callback([&] { chosen = [&run] { return cli::run(run); }; });
}

void declare_render(CLI::App& app, std::function<int()>& chosen, RenderOptions& render) {
  CLI::App* const command = app.add_subcommand("render", "render the image of one camera to a file");
  auto* const file = command->add_option("SCENARIO", render.scenario.file, "scenario file (YAML)");
  add_layers(*command, render.scenario);
  auto* const camera = command->add_option("--camera", render.camera, "role of the camera")->type_name("NAME");
  command->add_option("--time", render.time_s, "time of the image, s; the flight is simulated up to this time")
      ->transform(number())
      ->check(not_negative())
      ->type_name("S");
  command
      ->add_option("--what", render.what,
                   "color, grey; depth (red 0.5 m, green 10 m, blue 200 m, sky white), depth_mm (16-bit PNG, "
                   "millimeters, 0 beyond 65 m), depth_m (TIFF of 32-bit floats, meters, infinity: sky); flow to the "
                   "camera's next image (right red, left cyan, white at rest, full at 16 px); labels (16-bit PNG, one "
                   "number for each object, 0: sky), semantic (its class), both with labels.json next to the image; "
                   "label_colors (a color for each object, sky black)")
      ->check(CLI::IsMember(
          {"color", "grey", "depth", "depth_mm", "depth_m", "flow", "labels", "semantic", "label_colors"}));
  auto* const out = command->add_option("-o", render.out, "output file; FILE.tiff for depth_m")->type_name("FILE.png");
  auto* const info =
      command->add_flag("--info", render.info, "print every renderer, and why one is not available, and exit");
  command->callback([&, file, camera, out, info] {
    if (!*info && (!*file || !*camera || !*out)) {
      throw CLI::RequiredError("render: SCENARIO, --camera and -o (or --info)");
    }
    chosen = [&render] { return cli::render(render); };
  });
}

void declare_calibration(CLI::App& app, std::function<int()>& chosen, CalibrationOptions& calibration) {
  CLI::App* const command =
      app.add_subcommand("calibration", "write the camera calibration for other programs: intrinsics and poses");
  add_scenario(*command, calibration.scenario);
  command->add_option("--format", calibration.format, "opencv (FileStorage YAML, the default) or kalibr")
      ->check(CLI::IsMember({"opencv", "kalibr"}));
  command
      ->add_option("--camera", calibration.cameras,
                   "role of a camera to write; may be repeated, the first is cam0; default all cameras")
      ->type_name("NAME");
  command->add_flag("--opencv-header", calibration.opencv_header,
                    "begin Kalibr's chain with the line %YAML:1.0, for OpenCV's FileStorage; Kalibr refuses this line");
  command->add_option("-o", calibration.out, "output file; default standard output")->type_name("FILE.yaml");
  command->callback([&] { chosen = [&calibration] { return cli::calibration(calibration); }; });
}

void declare_list(CLI::App& app, std::function<int()>& chosen, std::string& topic) {
  CLI::App* const command = app.add_subcommand(
      "list",
      "list the keys of scenarios, sweeps, campaigns, searches and plans, and the valid modules, vehicles, scenes, "
      "cameras and checks");
  command
      ->add_option("TOPIC", topic,
                   "modules, vehicles, scenes, cameras, checks; scenario: all other keys; sweep, campaign, search, "
                   "plan: the keys of these files")
      ->required()
      ->check(CLI::IsMember(list_topics()));
  command->callback([&] { chosen = [&topic] { return cli::list(topic); }; });
}

void declare_schema(CLI::App& app, std::function<int()>& chosen, std::string& kind) {
  CLI::App* const command = app.add_subcommand("schema", "print the JSON Schema of a kind of file, for editors");
  command->add_option("KIND", kind, "scenario (default), sweep, campaign, search or plan")
      ->check(CLI::IsMember({"scenario", "sweep", "campaign", "search", "plan"}));
  command->callback([&] { chosen = [&kind] { return cli::schema(kind); }; });
}

void declare_manual(CLI::App& app, std::function<int()>& chosen, std::string& format) {
  CLI::App* const command =
      app.add_subcommand("manual", "print the man page, the reference page (docs/commands.md) or shell completions");
  command->add_option("FORMAT", format, "man, markdown, bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"man", "markdown", "bash", "zsh", "fish"}));
  command->callback([&] {
    chosen = [&] {
      fmt::print("{}", format == "man" || format == "markdown" ? manual(app, format) : completions(app, format));
      return 0;
    };
  });
}

/// Returns the message of a bad command line. Those of CLI11 name a missing value "1 required TEXT missing".
std::string usage_fault(const CLI::Error& error) {
  constexpr std::string_view kBefore = ": 1 required ", kAfter = " missing";
  std::string text = one_line(error.what());
  if (text == "TOPIC is required") return fmt::format("{}; valid: {}", text, fmt::join(list_topics(), ", "));
  if (text.starts_with(": ")) text = "--gl" + text;  // CLI11 does not name a hidden option
  const size_t at = text.find(kBefore);
  if (at == std::string::npos || !text.ends_with(kAfter)) return text;
  const size_t begin = at + kBefore.size();
  const std::string type = text.substr(begin, text.size() - begin - kAfter.size());
  return text.substr(0, at) + ": a value is missing" + (type == "TEXT" ? "" : " (" + type + ")");
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{
      "Hedgehop: closed-loop simulation of vision-based obstacle avoidance for helicopters and multicopters,\n"
      "without display, GPU or network.",
      "hedgehop"};
  bool features = false;
  app.add_flag("--features", features, "with --version: the optional features of this build");
  app.set_version_flag("--version", [&features] {
    return fmt::format("{} (build {}){}", version(), build_identity(), features ? kFeatureRows : "");
  });
  app.require_subcommand(1);
  app.failure_message(
      [](const CLI::App*, const CLI::Error& error) { return fmt::format("{} (see --help)\n", usage_fault(error)); });
  app.footer(
      "Exit status: 0 all checks hold; 1 a check fails or a claim is refuted; 2 bad input; 3 internal error; 4 "
      "undecided; "
      "130 interrupted.");

  std::function<int()> chosen;
  RunOptions run;
  RenderOptions render;
  CalibrationOptions calibration;
  VehicleOptions vehicles;
  std::string topic;
  ExportOptions data;
  ImportOptions field;
  DatasetOptions images{.arguments = {argv + 1, argv + argc}};
  std::string format, kind;
  declare_run(app, chosen, run);
  declare_render(app, chosen, render);
  declare_calibration(app, chosen, calibration);
  declare_campaigns(app, chosen);
  declare_export(app, chosen, data);
  declare_import(app, chosen, field);
  declare_dataset(app, chosen, images);
  declare_reports(app, chosen);
  declare_list(app, chosen, topic);
  declare_vehicle_commands(app, chosen, vehicles);
  declare_schema(app, chosen, kind);
  declare_manual(app, chosen, format);
  if (const std::string fault = argc > 1 ? unknown_command(app, argv[1]) : ""; !fault.empty()) {
    notice(one_line(fault) + "\n");
    return kBadInput;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    const int status = app.exit(error, out, err);
    fmt::print("{}", out.str());
    const std::string unknown = status == 0 ? "" : unknown_option(app);
    notice(unknown.empty() ? err.str() : one_line(unknown) + "\n");
    return status == 0 ? 0 : kBadInput;
  }
  return chosen();
}

}  // namespace

int run_command_line(int argc, char** argv) {
  if (std::getenv("HEDGEHOP_GL") != nullptr) {
    warn("HEDGEHOP_GL has no effect any more: use --renderer, or drawing.renderer in the scenario");
    ::unsetenv("HEDGEHOP_GL");  // the workers of a campaign need not repeat it
  }
  try {
    return parse_and_run(argc, argv);
  } catch (const InputError& error) {
    for (const std::string& fault : error.errors()) notice(fault + "\n");
    return kBadInput;
  } catch (const std::exception& error) {
    notice(fmt::format("hedgehop: {}\n", one_line(error.what())));
    return kInternalError;
  }
}

}  // namespace hedgehop::sim::cli
