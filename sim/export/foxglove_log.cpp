#include "sim/export/foxglove_log.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>

#include "sim/export/foxglove_messages.h"
#include "sim/export/foxglove_schemas.h"
#include "sim/export/lens_model.h"
#include "sim/flight/build.h"
#include "sim/logfile/mcap_writer.h"
#include "sim/record/image_file.h"

namespace hedgehop::sim {
namespace {

constexpr const char* kWorld = "world";
constexpr const char* kBody = "body";
constexpr int kModuleImageQuality = 80;  // of the JPEG

std::string camera_frame(const LoggedCamera& camera) { return "camera/" + camera.role; }

/// The topics of one camera; kNone for a topic that it lacks.
struct CameraTopics {
  static constexpr int kNone = -1;
  int image = kNone, depth = kNone, true_depth = kNone, calibration = kNone, annotations = kNone;
  std::optional<LensModel> lens;
};

class FoxgloveLog : public LogSink {
 public:
  FoxgloveLog(const std::filesystem::path& file, ChunkCompression compression)
      : file_(file), compression_(compression) {}

  void on_start(const LogStart& start) override {
    mcap_.emplace(
        file_,
        McapOptions{.profile = "", .library = "hedgehop " + std::string(version()), .compression = compression_});
    scenario_ = &start.scenario;
    cameras_ = start.cameras;
    for (const LoggedCamera& camera : cameras_) topics_.push_back(topics_of(camera));
    tf_ = add("/tf", "foxglove.FrameTransforms");
    pose_ = add("/pose", "foxglove.PoseInFrame");
    estimate_ = add("/estimate", "foxglove.Odometry");
    events_ = add("/events", "foxglove.Log");
    scene_ = add("/scene", "foxglove.SceneUpdate");
    movers_ = add("/movers", "foxglove.SceneUpdate");
    module_image_ = add("/module/image", "foxglove.CompressedImage");
    imu_ = add_own("/imu", table_message("hedgehop.Imu", {},
                                         {"wx_radps", "wy_radps", "wz_radps", "fx_mps2", "fy_mps2", "fz_mps2"}));
    gps_ = add_own("/gps", table_message("hedgehop.Gps", {},
                                         {"north_m", "east_m", "down_m", "v_north_mps", "v_east_mps", "v_down_mps"}));
    state_ = add_own("/state", table_message("hedgehop.State", {}, start.state_columns));
    decision_ = add_own("/decision", table_message("hedgehop.Decision", {"status"}, start.decision_columns));
    clearance_ = add_own("/clearance", table_message("hedgehop.Clearance", {}, {"obstacle_m", "ground_m"}));
    log_scene(start.scene);
  }

  void on_imu(int64_t t_ns, const RecordedReading& r) override {
    log_numbers(imu_, t_ns, {r.w_F.x(), r.w_F.y(), r.w_F.z(), r.f_F.x(), r.f_F.y(), r.f_F.z()});
  }

  void on_gps(int64_t t_ns, const dynamics::sensors::GpsFix& fix) override {
    const Eigen::Vector3d &p = fix.p_WB_W_meas, &v = fix.v_WB_W_meas;
    log_numbers(gps_, t_ns, {p.x(), p.y(), p.z(), v.x(), v.y(), v.z()});
  }

  void on_image(int64_t t_ns, size_t camera, const cv::Mat& image, const LoggedMotion& estimate) override {
    log(topics_[camera].image, t_ns, compressed_image(t_ns, camera_frame(cameras_[camera]), png_of(image), "png"));
    log_calibration(t_ns, camera);
    log(topics_[camera].annotations, t_ns, annotations(t_ns, cameras_[camera], estimate));
  }

  void on_depth(int64_t t_ns, size_t camera, const cv::Mat& depth_m, const LoggedMotion&) override {
    log(topics_[camera].depth, t_ns, raw_depth_image(t_ns, camera_frame(cameras_[camera]), depth_mm(depth_m)));
    if (!cameras_[camera].has_images()) log_calibration(t_ns, camera);
  }

  void on_true_depth(int64_t t_ns, size_t camera, const cv::Mat& depth_m) override {
    log(topics_[camera].true_depth, t_ns, raw_depth_image(t_ns, camera_frame(cameras_[camera]), depth_mm(depth_m)));
  }

  void on_corners(int64_t t_ns, size_t camera, const cv::Mat& corners) override {
    log(topics_[camera].annotations, t_ns, corner_annotations(t_ns, corners));
  }

  void on_decision(int64_t t_ns, const LoggedDecision& decision) override {
    status_ = decision.status;
    ProtobufWriter message;
    message.add_message(1, time_message(t_ns)).add_bytes(2, decision.status);
    uint32_t field = 2;
    for (const auto& [name, value] : decision.columns) message.add_double(++field, value);
    log(decision_, t_ns, message);
    if (decision.image.empty()) return;
    log(module_image_, t_ns, compressed_image(t_ns, "", jpeg_of(decision.image, kModuleImageQuality), "jpeg"));
  }

  void on_state(int64_t t_ns, const LoggedState& state) override {
    ProtobufWriter transforms;
    transforms.add_message(1, transform_message(t_ns, kWorld, kBody, state.truth.X_EF));
    for (const LoggedCamera& camera : cameras_) {
      transforms.add_message(1, transform_message(t_ns, kBody, camera_frame(camera), camera.X_FC));
    }
    for (size_t i = 0; i < state.X_EM.size(); ++i) {
      transforms.add_message(1, transform_message(t_ns, kWorld, mover_frame(i), state.X_EM[i]));
    }
    log(tf_, t_ns, transforms);
    log(pose_, t_ns, pose_in_frame(t_ns, kWorld, state.truth.X_EF));
    log(estimate_, t_ns, odometry_message(t_ns, kWorld, kBody, state.estimate, state.sigmas));
    std::vector<double> numbers;
    for (const auto& [name, value] : state.columns) numbers.push_back(value);
    log_numbers(state_, t_ns, numbers);
    log_numbers(clearance_, t_ns, {state.row.obstacle_clearance_m, state.row.ground_clearance_m});
  }

  void on_event(int64_t t_ns, EventLevel level, const std::string& name, const std::string& message) override {
    log(events_, t_ns, log_message(t_ns, level, name, message));
  }

  void on_end(int64_t t_ns, const Flight& flight,
              const std::vector<std::pair<std::string, std::string>>& attachments) override {
    for (const auto& [name, text] : attachments) {
      const bool json = name.ends_with(".json");
      mcap_->attach(name, json ? "application/json" : "application/yaml", static_cast<uint64_t>(t_ns), text);
    }
    mcap_->add_metadata("hedgehop", {{"version", std::string(version())},
                                     {"build", std::string(build_identity())},
                                     {"scenario", scenario_->name},
                                     {"seed", std::to_string(scenario_->seed)},
                                     {"module", std::string(scenario_->avoidance.name())},
                                     {"outcome", std::string(to_string(flight.result.outcome))},
                                     {"trajectory_hash", flight.result.trajectory_hash}});
    mcap_->close();
  }

 private:
  int add_schema(const std::string& name, std::span<const ProtobufMessage> messages) {
    const auto [at, is_new] = schemas_.try_emplace(name, 0);
    if (is_new) at->second = mcap_->add_schema(name, "protobuf", file_descriptor_set(name, messages));
    return at->second;
  }

  int add(const std::string& topic, const std::string& schema) {
    const int number = add_schema(schema, foxglove_messages());
    return mcap_->add_channel(topic, static_cast<uint16_t>(number), "protobuf");
  }

  int add_own(const std::string& topic, const ProtobufMessage& message) {
    std::vector<ProtobufMessage> messages(foxglove_messages().begin(), foxglove_messages().end());
    messages.push_back(message);
    return mcap_->add_channel(topic, static_cast<uint16_t>(add_schema(message.name, messages)), "protobuf");
  }

  CameraTopics topics_of(const LoggedCamera& camera) {
    const std::string topic = "/camera/" + camera.role + "/";
    CameraTopics topics;
    topics.lens = lens_model(camera, "kannala_brandt");
    if (camera.has_images()) topics.image = add(topic + "image", "foxglove.CompressedImage");
    if (camera.has_depth) topics.depth = add(topic + "depth", "foxglove.RawImage");
    topics.true_depth = add(topic + "true_depth", "foxglove.RawImage");
    if (topics.lens) topics.calibration = add(topic + "calibration", "foxglove.CameraCalibration");
    topics.annotations = add(topic + "annotations", "foxglove.ImageAnnotations");
    return topics;
  }

  void log(int topic, int64_t t_ns, const ProtobufWriter& message) {
    mcap_->write(static_cast<uint16_t>(topic), static_cast<uint64_t>(t_ns), message.bytes());
  }

  void log_numbers(int topic, int64_t t_ns, std::span<const double> numbers) {
    ProtobufWriter message;
    message.add_message(1, time_message(t_ns));
    uint32_t field = 1;
    for (const double number : numbers) message.add_double(++field, number);
    log(topic, t_ns, message);
  }
  void log_numbers(int topic, int64_t t_ns, std::initializer_list<double> numbers) {
    log_numbers(topic, t_ns, std::span(numbers.begin(), numbers.size()));
  }

  /// Logs a calibration with the same time as its image, as viewers pair them.
  void log_calibration(int64_t t_ns, size_t camera) {
    const CameraTopics& topics = topics_[camera];
    if (!topics.lens) return;
    const LoggedCamera& logged = cameras_[camera];
    log(topics.calibration, t_ns, calibration_message(t_ns, camera_frame(logged), logged, *topics.lens));
  }

  ProtobufWriter annotations(int64_t t_ns, const LoggedCamera& camera, const LoggedMotion& estimate) const {
    if (!scenario_->goal) return flight_annotations(t_ns, status_, std::nullopt, NAN);
    const Eigen::Vector3d p_CG = (estimate.X_EF * camera.X_FC).inverse() * (R_EW() * scenario_->goal->p_WG());
    std::optional<Eigen::Vector2d> px = camera.model.project(p_CG);
    const auto inside = [](double at, int size) { return at >= -0.5 && at <= size - 0.5; };
    if (px && !(inside(px->x(), camera.width_px) && inside(px->y(), camera.height_px))) px.reset();
    return flight_annotations(t_ns, status_, px, p_CG.norm());
  }

  /// Logs the surfaces once, at the start: the objects in the world, the movers in frames that move.
  void log_scene(const scenes::Scene& scene) {
    ProtobufWriter objects, movers;
    for_each_object(scene,
                    [&](const SurfaceMesh& mesh) { objects.add_message(2, scene_entity(0, kWorld, mesh, false)); });
    log(scene_, 0, objects);
    size_t mover = 0;
    for_each_mover(scene, [&](const SurfaceMesh& mesh) {
      movers.add_message(2, scene_entity(0, mover_frame(mover++), mesh, true));
    });
    if (mover > 0) log(movers_, 0, movers);
  }

  std::filesystem::path file_;
  ChunkCompression compression_;
  std::optional<McapWriter> mcap_;  ///< from the start of the flight
  const Scenario* scenario_ = nullptr;
  std::vector<LoggedCamera> cameras_;
  std::vector<CameraTopics> topics_;
  std::map<std::string, int> schemas_;
  int tf_ = 0, pose_ = 0, estimate_ = 0, events_ = 0, scene_ = 0, movers_ = 0, module_image_ = 0, imu_ = 0, gps_ = 0,
      state_ = 0, decision_ = 0, clearance_ = 0;
  std::string status_;  ///< of the last decision
};

}  // namespace

std::unique_ptr<LogSink> foxglove_log(const std::filesystem::path& file, ChunkCompression compression) {
  return std::make_unique<FoxgloveLog>(file, compression);
}

}  // namespace hedgehop::sim
