#include "sim/export/log_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sim/config/input_error.h"
#include "sim/scenario/calibration.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::sim {
namespace {

using avoidance::stereo::DisparitySource;

LoggedCamera logged(const CameraConfig& config, const dynamics::sensors::ImuConfig& imu) {
  LoggedCamera camera{.role = config.role, .rate_hz = config.rate_hz, .channel = config.channel};
  camera.model = config.model();
  camera.width_px = camera.model.width_px;
  camera.height_px = camera.model.height_px;
  if (!std::holds_alternative<vision::camera::OcamLens>(camera.model.lens)) {
    camera.lens = intrinsics(config, camera.model);
  }
  camera.X_FC = X_FC(imu, config);
  camera.has_depth = config.channel == CameraConfig::Channel::depth;
  return camera;
}

avoidance::Setup setup_of(const Scenario& scenario, const LoggedCamera& left, const LoggedCamera& right) {
  avoidance::Setup setup;
  const Eigen::Isometry3d X_BF = X_FB(scenario.avionics.imu).inverse();
  for (const LoggedCamera* camera : {&left, &right}) {
    setup.cameras.push_back({camera->role, camera->model, X_BF * camera->X_FC, camera->rate_hz});
  }
  return setup;
}

/// Returns the prefix of a role such as aft_left, empty for left; nullopt for another role.
std::optional<std::string> prefix_of_left(const std::string& role) {
  if (role == DisparitySource::kLeft) return "";
  const std::string end = std::string("_") + DisparitySource::kLeft;
  if (!role.ends_with(end)) return std::nullopt;
  return role.substr(0, role.size() - end.size());
}

}  // namespace

bool is_topic_word(std::string_view text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return !text.empty() && is_letter(text[0]) &&
         std::ranges::all_of(text, [&](char c) { return is_letter(c) || is_digit(c); });
}

std::vector<LoggedCamera> logged_cameras(const Scenario& scenario, const std::vector<std::string>& roles) {
  std::vector<CameraConfig> chosen = scenario.rig.select(roles);
  if (roles.empty()) chosen = scenario.rig.cameras;
  std::vector<LoggedCamera> cameras;
  for (const CameraConfig& camera : chosen) {
    if (!is_topic_word(camera.role)) {
      throw InputError(
          fmt::format("camera '{}': a role in a log has letters, digits and underscores only, and starts with no digit",
                      camera.role));
    }
    cameras.push_back(build_part("rig", [&] { return logged(camera, scenario.avionics.imu); }));
  }
  return cameras;
}

PairDepth::PairDepth(const Scenario& scenario, std::span<const LoggedCamera> cameras, size_t left, size_t right)
    : left_(left),
      right_(right),
      source_(DisparitySource::From::stereo, DisparitySource::Grey::needed, {},
              setup_of(scenario, cameras[left], cameras[right]), prefix_of_left(cameras[left].role).value_or("")) {}

const cv::Mat& PairDepth::match(std::span<const avoidance::CameraFrame> frames) {
  if (source_.update(frames)) {
    vision::stereo::to_depth(source_.disparity16(), source_.geometry(), depth_m_);
  } else {
    depth_m_.release();
  }
  return depth_m_;
}

std::vector<PairDepth> stereo_pairs(const Scenario& scenario, std::vector<LoggedCamera>& cameras) {
  std::vector<PairDepth> pairs;
  for (size_t left = 0; left < cameras.size(); ++left) {
    const std::optional<std::string> prefix = prefix_of_left(cameras[left].role);
    if (!prefix) continue;
    const std::string right_role = prefix->empty() ? DisparitySource::kRight : *prefix + "_" + DisparitySource::kRight;
    const auto right = std::ranges::find(cameras, right_role, &LoggedCamera::role);
    const auto is_grey = [](const LoggedCamera& c) { return c.channel == CameraConfig::Channel::grey; };
    if (right == cameras.end() || !is_grey(cameras[left]) || !is_grey(*right)) continue;
    try {
      pairs.emplace_back(scenario, cameras, left, static_cast<size_t>(right - cameras.begin()));
    } catch (const std::invalid_argument&) {  // no pair of parallel cameras
      continue;
    }
    cameras[left].has_depth = true;
    right->pair_baseline_m = pairs.back().baseline_m();
  }
  return pairs;
}

}  // namespace hedgehop::sim
