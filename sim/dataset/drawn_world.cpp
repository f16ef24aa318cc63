#include "sim/dataset/drawn_world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "sim/dataset/pose_file.h"
#include "sim/export/true_images.h"
#include "sim/libm/random.h"
#include "sim/record/image_file.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {

DrawnWorld::DrawnWorld(const DatasetRequest& request, const std::filesystem::path& scenario, uint64_t seed)
    : DrawnWorld(request, load_flight(scenario, request.overrides, seed)) {}

DrawnWorld::DrawnWorld(const DatasetRequest& request, LoadedScenario loaded)
    : request_(request),
      scenario_(std::move(loaded.scenario)),
      environment_(scenario_, std::move(loaded.parts.files)),
      cameras_(scenario_.rig, Ticks(scenario_.physics_rate_hz.value()), *environment_.scene, environment_.renderer,
               scenario_.seed),
      camera_(camera_index()) {}

std::vector<Shot> DrawnWorld::shots(size_t count) {
  return request_.poses.empty() ? random_shots(count) : shots_of_file(count);
}

cv::Mat DrawnWorld::image(DatasetChannel channel, const Shot& shot) {
  const auto draw = [&](ImageChannel drawn) {
    return cameras_.image(camera_, drawn, shot.now, shot.next.value_or(shot.now));
  };
  switch (channel) {
    case DatasetChannel::grey:
      return draw(ImageChannel::grey);
    case DatasetChannel::color:
      return draw(ImageChannel::color);
    case DatasetChannel::depth:
      return draw(ImageChannel::depth);
    case DatasetChannel::flow:
      return kitti_flow(draw(ImageChannel::flow));
    case DatasetChannel::semantic:
      return labels_16bit(draw(ImageChannel::semantic));
    case DatasetChannel::instance:
      return labels_16bit(draw(ImageChannel::labels));
  }
  throw std::logic_error("a channel without a name");
}

size_t DrawnWorld::camera_index() const {
  if (!request_.camera.empty()) {
    scenario_.rig.select({request_.camera});
    return cameras_.index(request_.camera);
  }
  const auto has_images = [](const CameraConfig& c) {
    return c.channel == CameraConfig::Channel::grey || c.channel == CameraConfig::Channel::color;
  };
  const auto first = std::ranges::find_if(scenario_.rig.cameras, has_images);
  if (first == scenario_.rig.cameras.end()) throw InputError("the rig has no camera with images");
  return static_cast<size_t>(first - scenario_.rig.cameras.begin());
}

std::vector<Shot> DrawnWorld::random_shots(size_t count) {
  const double period_s = 1.0 / camera().rate_hz;
  std::vector<Shot> shots;
  for (const RandomPose& pose : random_poses(count, request_.bounds, scenario_.duration_s, scene(),
                                             environment_.collision, stream_seed(scenario_.seed, "dataset"))) {
    const BodyMotion body{pose.X_WB, pose.v_WB_W, pose.w_WB_B, pose.clearance_m};
    Shot shot{.now = {std::llround(1e9 * pose.t_s), body}, .next = {}};
    shot.next = Cameras::Instant{std::llround(1e9 * (pose.t_s + period_s)), {.X_WB = body.X_WB_after(period_s)}};
    shots.push_back(shot);
  }
  return shots;
}

std::vector<Shot> DrawnWorld::shots_of_file(size_t count) const {
  const Eigen::Isometry3d X_BC = camera().X_BC();
  Eigen::Isometry3d X_WB_start = Eigen::Isometry3d::Identity();
  X_WB_start.linear() = Eigen::AngleAxisd(scenario_.start.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X_WB_start.translation() = scenario_.start.p_WB();
  const PoseReading reading{request_.poses_of_camera, scenario_.avionics.imu.p_BI_m, X_WB_start * X_BC};
  const std::vector<TimedPose> poses = parse_poses(read_file_whole(request_.poses), request_.poses.string(), reading);
  const size_t taken = count == 0 ? poses.size() : std::min(count, poses.size());
  std::vector<Shot> shots;
  for (size_t i = 0; i < taken; ++i) {
    const TimedPose& pose = poses[i * poses.size() / taken];
    const Eigen::Isometry3d X_WB = request_.poses_of_camera ? pose.pose_W * X_BC.inverse() : pose.pose_W;
    shots.push_back({.now = {std::llround(1e9 * std::max(0.0, pose.t_s)), {.X_WB = X_WB}}, .next = {}});
    if (i > 0) shots[i - 1].next = shots[i].now;
  }
  return shots;
}

}  // namespace hedgehop::sim
