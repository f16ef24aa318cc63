#include "sim/export/rosbag_log.h"

#include <algorithm>
#include <map>
#include <optional>

#include "sim/config/whole_file.h"
#include "sim/export/level_scan.h"
#include "sim/export/ros_definitions.h"
#include "sim/export/ros_messages.h"
#include "sim/export/rosbag_metadata.h"
#include "sim/flight/build.h"
#include "sim/logfile/mcap_writer.h"
#include "sim/record/image_file.h"

namespace hedgehop::sim {
namespace {

constexpr const char* kMap = "map";
constexpr const char* kOdom = "odom";
constexpr const char* kBaseLink = "base_link";
constexpr const char* kBagFile = "flight_0.mcap";
constexpr double kMinScanM = 0.1, kMaxScanM = 65.5;  // of the depth images

std::string optical_frame(const LoggedCamera& camera) { return camera.role + "_optical_frame"; }
std::string level_frame(const LoggedCamera& camera) { return camera.role + "_level"; }
/// Slashes are no part of ROS names of frames.
std::string ros_mover_frame(size_t mover) { return "mover_" + std::to_string(mover); }

/// The topics of one camera; kNone for a topic that it lacks.
struct RosCameraTopics {
  static constexpr int kNone = -1;
  int image = kNone, info = kNone, depth = kNone, depth_info = kNone, true_depth = kNone, scan = kNone;
  std::optional<LensModel> lens;
};

class RosbagLog : public LogSink {
 public:
  RosbagLog(const std::filesystem::path& folder, const RosbagOptions& options) : folder_(folder), options_(options) {}

  void on_start(const LogStart& start) override {
    mcap_.emplace(folder_ / kBagFile, McapOptions{.profile = "ros2",
                                                  .library = "hedgehop " + std::string(version()),
                                                  .compression = options_.compression});
    scenario_ = &start.scenario;
    cameras_ = start.cameras;
    for (const LoggedCamera& camera : cameras_) topics_.push_back(topics_of(camera));
    imu_ = add("/imu/data_raw", "sensor_msgs/msg/Imu");
    fix_ = add("/gps/fix", "sensor_msgs/msg/NavSatFix");
    odometry_ = add("/odom", "nav_msgs/msg/Odometry");
    truth_ = add("/ground_truth/odom", "nav_msgs/msg/Odometry");
    tf_ = add("/tf", "tf2_msgs/msg/TFMessage");
    tf_static_ = add("/tf_static", "tf2_msgs/msg/TFMessage", RosDurability::latched);
    scene_ = add("/scene", "visualization_msgs/msg/MarkerArray", RosDurability::latched);
    movers_ = add("/movers", "visualization_msgs/msg/MarkerArray", RosDurability::latched);
    log_static_transforms();
    log_scene(start.scene);
  }

  void on_imu(int64_t t_ns, const RecordedReading& reading) override {
    log(imu_, t_ns, ros_imu({t_ns, kBaseLink}, reading, scenario_->avionics.imu));
  }

  /// The time of a fix is that of its position, one latency before its arrival.
  void on_gps(int64_t t_ns, const dynamics::sensors::GpsFix& fix) override {
    const dynamics::sensors::GpsConfig& gps = scenario_->avionics.gps;
    const int64_t measured_ns = t_ns - std::llround(1e9 * gps.latency_s);
    log(fix_, t_ns, ros_fix({measured_ns, kBaseLink}, fix.p_WB_W_meas, gps));
  }

  void on_image(int64_t t_ns, size_t camera, const cv::Mat& image, const LoggedMotion&) override {
    const RosHeader header{t_ns, optical_frame(cameras_[camera])};
    if (options_.compressed_images) {
      log(topics_[camera].image, t_ns, ros_compressed_image(header, "png", png_of(image)));
    } else {
      log(topics_[camera].image, t_ns, ros_image(header, image));
    }
    log_info(topics_[camera].info, t_ns, camera);
  }

  void on_depth(int64_t t_ns, size_t camera, const cv::Mat& depth_m, const LoggedMotion& estimate) override {
    const LoggedCamera& logged = cameras_[camera];
    log(topics_[camera].depth, t_ns, ros_image({t_ns, optical_frame(logged)}, depth_mm(depth_m)));
    log_info(topics_[camera].depth_info, t_ns, camera);
    if (topics_[camera].scan == RosCameraTopics::kNone) return;
    const auto scan = level_scan(depth_m, logged.model.pinhole(), estimate.X_EF * logged.X_FC, kMaxScanM);
    if (!scan) return;
    const RosTransform transform{{t_ns, kOdom}, level_frame(logged), scan->X_ECl};
    log(tf_, t_ns, ros_transforms({&transform, 1}));
    log(topics_[camera].scan, t_ns,
        ros_laser_scan({t_ns, level_frame(logged)}, *scan, 1.0 / logged.rate_hz, kMinScanM, kMaxScanM));
  }

  void on_true_depth(int64_t t_ns, size_t camera, const cv::Mat& depth_m) override {
    log(topics_[camera].true_depth, t_ns, ros_image({t_ns, optical_frame(cameras_[camera])}, depth_mm(depth_m)));
  }

  void on_state(int64_t t_ns, const LoggedState& state) override {
    std::vector<RosTransform> transforms{{{t_ns, kOdom}, kBaseLink, state.estimate.X_EF}};
    for (size_t i = 0; i < state.X_EM.size(); ++i) {
      transforms.push_back({{t_ns, kMap}, ros_mover_frame(i), state.X_EM[i]});
    }
    log(tf_, t_ns, ros_transforms(transforms));
    log(odometry_, t_ns, ros_odometry({t_ns, kOdom}, kBaseLink, state.estimate, state.sigmas));
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    log(truth_, t_ns, ros_odometry({t_ns, kMap}, kBaseLink, state.truth, {zero, zero, zero, zero}));
  }

  void on_end(int64_t t_ns, const Flight&,
              const std::vector<std::pair<std::string, std::string>>& attachments) override {
    for (const auto& [name, text] : attachments) {
      mcap_->attach(name, "text/plain", static_cast<uint64_t>(kStartTimeNs + t_ns), text);
    }
    std::vector<RosTopic> used;
    for (const auto& [channel, topic] : named_) {
      used.push_back(topic);
      used.back().messages = mcap_->message_count(channel);
    }
    std::erase_if(used, [](const RosTopic& topic) { return topic.messages == 0; });
    mcap_->close();
    write_file_whole(folder_ / "metadata.yaml", rosbag_metadata(kBagFile, kStartTimeNs, last_ns_, used));
  }

 private:
  int add(const std::string& topic, const std::string& type, RosDurability durability = RosDurability::fleeting) {
    const auto [at, is_new] = schemas_.try_emplace(type, uint16_t{0});
    if (is_new) at->second = mcap_->add_schema(type, "ros2msg", ros_definition(type));
    const uint16_t channel =
        mcap_->add_channel(topic, at->second, "cdr", {{"offered_qos_profiles", qos_profiles(durability)}});
    named_.emplace(channel, RosTopic{topic, type, durability});
    return channel;
  }

  RosCameraTopics topics_of(const LoggedCamera& camera) {
    const std::string topic = "/camera/" + camera.role + "/";
    RosCameraTopics topics;
    topics.lens = lens_model(camera, "equidistant");
    if (camera.has_images()) {
      topics.image = options_.compressed_images ? add(topic + "image_raw/compressed", "sensor_msgs/msg/CompressedImage")
                                                : add(topic + "image_raw", "sensor_msgs/msg/Image");
      if (topics.lens) topics.info = add(topic + "camera_info", "sensor_msgs/msg/CameraInfo");
    }
    if (camera.has_depth) {
      topics.depth = add(topic + "depth/image_raw", "sensor_msgs/msg/Image");
      if (topics.lens) topics.depth_info = add(topic + "depth/camera_info", "sensor_msgs/msg/CameraInfo");
      if (camera.model.is_undistorted_pinhole()) topics.scan = add(topic + "scan", "sensor_msgs/msg/LaserScan");
    }
    topics.true_depth = add(topic + "true_depth/image_raw", "sensor_msgs/msg/Image");
    return topics;
  }

  void log(int topic, int64_t t_ns, const CdrWriter& message) {
    last_ns_ = std::max(last_ns_, t_ns);
    mcap_->write(static_cast<uint16_t>(topic), static_cast<uint64_t>(kStartTimeNs + t_ns), message.bytes());
  }

  void log_info(int topic, int64_t t_ns, size_t camera) {
    if (topic == RosCameraTopics::kNone) return;
    const LoggedCamera& logged = cameras_[camera];
    log(topic, t_ns, ros_camera_info({t_ns, optical_frame(logged)}, logged, *topics_[camera].lens));
  }

  void log_static_transforms() {
    std::vector<RosTransform> transforms;
    for (const LoggedCamera& camera : cameras_) {
      transforms.push_back({{0, kBaseLink}, optical_frame(camera), camera.X_FC});
    }
    if (!transforms.empty()) log(tf_static_, 0, ros_transforms(transforms));
  }

  void log_scene(const scenes::Scene& scene) {
    RosMarkers objects, movers;
    for_each_object(scene, [&](const SurfaceMesh& mesh) { objects.add({0, kMap}, mesh, false); });
    log(scene_, 0, objects.message());
    for_each_mover(scene, [&](const SurfaceMesh& mesh) {
      movers.add({0, ros_mover_frame(movers.count())}, mesh, true);
    });
    if (movers.count() > 0) log(movers_, 0, movers.message());
  }

  std::filesystem::path folder_;
  RosbagOptions options_;
  std::optional<McapWriter> mcap_;  ///< from the start of the flight
  const Scenario* scenario_ = nullptr;
  std::vector<LoggedCamera> cameras_;
  std::vector<RosCameraTopics> topics_;
  std::map<std::string, uint16_t> schemas_;
  std::map<uint16_t, RosTopic> named_;
  int imu_ = 0, fix_ = 0, odometry_ = 0, truth_ = 0, tf_ = 0, tf_static_ = 0, scene_ = 0, movers_ = 0;
  int64_t last_ns_ = 0;
};

}  // namespace

std::unique_ptr<LogSink> rosbag_log(const std::filesystem::path& folder, const RosbagOptions& options) {
  return std::make_unique<RosbagLog>(folder, options);
}

}  // namespace hedgehop::sim
