#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/flight_parts.h"

namespace CLI {
class App;
}

/// The commands of the command line. Results go to standard output, progress and warnings to standard error. Each
/// command returns the exit status of the process: 0 all checks hold, 1 a check fails, 4 undecided. Errors are thrown;
/// run_command_line() maps InputError to status 2 and other exceptions to 3.
namespace hedgehop::sim::cli {

/// A scenario file and its overrides.
struct ScenarioOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< "a.b=value"
  std::optional<uint64_t> seed;
  std::string renderer;  ///< a name of kRendererNames; empty: the scenario's
};

struct RunOptions {
  ScenarioOptions scenario;
  std::filesystem::path out;  ///< empty: out/<scenario's name>-seed<seed>
  bool no_video = false;
  bool json = false;
  bool no_report = false;
  bool view = false;                        ///< show the flight in a browser while it is flown
  std::optional<double> pace;               ///< seconds of flight per second of wall time; none: as fast as possible
  std::vector<std::string> keep_if_failed;  ///< of a worker: "report", "film", "replay"; written if the flight fails
  std::optional<std::string> bind;          ///< address on which a link is served; none: 127.0.0.1
  std::filesystem::path replay_link;        ///< recording that replaces the autopilot of a link; empty for a live link
  int64_t link_worker = 0;                  ///< number of the worker's autopilot
  int64_t worker_of = 0;  ///< parent process, whose end ends this run; no progress is shown; 0 for a run by a user
};
int run(const RunOptions& options);

struct RenderOptions {
  ScenarioOptions scenario;
  std::string camera;
  double time_s = 0.0;
  std::string what = "color";  ///< "color", "grey", "depth", "depth_mm", "depth_m", "flow", "labels", "semantic" or
                               ///< "label_colors"
  std::filesystem::path out;
  bool info = false;  ///< only print the renderers
};
int render(const RenderOptions& options);

struct CalibrationOptions {
  ScenarioOptions scenario;
  std::string format = "opencv";     ///< or "kalibr"
  std::vector<std::string> cameras;  ///< roles in the order of cam0, cam1 ...; empty: all
  bool opencv_header = false;        ///< of Kalibr's chain
  std::filesystem::path out;         ///< empty: standard output
};
/// Writes the camera calibration of the rig for other programs.
int calibration(const CalibrationOptions& options);

struct ImportOptions {
  std::string format;                        ///< a name of kFieldFormatNames
  std::vector<std::filesystem::path> files;  ///< at least one
  double scale = 1.0;                        ///< meters per unit of an SDF file
  std::filesystem::path out;                 ///< empty: standard output
  std::filesystem::path solids;              ///< table of the obstacles' poses; empty: no table
  double time_s = 0.0;                       ///< of the moving obstacles in the table
};
/// Writes an obstacle field of another program as a scene.
int import_field(const ImportOptions& options);

/// Topics of `hedgehop list`: those of a scenario (document_topics()), "sweep" and "campaign".
std::vector<std::string> list_topics();
int list(const std::string& topic);

/// @param kind  of the file: "scenario", "sweep" or "campaign".
int schema(const std::string& kind);

struct BatchOptions {
  std::vector<std::filesystem::path> inputs;  ///< scenarios, campaigns, folders
  std::string seeds;                          ///< such as 1:10; empty: the seeds of the inputs
  std::vector<std::string> overrides;         ///< "a.b=value", override every scenario
  std::string renderer;                       ///< of every scenario; empty: the scenarios' own
  bool recursive = false;                     ///< whether the subfolders of folders are read
  bool no_report = false;                     ///< whether the page is left out
  std::string keep;                           ///< such as "failed=report,film"; empty: none
  size_t jobs = 1;                            ///< flights at a time, >= 1
  double limit_s = 0.0;                       ///< maximum wall time of a flight; 0 for no limit
  bool reuse_other_builds = false;            ///< whether to reuse results of other builds
  std::filesystem::path out;                  ///< empty: out/<name of the one input>, else out/batch
  std::filesystem::path junit;                ///< empty: no file is written
  bool failed_only = false, resume = false, json = false;
  std::optional<double> min_success, margin;  ///< statistical checks, as in a campaign's file
  std::filesystem::path no_worse_than;
  double confidence = 0.95;
  std::string until;                  ///< stopping rule, such as "collision < 0.01"; empty: no rule
  std::optional<double> until_width;  ///< stopping rule: the width of the interval of the rate of `of`
  std::string of;                     ///< event
  std::filesystem::path plan;         ///< registered plan, flown instead of inputs; empty: no plan
  std::filesystem::path program;      ///< of the workers, absolute; empty: this one
};
/// Flies many scenarios, each flight in its own process. If interrupted, it writes the available results and returns
/// 128 plus the number of the signal. An invalid file does not stop the others; the status is then 2. If the last seed
/// leaves a stopping rule undecided, the status is 4.
int batch(const BatchOptions& options);

struct CompareOptions {
  std::filesystem::path base, candidate;  ///< scenarios
  std::string seeds;                      ///< such as 1:100
  std::vector<std::string> overrides;     ///< "a.b=value", override both
  std::string until;                      ///< claim, such as "collision: better"
  std::optional<double> range_m;          ///< maximum clearance that counts, m
  double confidence = 0.95;
  size_t jobs = 1;                  ///< flights at a time, >= 1
  double limit_s = 0.0;             ///< maximum wall time of a flight; 0 for no limit
  bool reuse_other_builds = false;  ///< whether to reuse results of other builds
  std::filesystem::path out;        ///< empty: out/compare
  std::filesystem::path junit;      ///< empty: no file is written
  bool resume = false, json = false;
  std::filesystem::path program;  ///< of the workers, absolute; empty: this one
};
/// Flies two scenarios on the same seeds, pair by pair, until the claim about the candidate is decided. Returns the
/// same statuses as batch() with a stopping rule.
int compare(const CompareOptions& options);

struct ValidateOptions {
  std::vector<std::filesystem::path> inputs;  ///< scenarios, campaigns, sweeps, folders
  std::vector<std::string> overrides;         ///< "a.b=value", override every scenario
  bool recursive = false;                     ///< whether the subfolders of folders are read
  std::filesystem::path junit;                ///< empty: no file is written
};
/// Reads files as a flight would, and places the vehicle, without flying. Prints each file and each error.
/// @return 0 if all files are valid, 2 otherwise.
int validate(const ValidateOptions& options);

struct SweepOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;             ///< "a.b=value", after the file's own `set`
  size_t jobs = 1;                                ///< flights at a time, >= 1
  size_t task_cores = 1;                          ///< of a Slurm task
  double limit_s = 0.0;                           ///< maximum wall time of a flight; 0 for no limit
  bool reuse_other_builds = false;                ///< whether to reuse results of other builds
  std::filesystem::path out;                      ///< empty: out/<the file's name>
  std::filesystem::path junit;                    ///< empty: no file is written
  std::string shard;                              ///< such as 2/8; empty: all
  bool merge = false;                             ///< only write the tables of the available results
  std::vector<std::filesystem::path> merge_from;  ///< further folders with results
  bool missing = false;                           ///< only print the number of flights without a result
  std::string on = "local";                       ///< or "slurm"
  size_t tasks = 8;                               ///< of the job array
  std::vector<std::string> slurm_options;         ///< for every sbatch
  bool dry_run = false;                           ///< only print the flights or the batch scripts
  std::filesystem::path program;                  ///< of the workers, absolute; empty: this one
};
/// Flies the remaining flights of a sweep. Results of the same scenario and build are reused.
int sweep(const SweepOptions& options);

struct FalsifyOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< "a.b=value", of the search file
  size_t jobs = 1;                     ///< flights at a time, >= 1
  double limit_s = 0.0;                ///< maximum wall time of a flight; 0 for no limit
  bool reuse_other_builds = false;     ///< whether to reuse results of other builds
  std::filesystem::path out;           ///< empty: out/<the file's name>
  std::filesystem::path program;       ///< of the workers, absolute; empty: this one
};
/// Starts or resumes a search for failing flights. Flies each failure again, shrinks it and stores it as a scenario.
/// @return 0 without a failure, 1 with confirmed failures, 3 if a failure is not repeatable, 4 if flights were not
/// flown and no failure is confirmed.
int falsify(const FalsifyOptions& options);

struct BranchOptions {
  std::filesystem::path source;        ///< folder of a run, or a scenario
  double at_s = 0.0;                   ///< time at which the settings change
  std::vector<std::string> overrides;  ///< "a.b=value", from that time on
  std::filesystem::path out;           ///< empty: out/<the source's name>-branches
};
/// Flies a scenario with its settings, and again with other settings from a given time on. Compares both flights.
int branch(const BranchOptions& options);

struct ReproduceOptions {
  std::vector<std::string> papers;  ///< keys or files; empty: all papers
  bool quick = false;               ///< few seeds
  size_t jobs = 1;                  ///< flights at a time, >= 1
  double limit_s = 0.0;             ///< maximum wall time of a flight; 0 for no limit
  bool reuse_other_builds = false;  ///< whether to reuse results of other builds
  std::filesystem::path out;        ///< empty: out/reproduce
  std::filesystem::path write;      ///< page of results in Markdown, such as docs/results.md; empty: no file
  std::filesystem::path program;    ///< of the workers, absolute; empty: this one
};
/// Flies the remaining flights of the papers' experiments and compares each published figure with the measured one.
int reproduce(const ReproduceOptions& options);

struct BlessOptions {
  std::filesystem::path folder;  ///< of the run
  std::string reason;            ///< why this path is the reference, one line
  bool force = false;            ///< accept a failed flight and overwrite an existing reference
  bool dry_run = false;          ///< only print the file that would be written
};
/// Writes the path of a run, next to its scenario, as the reference of the scenario's `path_tolerance`.
int bless(const BlessOptions& options);

/// Returns the path of the running executable, absolute. Throws std::runtime_error.
std::filesystem::path own_program();

struct ExportOptions {
  std::filesystem::path source;      ///< folder of a run, or a scenario
  std::string format;                ///< a name of kDataFormats
  std::filesystem::path out;         ///< empty: <format> in the folder of the run, or out/<name>-seed<seed>/<format>
  std::vector<std::string> cameras;  ///< roles; empty: all that take images
  bool truth = false;                ///< also the ground truth of each pixel
  bool float_depth = false;          ///< ground-truth depth as floats
  std::string compression = "zstd";  ///< of a log: "zstd", "lz4" or "none"
  bool compressed_images = false;    ///< of a bag: PNG instead of raw images
};
/// Re-simulates a run, or flies a scenario, and writes its sensor readings for other programs.
int export_run(const ExportOptions& options);

struct DatasetOptions {
  std::vector<std::filesystem::path> scenarios;
  std::vector<std::string> overrides;  ///< "a.b=value"
  std::string renderer;                ///< empty: the scenario's
  std::string seeds = "1";
  std::string poses = "random";  ///< or a file
  std::string pose_of;           ///< role of the camera whose poses the file has; empty: the body
  std::string camera;            ///< role; empty: the first with images
  size_t images = 0;             ///< 0: all poses of the file
  std::vector<std::string> channels = {"color", "depth", "flow", "semantic", "instance"};
  std::vector<double> height_m = {1.0, 20.0}, distance_m = {1.0, 30.0};  ///< minimum, maximum
  double tilt_deg = 20.0;
  std::filesystem::path out;
  size_t jobs = 1;
  bool resume = false;
  std::optional<size_t> world;         ///< hidden: a worker writes this world
  std::vector<std::string> arguments;  ///< of the command line, for workers
};
/// Writes images along poses, with ground truth, calibration and manifest.
int dataset(const DatasetOptions& options);
void declare_dataset(CLI::App& app, std::function<int()>& chosen, DatasetOptions& data);

struct ReportOptions {
  std::filesystem::path folder;   ///< of a run, a batch or a sweep
  std::filesystem::path against;  ///< folder of another run, or of an earlier batch or sweep; empty: no comparison
  bool replay = false;            ///< of a run: also write replay.html
  bool figures = false;           ///< of a sweep: write tables and figures for a paper
  std::string column;             ///< of the figures; empty: the default of the page
  size_t film_strips = 0;         ///< of a batch or sweep: worst flights to re-simulate for a film strip
};
/// Declare the commands that read and write files of other programs.
void declare_import(CLI::App& app, std::function<int()>& chosen, ImportOptions& field);
void declare_export(CLI::App& app, std::function<int()>& chosen, ExportOptions& data);
void declare_reports(CLI::App& app, std::function<int()>& chosen);
/// Writes index.html, a table of all results in a folder tree.
int runs(const std::filesystem::path& folder);

/// Writes the folder's report.html.
int report(const ReportOptions& options);

/// Runs the command line and prints errors to standard error. @return the exit status of the process.
int run_command_line(int argc, char** argv);

/// Returns the scenario of a command line with overrides and seed applied, and its parts. Throws InputError.
inline LoadedScenario load(const ScenarioOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (!options.renderer.empty()) overrides.push_back("drawing.renderer=" + options.renderer);
  return load_flight(options.file, overrides, options.seed);
}

/// Prints one line for each camera whose image has black pixels because the polynomial of its lens turns over.
void print_black_pixels(const RigConfig& rig);

/// Warns that the replay of a run has no images of cameras. @param fault  of write_replay(); empty: no warning.
void warn_of_replay(const std::filesystem::path& folder, const std::string& fault);

/// Prints the remarks on the files of a scene, such as the size of each imported mesh.
void print_remarks(const FlightParts& parts);

/// Returns the YAML files of a folder of configs such as "papers", sorted by name. They are taken from `configs` in the
/// working folder, otherwise from those of the installed program. Throws InputError that names the folder if there are
/// no such files.
std::vector<std::filesystem::path> shipped_files(const std::string& folder);

/// Returns the message for a first word that is not a command; empty if it is a command or an option.
std::string unknown_command(const CLI::App& app, std::string_view word);

/// Returns the message for the first unknown option of the parsed command; empty if there is none.
std::string unknown_option(const CLI::App& app);

}  // namespace hedgehop::sim::cli
