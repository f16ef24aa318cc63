#include "sim/dataset/dataset.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "sim/config/input_error.h"
#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/dataset/coco.h"
#include "sim/dataset/drawn_world.h"
#include "sim/dataset/pose_file.h"
#include "sim/flight/build.h"
#include "sim/flight/words.h"
#include "sim/libm/random.h"
#include "sim/record/image_file.h"
#include "sim/record/labels_file.h"
#include "sim/record/table.h"
#include "sim/scenario/calibration.h"
#include "sim/scenario/flight_parts.h"
#include "sim/scenario/inputs.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 6> kChannelNames = {"grey", "color", "depth", "flow", "semantic", "instance"};
constexpr std::array<std::string_view, 3> kSplitNames = {"train", "val", "test"};

std::string_view name_of(DatasetChannel channel) { return kChannelNames[static_cast<size_t>(channel)]; }
std::string_view name_of(Split split) { return kSplitNames[static_cast<size_t>(split)]; }

bool has_channel(const DatasetRequest& request, DatasetChannel channel) {
  return std::ranges::find(request.channels, channel) != request.channels.end();
}

fs::path scenario_of(const DatasetRequest& request, size_t world) {
  return request.scenarios[world / request.seeds.size()];
}
uint64_t seed_of(const DatasetRequest& request, size_t world) { return request.seeds[world % request.seeds.size()]; }

fs::path part_of(const DatasetRequest& request, size_t world, std::string_view suffix) {
  return request.out / "worlds" / fmt::format("{:06}.{}", world, suffix);
}

std::string request_json(const DatasetRequest& request) {
  const PoseBounds& b = request.bounds;
  std::vector<std::string> scenarios, channels;
  for (const fs::path& scenario : request.scenarios) scenarios.push_back(scenario.string());
  for (const DatasetChannel channel : request.channels) channels.emplace_back(name_of(channel));
  Json inputs = Json::object();  // files that are changed meanwhile would mix two data sets
  for (const fs::path& scenario : request.scenarios) {
    for (const auto& [file, hash] : load_flight(scenario, request.overrides).inputs) {
      inputs[scenario.string()][file] = hash;
    }
  }
  if (!request.poses.empty()) inputs[request.poses.string()] = sha256(request.poses);
  const Json json{{"build", std::string(build_identity())},
                  {"inputs", inputs},
                  {"scenarios", scenarios},
                  {"overrides", request.overrides},
                  {"seeds", request.seeds},
                  {"poses", request.poses.empty() ? "random" : request.poses.string()},
                  {"poses_of_camera", request.poses_of_camera},
                  {"camera", request.camera},
                  {"images", request.images},
                  {"channels", channels},
                  {"height_m", {b.min_height_m, b.max_height_m}},
                  {"tilt_rad", b.max_tilt_rad},
                  {"distance_m", {b.min_distance_m, b.max_distance_m}},
                  {"speed_mps", b.max_speed_mps},
                  {"turn_radps", b.max_turn_radps}};
  return json_text(json, 2) + "\n";
}

void add_pose(const std::optional<Cameras::Instant>& instant, CsvLine& line) {
  if (!instant) {
    for (int i = 0; i < 8; ++i) line.add(NAN);
    return;
  }
  const Eigen::Quaterniond q(instant->body.X_WB.linear());
  line.add(1e-9 * static_cast<double>(instant->t_ns)).add(Eigen::Vector3d(instant->body.X_WB.translation()));
  line.add(q.w()).add(Eigen::Vector3d(q.vec()));
}

constexpr std::string_view kManifestHead =
    "image,scenario,seed,split,camera,visibility_m,clearance_m,t_s,north_m,east_m,down_m,qw,qx,qy,qz,next_t_s,next_"
    "north_m,"
    "next_east_m,next_down_m,next_qw,next_qx,next_qy,next_qz,file\n";

/// Returns how many images a world has, and the number of its first.
std::pair<size_t, size_t> images_of(const DatasetRequest& request, size_t world, size_t poses) {
  if (request.images == 0) return {poses, world * poses};
  const size_t worlds = world_count(request), each = request.images / worlds, more = request.images % worlds;
  return {each + (world < more ? 1 : 0), world * each + std::min(world, more)};
}

/// Refuses a file of poses that cannot be read, or that has fewer poses than a world has images.
void check_poses(const DatasetRequest& request) {
  if (request.poses.empty()) return;
  const std::string file = request.poses.string();
  const size_t worlds = world_count(request);
  const size_t poses = parse_poses(read_file_whole(request.poses), file, {.of_camera = request.poses_of_camera}).size();
  if (request.images <= worlds * poses) return;
  throw InputError(fmt::format("--images {}: {} has {}; valid: up to {}{}", request.images, file,
                               counted(poses, "pose"), counted(worlds * poses, "image"),
                               worlds == 1 ? "" : fmt::format(" in {} worlds", worlds)));
}

/// A file's suffix and text.
struct CalibrationText {
  std::string_view suffix;
  std::string text;
};

/// Returns the calibration of a camera in a format that holds its lens: OpenCV's, Kalibr's chain for a double sphere,
/// or the file of OCamCalib.
CalibrationText calibration_of(const CameraConfig& camera, const dynamics::sensors::ImuConfig& imu) {
  using Model = CameraConfig::Model;
  if (camera.model_kind == Model::ocam) return {".txt", read_file_whole(camera.calibration)};
  const std::array<CameraConfig, 1> one = {camera};
  try {
    return {".yaml",
            camera.model_kind == Model::double_sphere ? kalibr_calibration(one, imu) : opencv_calibration(one, imu)};
  } catch (const std::invalid_argument& fault) {
    throw InputError(fault.what());
  }
}

}  // namespace

DatasetChannel dataset_channel(const std::string& name) {
  const auto found = std::ranges::find(kChannelNames, name);
  if (found == kChannelNames.end()) {
    throw InputError(fmt::format("--channels: unknown channel '{}'; valid: {}", name, fmt::join(kChannelNames, ", ")));
  }
  return static_cast<DatasetChannel>(found - kChannelNames.begin());
}

std::vector<Split> splits_of(size_t worlds) {
  const size_t tenth = (worlds + 5) / 10, held_out = worlds < 3 ? 0 : std::max<size_t>(1, tenth);
  std::vector<size_t> order(worlds);
  for (size_t i = 0; i < worlds; ++i) order[i] = i;
  Random random(stream_seed(worlds, "splits"));
  for (size_t i = worlds; i > 1; --i)
    std::swap(order[i - 1], order[static_cast<size_t>(uniform_index(random, static_cast<int>(i)))]);
  std::vector<Split> splits(worlds, Split::train);
  for (size_t i = 0; i < held_out; ++i) {
    splits[order[i]] = Split::val;
    splits[order[held_out + i]] = Split::test;
  }
  return splits;
}

size_t world_count(const DatasetRequest& request) { return request.scenarios.size() * request.seeds.size(); }

std::string world_name(const DatasetRequest& request, size_t world) {
  return fmt::format("{}-seed{}", scenario_of(request, world).stem().string(), seed_of(request, world));
}

void begin_dataset(const DatasetRequest& request, bool resume) {
  if (request.channels.empty()) throw InputError("--channels: name at least one");
  std::set<fs::path> names;
  for (const fs::path& scenario : request.scenarios) {
    if (names.insert(scenario.stem()).second) continue;
    throw InputError(fmt::format("{}: another scenario has this file name, by which the data set names its worlds",
                                 scenario.string()));
  }
  if (request.poses.empty() && request.images == 0) throw InputError("--images: random poses need a number of images");
  const PoseBounds& b = request.bounds;
  if (!(b.min_height_m < b.max_height_m)) throw InputError("--height: the first number must be the lower one");
  if (!(b.min_distance_m < b.max_distance_m)) throw InputError("--distance: the first number must be the lower one");
  const fs::path file = request.out / "request.json";
  std::error_code error;
  const bool is_used = fs::exists(request.out, error) && !fs::is_empty(request.out, error);
  if (is_used && !resume) {
    throw InputError(fmt::format("{}: is not an empty folder; continue an interrupted data set with --resume",
                                 request.out.string()));
  }
  check_poses(request);
  const std::string text = request_json(request);
  if (is_used && (!fs::exists(file) || read_file_whole(file) != text)) {
    throw InputError(fmt::format("{}: holds a data set of another request, of other files or of another build",
                                 request.out.string()));
  }
  require_writable(request.out);
  fs::create_directories(request.out / "worlds");
  fs::create_directories(request.out / "labels");
  fs::create_directories(request.out / "calibration");
  write_file_whole(file, text);
}

void abandon_dataset(const DatasetRequest& request) {
  for (size_t world = 0; world < world_count(request); ++world) {
    if (is_written(request, world)) return;
  }
  for (const std::string_view name : {"request.json", "worlds", "labels", "calibration"}) {
    fs::remove_all(request.out / name);
  }
  for (const std::string_view split : kSplitNames) fs::remove_all(request.out / split);
}

bool is_written(const DatasetRequest& request, size_t world) {
  std::error_code error;
  return fs::exists(part_of(request, world, "csv"), error);
}

void write_world(const DatasetRequest& request, size_t world) {
  DrawnWorld drawn(request, scenario_of(request, world), seed_of(request, world));
  const Scenario& scenario = drawn.scenario();
  const CalibrationText calibration = calibration_of(drawn.camera(), scenario.avionics.imu);  // may throw
  const Split split = splits_of(world_count(request))[world];
  const fs::path folder = request.out / name_of(split);
  for (const DatasetChannel channel : request.channels) fs::create_directories(folder / name_of(channel));
  const size_t wanted = request.images == 0 ? 0 : images_of(request, world, 0).first;
  const std::vector<Shot> shots = request.images > 0 && wanted == 0 ? std::vector<Shot>{} : drawn.shots(wanted);
  const size_t first = images_of(request, world, shots.size()).second;
  CocoImages coco(drawn.scene());
  fmt::memory_buffer rows;
  for (size_t i = 0; i < shots.size(); ++i) {
    const Shot& shot = shots[i];
    const std::string stem = fmt::format("{:06}", first + i);
    for (const DatasetChannel channel : request.channels) {
      if (channel == DatasetChannel::flow && !shot.next) continue;
      const cv::Mat image = drawn.image(channel, shot);
      const fs::path name = fs::path(name_of(channel)) / stem;
      if (channel == DatasetChannel::depth) {
        write_tiff(folder / (name.string() + ".tiff"), image);
      } else {
        write_png(folder / (name.string() + ".png"), image);
      }
      if (channel == DatasetChannel::instance) coco.add(first + i, stem + ".png", image);
    }
    CsvLine line(rows);
    line.add(stem).add(scenario.name).add(fmt::to_string(scenario.seed)).add(name_of(split)).add(drawn.camera().role);
    line.add(scenario.drawing.visibility_m);
    line.add(request.poses.empty() ? shot.now.body.clearance_m : NAN);
    add_pose(shot.now, line);
    add_pose(shot.next, line);
    line.add(scenario_of(request, world).stem().string());
  }
  write_file_whole(request.out / "labels" / (world_name(request, world) + ".json"), labels_json(drawn.scene()));
  const std::string calibration_name = scenario_of(request, world).stem().string().append(calibration.suffix);
  write_file_whole(request.out / "calibration" / calibration_name, calibration.text);
  write_file_whole(part_of(request, world, "json"), coco.json());
  write_file_whole(part_of(request, world, "csv"), fmt::to_string(rows));
}

void finish_dataset(const DatasetRequest& request) {
  std::string manifest(kManifestHead);
  const std::vector<Split> splits = splits_of(world_count(request));
  for (size_t world = 0; world < splits.size(); ++world) manifest += read_file_whole(part_of(request, world, "csv"));
  write_file_whole(request.out / "manifest.csv", manifest);
  if (!has_channel(request, DatasetChannel::instance)) return;
  for (const Split split : {Split::train, Split::val, Split::test}) {
    std::vector<std::string> parts;
    for (size_t world = 0; world < splits.size(); ++world) {
      if (splits[world] == split) parts.push_back(read_file_whole(part_of(request, world, "json")));
    }
    write_file_whole(request.out / fmt::format("coco_{}.json", name_of(split)), join_coco(parts));
  }
}

}  // namespace hedgehop::sim
