#include "sim/export/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/export/formats.h"
#include "sim/export/log_export.h"
#include "sim/export/sensor_record.h"
#include "sim/export/true_images.h"
#include "sim/flight/build.h"
#include "sim/link/open_link.h"
#include "sim/record/image_file.h"
#include "sim/record/labels_file.h"
#include "sim/scenario/rig.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim {
namespace {

RecordedCamera recorded(const CameraConfig& config, const dynamics::sensors::ImuConfig& imu, uint64_t seed) {
  const vision::camera::Camera model = config.model();
  return {.role = config.role,
          .width_px = model.width_px,
          .height_px = model.height_px,
          .rate_hz = config.rate_hz,
          .lens = intrinsics(config, model),
          .X_FC = X_FC(imu, config),
          .X_FC_true = X_FC(imu, true_X_BC(config, model, seed)),
          .t_ns = {}};
}

/// Returns the cameras to export, in the order of `requested`.
std::vector<RecordedCamera> select_cameras(const Scenario& scenario, const std::vector<std::string>& requested) {
  using Channel = CameraConfig::Channel;
  const auto has_images = [](const CameraConfig& c) {
    return c.channel == Channel::grey || c.channel == Channel::color;
  };
  std::vector<CameraConfig> chosen = scenario.rig.select(requested);
  for (const CameraConfig& camera : chosen) {
    if (has_images(camera)) continue;
    const std::string_view what = camera.channel == Channel::depth ? "depth" : "corners";
    throw InputError(fmt::format("--camera {}: has {}, not images", camera.role, what));
  }
  if (requested.empty()) std::ranges::copy_if(scenario.rig.cameras, std::back_inserter(chosen), has_images);
  if (chosen.empty()) throw InputError("the rig has no camera with images");
  std::vector<RecordedCamera> cameras;
  for (const CameraConfig& camera : chosen) {
    cameras.push_back(build_part("rig", [&] { return recorded(camera, scenario.avionics.imu, scenario.seed); }));
  }
  return cameras;
}

std::vector<DataFile> texts(DataFormat format, const SensorRecord& record) {
  if (format == DataFormat::tum) return tum_files(record);
  return format == DataFormat::kitti ? kitti_files(record) : euroc_files(record);
}

/// Reports before the flight if the format does not support the cameras.
void check(const ExportRequest& request, SensorRecord record) {
  if (request.format == DataFormat::tum) {
    if (record.cameras.size() > 1) {
      std::string names;
      for (const RecordedCamera& camera : record.cameras) names += (names.empty() ? "" : ", ") + camera.role;
      throw InputError("the TUM format supports one camera; select it with --camera: " + names);
    }
    if (record.cameras[0].lens.model != Intrinsics::Model::pinhole) {
      throw InputError(fmt::format("camera '{}': the TUM format supports pinholes only", record.cameras[0].role));
    }
  }
  texts(request.format, record);
  require_empty(request.out);
}

/// Returns a 16-bit depth image, see kTumDepthPerMeter.
cv::Mat tum_depth_image(const cv::Mat& depth_m) {
  cv::Mat depth(depth_m.size(), CV_16UC1, cv::Scalar(0));
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const double units = std::round(kTumDepthPerMeter * static_cast<double>(depth_m.at<float>(v, u)));
      if (units <= 65535.0) depth.at<uint16_t>(v, u) = static_cast<uint16_t>(units);
    }
  }
  return depth;
}

/// Writes images during the flight and stores the other readings. An image is written once a later IMU reading follows,
/// so that the readings enclose the images, as estimators require.
class Recorder : public FlightWatcher {
 public:
  using Progress = std::function<void(double, double, double)>;
  Recorder(const ExportRequest& request, SensorRecord& record, const Progress& progress)
      : request_(request), record_(record), progress_(progress), true_images_(request.depth) {}

  bool wants_sensors() const override { return true; }
  void on_progress(double t_s, double duration_s, double goal_distance_m) override {
    progress_(t_s, duration_s, goal_distance_m);
  }

  void on_sensors(const SensorTick& tick) override {
    if (tick.imu) {
      write_pending();
      const Eigen::Matrix3d R = R_FB();
      record_.imu.push_back({tick.t_ns, R * tick.imu->w_WB_B_meas, R * tick.imu->specific_force_B_meas});
    }
    const bool images = !record_.imu.empty() && record_.imu.front().t_ns < tick.t_ns && take_images(tick);
    if (tick.imu || images) record_.states.push_back(state(tick));
  }

  /// Drops the images that no IMU reading follows.
  void close() {
    for (RecordedCamera& camera : record_.cameras) {
      while (!camera.t_ns.empty() && camera.t_ns.back() >= record_.imu.back().t_ns) camera.t_ns.pop_back();
    }
  }

 private:
  RecordedState state(const SensorTick& tick) const {
    const dynamics::RigidBodyState& body = tick.body_true;
    const Eigen::Vector3d& p_BI = record_.imu_config.p_BI_m;
    Eigen::Isometry3d X_WI = Eigen::Isometry3d::Identity();
    X_WI.linear() = body.q_WB.toRotationMatrix();
    X_WI.translation() = body.p_WB + body.q_WB * p_BI;
    const Eigen::Vector3d v_WI_B = body.v_WB_B + body.w_WB_B.cross(p_BI);
    return {tick.t_ns, X_EF(X_WI), R_EW() * (body.q_WB * v_WI_B), R_FB() * tick.imu_bias.w_WB_B_meas,
            R_FB() * tick.imu_bias.specific_force_B_meas};
  }

  bool take_images(const SensorTick& tick) {
    std::vector<const avoidance::CameraFrame*> frames;
    for (const RecordedCamera& camera : record_.cameras)
      frames.push_back(avoidance::find_frame(tick.frames, camera.role));
    // KITTI numbers the images of all cameras equally, so an instant with a lost image is omitted.
    const bool lost = std::ranges::find(frames, nullptr) != frames.end();
    if (request_.format == DataFormat::kitti && lost) return false;
    bool any = false;
    for (size_t i = 0; i < frames.size(); ++i) {
      if (!frames[i]) continue;
      any = true;
      const std::filesystem::path file = image_file(i, tick.t_ns);
      pending_.push_back({file, frames[i]->image.clone()});
      if (request_.truth) {
        std::ranges::move(true_images_.images(i, record_.cameras[i].role, tick, file.stem().string()),
                          std::back_inserter(pending_));
      }
      if (request_.format == DataFormat::tum) {
        pending_.push_back({tum_depth(tick.t_ns), tum_depth_image(tick.depth(record_.cameras[i].role))});
      }
      record_.cameras[i].t_ns.push_back(tick.t_ns);
    }
    return any;
  }

  std::filesystem::path image_file(size_t camera, int64_t t_ns) const {
    if (request_.format == DataFormat::tum) return tum_image(t_ns);
    if (request_.format == DataFormat::euroc) return euroc_image(camera, t_ns);
    return kitti_image(camera, record_.cameras[camera].t_ns.size());
  }

  void write_pending() {
    for (const auto& [name, image] : pending_) {
      const std::filesystem::path file = request_.out / name;
      std::filesystem::create_directories(file.parent_path());
      image.type() == CV_32FC1 ? write_tiff(file, image) : write_png(file, image);
    }
    pending_.clear();
  }

  const ExportRequest& request_;
  SensorRecord& record_;
  const Progress& progress_;
  TrueImages true_images_;
  std::vector<ImageFile> pending_;  ///< images that no IMU reading follows yet
};

}  // namespace

const RecordedState& state_at(const SensorRecord& record, int64_t t_ns) {
  const auto at = std::ranges::lower_bound(record.states, t_ns, {}, &RecordedState::t_ns);
  if (at == record.states.end() || at->t_ns != t_ns) throw std::out_of_range("no state was recorded at this time");
  return *at;
}

namespace {

void write_origin(const Scenario& scenario, const ExportRequest& request, const Flight& flight) {
  nlohmann::ordered_json origin{{"scenario", scenario.name},
                                {"seed", scenario.seed},
                                {"version", std::string(version())},
                                {"build", std::string(build_identity())},
                                {"start_time_ns", start_time_ns(request.format)},
                                {"truth_used", flight.result.truth_used},
                                {"trajectory_hash", flight.result.trajectory_hash}};
  write_file_whole(request.out / "origin.json", json_text(origin, 2) + "\n");
}

Flight export_data_set(const Scenario& scenario, const ExportRequest& request, const Recorder::Progress& progress,
                       const std::filesystem::path& run_folder) {
  SensorRecord record;
  record.cameras = select_cameras(scenario, request.cameras);
  record.imu_config = scenario.avionics.imu;
  check(request, record);
  Recorder recorder(request, record, progress);
  const std::unique_ptr<OutsideAutopilot> autopilot = link::recorded_link(scenario, run_folder);
  Flight flight = Simulation(scenario, {}, &recorder, autopilot.get()).run();
  recorder.close();
  for (const DataFile& file : texts(request.format, record)) {
    std::filesystem::create_directories((request.out / file.name).parent_path());
    write_file_whole(request.out / file.name, file.text);
  }
  if (request.truth) write_file_whole(request.out / "truth/labels.json", labels_json(*flight.scene));
  return flight;
}

}  // namespace

Flight export_flight(const Scenario& scenario, const ExportRequest& request,
                     const std::function<void(double, double, double)>& progress,
                     const std::filesystem::path& run_folder) {
  Flight flight = is_log(request.format) ? export_log(scenario, request, progress, run_folder)
                                         : export_data_set(scenario, request, progress, run_folder);
  write_origin(scenario, request, flight);
  return flight;
}

}  // namespace hedgehop::sim
