#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "sim/batch/record.h"
#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/flight_pace.h"
#include "sim/cli/live_view.h"
#include "sim/cli/progress.h"
#include "sim/config/folder_lock.h"
#include "sim/config/whole_file.h"
#include "sim/flight/build.h"
#include "sim/flight/words.h"
#include "sim/link/open_link.h"
#include "sim/pages/replay.h"
#include "sim/pages/report.h"
#include "sim/pages/report_page.h"
#include "sim/record/film.h"
#include "sim/record/result_files.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim::cli {
namespace {

constexpr double kViewImagesHz = 10.0;  // of the module's image in the live view, without a video

/// Records the video and shows progress.
class RunWatcher : public FlightWatcher {
 public:
  /// @param view  whether a live view shows the images.
  RunWatcher(const std::string& name, const FilmConfig& filming, const std::filesystem::path& out, bool quiet,
             bool view)
      : film_(filming, out / kFilm), progress_(name), module_folder_(out / "module"), quiet_(quiet), view_(view) {}

  static constexpr const char* kFilm = "video.webm";

  double image_rate_hz() const override {
    const double film_hz = film_.image_rate_hz();
    return view_ && film_hz == 0.0 ? kViewImagesHz : film_hz;
  }
  void on_images(const ShownInstant& shown) override {
    if (film_.image_rate_hz() > 0.0) film_.on_images(shown);
    if (!view_) return;
    status_ = shown.status;
    module_image_ = shown.annotated.clone();
  }
  std::filesystem::path module_folder() const override { return module_folder_; }
  void on_progress(double t_s, double duration_s, double goal_distance_m) override {
    if (!quiet_) progress_.show(t_s, duration_s, goal_distance_m);
  }
  /// Ends the line and the video.
  void close() {
    progress_.close();
    film_.close();
    if (!film_.fault().empty()) warn(fmt::format("incomplete video: {}", film_.fault()));
  }
  /// The status of the module at its last image, and the image; only with a view.
  const std::string& status() const { return status_; }
  const cv::Mat& module_image() const { return module_image_; }

 private:
  FilmWatcher film_;
  FlightProgress progress_;
  std::filesystem::path module_folder_;
  bool quiet_, view_;
  std::string status_;
  cv::Mat module_image_;
};

/// A worker whose campaign is gone must not go on: another may fly into the same folder.
void die_with(pid_t campaign) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != campaign) throw std::runtime_error("the campaign that started this worker is gone");
}

/// Flies to the end. The view observes every decision, and the pace waits on every tick; neither can change the flight.
Flight fly(Simulation& simulation, const RunWatcher& watcher, LiveView* view, FlightPace* pace) {
  if (view == nullptr && pace == nullptr) return simulation.run();
  const auto show = [&] {
    if (view != nullptr) view->show(simulation, watcher.status(), watcher.module_image());
  };
  show();
  for (bool flies = true; flies;) {
    if (pace != nullptr) pace->keep(simulation.t_s());
    flies = simulation.tick();
    if (simulation.decides() || !flies) show();
  }
  return simulation.result();
}

std::string command_line(const RunOptions& options, const Scenario& scenario) {
  std::string text =
      fmt::format("hedgehop run {} --seed {}", shell_quoted(options.scenario.file.string()), scenario.seed);
  for (const std::string& override_text : options.scenario.overrides) text += " --set " + shell_quoted(override_text);
  if (!options.scenario.renderer.empty()) text += " --renderer " + options.scenario.renderer;
  return text;
}

void print_check(const CheckResult& check) {
  fmt::print("  {}  {:<16} {}\n", check.passed ? "pass" : "FAIL", check.name, check_words(check));
}

/// Returns whether a worker keeps an artifact of its flight.
bool keeps(const RunOptions& options, const char* artifact, bool failed) {
  return failed && std::ranges::find(options.keep_if_failed, artifact) != options.keep_if_failed.end();
}

/// Prints how often the module commanded the speed limit, to which faster commands are reduced.
void print_speed_limit(const Scenario& scenario, const std::vector<DecisionRow>& decisions) {
  constexpr double kRounding = 1e-9;
  const double limit_mps = scenario.avionics.autopilot.speed_limit_mps;
  const auto count = std::ranges::count_if(decisions, [&](const DecisionRow& row) {
    return row.v_WB_W_cmd && row.v_WB_W_cmd->norm() >= (1.0 - kRounding) * limit_mps;
  });
  if (count == 0) return;
  fmt::print(
      "  at the speed limit in {} of {} decisions: avionics.autopilot.speed_limit is {:g} m/s; faster commands are "
      "reduced to it\n",
      count, decisions.size(), limit_mps);
}

void print_verdict(const Scenario& scenario, const Flight& flight, const std::filesystem::path& out, bool has_report) {
  const FlightResult& result = flight.result;
  fmt::print("{}, seed {}: {} after {:.1f} s of flight\n", scenario.name, scenario.seed,
             shown_outcome(result.outcome, scenario.goal.has_value()), result.flight_time_s);
  if (!result.cause.empty()) fmt::print("  cause: {}\n", result.cause);
  fmt::print("  path {:.1f} m, mean speed {:.2f} m/s", result.path_length_m, result.mean_speed_mps);
  if (result.goal_distance_m) fmt::print(", {:.1f} m from the goal", *result.goal_distance_m);
  fmt::print("\n");
  print_speed_limit(scenario, flight.decisions);
  if (std::isfinite(result.closest_obstacle.distance_m)) {
    fmt::print("  nearest obstacle: {:.2f} m to {} at {:.1f} s\n", result.closest_obstacle.distance_m,
               result.closest_obstacle.what, result.closest_obstacle.t_s);
  }
  fmt::print(
      "  {:.2f} times real time: {:.1f} s, physics at {} Hz; median and 95th percentile: drawing {:.1f} and {:.1f} ms "
      "per image instant, deciding {:.1f} and {:.1f} ms per decision\n",
      result.realtime_factor, result.wall_s, result.physics_rate_hz, result.render_ms.median_ms,
      result.render_ms.p95_ms, result.decision_ms.median_ms, result.decision_ms.p95_ms);
  if (const auto& link = result.link) {
    fmt::print("  link: {}, {} packets, of which {} before the flight\n", link->kind, link->frames,
               link->start_tick.value_or(link->frames));
  }
  if (!result.truth_used.empty()) fmt::print("  truth used: {}\n", fmt::join(result.truth_used, "; "));
  for (const CheckResult& check : result.checks) print_check(check);
  if (result.checks.empty()) fmt::print("  no checks defined\n");
  fmt::print("  written: {}\n", (out / (has_report ? "report.html" : "result.json")).string());
}

/// Returns the autopilot of a scenario with a link; null without a link.
std::unique_ptr<OutsideAutopilot> open_link(const RunOptions& options, const Scenario& scenario,
                                            const std::filesystem::path& out) {
  if (scenario.link) {
    return link::open_link(scenario,
                           {options.bind.value_or("127.0.0.1"), options.link_worker, out, options.replay_link});
  }
  if (!options.replay_link.empty()) throw InputError("--replay-link: the scenario has no link");
  if (options.bind) throw InputError("--bind: the scenario has no link");
  std::error_code ignored;
  std::filesystem::remove(out / link::kRecordingName, ignored);  // of an earlier flight
  return nullptr;
}

void warn_of_link(const LinkFigures& link) {
  if (link.malformed > 0) warn(fmt::format("link: {} packets of another format were dropped", link.malformed));
  if (link.strangers > 0)
    warn(fmt::format("link: {} packets from other addresses than {} were dropped", link.strangers, link.peer));
}

/// Writes the pages that the options request. @return whether there is a report.
bool write_pages(const RunOptions& options, const Scenario& scenario, const RunInfo& info, const Flight& flight,
                 const std::filesystem::path& out) {
  const bool failed = !holds(verdict_of(flight.result));
  const bool has_report = !options.no_report || keeps(options, "report", failed);
  try {
    if (keeps(options, "replay", failed)) warn_of_replay(out, write_replay(out, run_record(scenario, info, flight)));
    if (has_report) write_report(out, run_record(scenario, info, flight));  // links the replay
  } catch (const PagesAbsent& absent) {
    notice(fmt::format("{}\n", absent.what()));
    return false;
  }
  return has_report;
}

}  // namespace

int run(const RunOptions& options) {
  if (options.worker_of != 0) die_with(static_cast<pid_t>(options.worker_of));
  LoadedScenario loaded = load(options.scenario);
  if (options.no_video) loaded.scenario.film.enabled = false;
  if (options.worker_of == 0) {
    print_black_pixels(loaded.scenario.rig);
    print_remarks(loaded.parts);
  }
  const Scenario scenario = loaded.scenario;
  const Inputs inputs = loaded.inputs;
  const std::filesystem::path out =
      options.out.empty() ? std::filesystem::path{"out"} / fmt::format("{}-seed{}", scenario.name, scenario.seed)
                          : options.out;
  require_writable(out);
  std::optional<FolderLock> lock;  // a worker's campaign holds the lock
  if (options.worker_of == 0) lock.emplace(out);
  const std::filesystem::path film = out / RunWatcher::kFilm;
  FilmConfig filming = scenario.film;
  filming.enabled = filming.enabled || keeps(options, "film", true);
  RunWatcher watcher(scenario.name, filming, out, options.worker_of != 0, options.view);
  std::unique_ptr<OutsideAutopilot> autopilot = open_link(options, scenario, out);
  Simulation simulation(std::move(loaded), &watcher, autopilot.get());
  std::optional<LiveView> view;
  if (options.view) view.emplace(simulation);
  std::optional<FlightPace> pace;
  if (options.pace) pace.emplace(*options.pace);
  const Flight flight = fly(simulation, watcher, view ? &*view : nullptr, pace ? &*pace : nullptr);
  std::error_code ignored;
  std::filesystem::remove(film, ignored);  // of an earlier flight, because this one may have no images
  watcher.close();
  autopilot.reset();  // ends its process and closes the recording
  const bool failed = !holds(verdict_of(flight.result));
  if (!scenario.film.enabled && !keeps(options, "film", failed)) std::filesystem::remove(film, ignored);

  const RunInfo info{scenario.name,
                     scenario.seed,
                     std::string(version()),
                     std::string(build_identity()),
                     inputs,
                     options.scenario.file.string(),
                     command_line(options, scenario),
                     to_yaml(scenario)};
  if (view) view->end(info, flight.result);
  write_result_files(out, info, flight);
  const bool has_report = write_pages(options, scenario, info, flight, out);
  if (flight.result.link) warn_of_link(*flight.result.link);
  if (flight.result.goal_missed_unchecked && options.worker_of == 0) {
    warn(fmt::format("{}: {}", scenario.name, kGoalMissedUnchecked));
  }
  if (options.json) {
    fmt::print("{}\n", result_json(info, flight.result));
  } else {
    print_verdict(scenario, flight, out, has_report);
  }
  return holds(verdict_of(flight.result)) ? 0 : 1;
}

}  // namespace hedgehop::sim::cli
