#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "sim/batch/seeds.h"
#include "sim/batch/worker_pool.h"
#include "sim/cli/campaign_options.h"
#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/progress.h"
#include "sim/config/folder_lock.h"
#include "sim/config/input_error.h"
#include "sim/dataset/dataset.h"
#include "sim/fields/bounds.h"
#include "sim/scenario/drawing.h"

namespace hedgehop::sim::cli {
namespace {

DatasetRequest request_of(const DatasetOptions& options) {
  DatasetRequest request{
      .scenarios = options.scenarios, .overrides = options.overrides, .seeds = parse_seeds(options.seeds)};
  if (!options.renderer.empty()) request.overrides.push_back("drawing.renderer=" + options.renderer);
  if (options.poses != "random") request.poses = options.poses;
  request.poses_of_camera = !options.pose_of.empty();
  request.camera = options.pose_of.empty() ? options.camera : options.pose_of;
  if (!options.camera.empty() && !options.pose_of.empty() && options.camera != options.pose_of) {
    throw InputError("--camera and --pose-of name different cameras");
  }
  if (request.poses.empty() && request.poses_of_camera) throw InputError("--pose-of is for a file of poses");
  request.images = options.images;
  for (const std::string& channel : options.channels) request.channels.push_back(dataset_channel(channel));
  request.bounds.min_height_m = options.height_m[0];
  request.bounds.max_height_m = options.height_m[1];
  request.bounds.min_distance_m = options.distance_m[0];
  request.bounds.max_distance_m = options.distance_m[1];
  request.bounds.max_tilt_rad = fields::to_radians(static_cast<long double>(options.tilt_deg));
  request.out = options.out;
  return request;
}

std::vector<std::string> worker_command(const DatasetOptions& options, size_t world) {
  std::vector<std::string> command = {own_program().string()};
  command.insert(command.end(), options.arguments.begin(), options.arguments.end());
  command.push_back("--world");
  command.push_back(fmt::to_string(world));
  return command;
}

/// Writes the worlds that are missing, in worker processes. @return the exit status: that of the first world that
/// fails.
int write_worlds(const DatasetRequest& request, const DatasetOptions& options) {
  Interruption interruption;
  WorkerPool pool(options.jobs, 0.0, interruption);
  const StatusLine line;
  const size_t worlds = world_count(request);
  size_t next = 0, written = 0;
  int status = 0;
  std::set<std::string> faults;
  for (;;) {
    while (next < worlds && pool.has_room()) {
      const size_t world = next++;
      if (is_written(request, world)) {
        ++written;
      } else {
        pool.start(world, worker_command(options, world));
      }
    }
    const std::optional<JobEnd> ended = pool.next();
    if (!ended) break;
    if (ended->end.kind == WorkerEnd::Kind::stopped) continue;
    const bool done = ended->end.kind == WorkerEnd::Kind::exited && ended->end.code == 0;
    if (done) {
      ++written;
      line.show(fmt::format("{} of {} worlds", written, worlds));
      continue;
    }
    const bool bad_input = ended->end.kind == WorkerEnd::Kind::exited && ended->end.code == kBadInput;
    if (status == 0) status = bad_input ? kBadInput : kInternalError;
    const std::string& fault = ended->end.last_line;
    if (!bad_input || fault.empty()) {
      line.keep(fmt::format("{}: {}", world_name(request, ended->job), cause_words(ended->end, 0.0)));
    } else if (faults.insert(fault).second) {  // worlds of one scenario have the same fault
      line.keep(fault);
    }
  }
  line.close();
  return interruption.came() ? kSignalled + interruption.signal() : status;
}

}  // namespace

void declare_dataset(CLI::App& app, std::function<int()>& chosen, DatasetOptions& data) {
  CLI::App* const command = app.add_subcommand(
      "dataset", "write images along poses, without flights, with ground truth, calibration and manifest");
  command->add_option("SCENARIO", data.scenarios, "scenario files (YAML)")->required();
  command->add_option("--set", data.overrides, "override a key, such as drawing.visibility=100; may be repeated")
      ->type_name("KEY=VALUE");
  command->add_option("--renderer", data.renderer, "renderer of the images; default that of the scenario")
      ->check(CLI::IsMember(std::vector<std::string>(kRendererNames.begin(), kRendererNames.end())));
  command->add_option("--seeds", data.seeds, "seeds of the worlds of each scenario, such as 1:10; default 1");
  command->add_option("--poses", data.poses,
                      "random (the default), or a file: trajectory.csv of a run, CSV, EuRoC, TUM or KITTI");
  command
      ->add_option("--pose-of", data.pose_of,
                   "role of the camera whose poses the file has; default the IMU, or for trajectory.csv the body")
      ->type_name("NAME");
  command->add_option("--camera", data.camera, "role of the camera; default the first with images")->type_name("NAME");
  command->add_option("--images", data.images, "number of images in all worlds together; default all poses of the file")
      ->transform(whole_number());
  command->add_option("--channels", data.channels, "default color,depth,flow,semantic,instance; also grey")
      ->delimiter(',');
  command->add_option("--height", data.height_m, "random poses: minimum and maximum height, m; default 1,20")
      ->transform(number())
      ->delimiter(',')
      ->expected(2);
  command
      ->add_option("--distance", data.distance_m,
                   "random poses: minimum and maximum distance to the nearest obstacle, m; default 1,30")
      ->transform(number())
      ->delimiter(',')
      ->expected(2);
  command->add_option("--tilt", data.tilt_deg, "random poses: maximum of roll and of pitch, degrees; default 20")
      ->transform(number())
      ->check(CLI::Range(0.0, 80.0));
  command->add_option("--out", data.out, "output folder")->required()->type_name("DIR");
  command->add_option("-j,--jobs", data.jobs, "worlds in parallel; default 1")
      ->transform(whole_number())
      ->check(CLI::Range(1, 1024));
  command->add_flag("--resume", data.resume, "continue an interrupted data set");
  command->add_option("--world", data.world)->group("");  // hidden: for workers
  command->callback([&] { chosen = [&data] { return dataset(data); }; });
}

int dataset(const DatasetOptions& options) {
  const DatasetRequest request = request_of(options);
  if (options.world) {
    write_world(request, *options.world);
    return 0;
  }
  begin_dataset(request, options.resume);
  const FolderLock lock(request.out);
  if (const int status = write_worlds(request, options); status != 0) {
    if (status == kBadInput) abandon_dataset(request);
    if (std::filesystem::exists(request.out / "request.json")) {
      notice(fmt::format("incomplete: {}; continue with --resume\n", request.out.string()));
    }
    return status;
  }
  finish_dataset(request);
  fmt::print("written: {}\n", (request.out / "manifest.csv").string());
  return 0;
}

}  // namespace hedgehop::sim::cli
