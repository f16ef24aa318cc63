#include "avoidance/module.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace hedgehop::avoidance {
namespace {

int image_type(CameraNeed::Channel channel) {
  switch (channel) {
    case CameraNeed::Channel::grey:
      return CV_8UC1;
    case CameraNeed::Channel::color:
      return CV_8UC3;
    case CameraNeed::Channel::depth:
      return CV_32FC1;
    case CameraNeed::Channel::corners:
      return CV_64FC2;
  }
  throw std::logic_error("a camera need names no channel");
}

bool is_finite(const NavigationState& navigation) {
  return navigation.p_WB_est.allFinite() && navigation.q_WB_est.coeffs().allFinite() &&
         navigation.v_WB_B_est.allFinite() && navigation.w_WB_B_est.allFinite() &&
         navigation.q_WB_gyro.coeffs().allFinite() && std::isfinite(navigation.height_above_ground_m) &&
         std::isfinite(navigation.range_m.value_or(0.0));
}

struct IsFinite {
  bool operator()(const VelocityCommand& c) const {
    return c.v_WB_W.allFinite() && std::isfinite(c.altitude_m) && std::isfinite(c.heading_rad);
  }
  bool operator()(const PositionCommand& c) const { return c.p_WB.allFinite() && std::isfinite(c.heading_rad); }
  bool operator()(const AttitudeCommand& c) const {
    return std::isfinite(c.roll_rad) && std::isfinite(c.pitch_rad) && std::isfinite(c.heading_rad) &&
           std::isfinite(c.altitude_m);
  }
  bool operator()(const HoverCommand& c) const { return std::isfinite(c.yaw_rate_radps); }
};

template <class... Parts>
std::string joined(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

/// Returns the type and the values of a command: "HoverCommand", "yaw rate nan rad/s".
struct TypeAndValues {
  using Texts = std::pair<std::string, std::string>;
  Texts operator()(const VelocityCommand& c) const {
    return {"VelocityCommand", joined("velocity (", c.v_WB_W.x(), ", ", c.v_WB_W.y(), ") m/s, altitude ", c.altitude_m,
                                      " m, heading ", c.heading_rad, " rad")};
  }
  Texts operator()(const PositionCommand& c) const {
    return {"PositionCommand", joined("position (", c.p_WB.x(), ", ", c.p_WB.y(), ", ", c.p_WB.z(), ") m, heading ",
                                      c.heading_rad, " rad")};
  }
  Texts operator()(const AttitudeCommand& c) const {
    return {"AttitudeCommand", joined("roll ", c.roll_rad, " rad, pitch ", c.pitch_rad, " rad, heading ", c.heading_rad,
                                      " rad, altitude ", c.altitude_m, " m")};
  }
  Texts operator()(const HoverCommand& c) const {
    return {"HoverCommand", joined("yaw rate ", c.yaw_rate_radps, " rad/s")};
  }
};

void check_frame(const CameraFrame& frame, int64_t now_ns, const Setup& setup, const Needs& needs) {
  const MountedCamera* camera = find_camera(setup, frame.role);
  if (!camera) throw std::logic_error("a frame comes from camera '" + frame.role + "', which reset() did not name");
  if (frame.t_ns > now_ns) throw std::logic_error("a frame of camera '" + frame.role + "' comes from the future");
  const bool is_image = frame.image.type() != image_type(CameraNeed::Channel::corners);
  if (is_image && frame.image.size() != cv::Size(camera->model.width_px, camera->model.height_px)) {
    throw std::logic_error("a frame of camera '" + frame.role + "' does not have its camera's size");
  }
  if (!is_image && frame.image.cols != 1) {
    throw std::logic_error("the corners of camera '" + frame.role + "' are not one to a row");
  }
  for (const CameraNeed& need : needs.cameras) {
    if (need.role == frame.role && frame.image.type() != image_type(need.channel)) {
      throw std::logic_error("a frame of camera '" + frame.role + "' does not have the channel that the module needs");
    }
  }
}

/// Whether a module may give commands of a type. All may hover, and a module without a declaration may give any.
bool declares(const Needs& needs, CommandType type) {
  return needs.commands.empty() || type == CommandType::hover || std::ranges::count(needs.commands, type) > 0;
}

}  // namespace

const MountedCamera* find_camera(const Setup& setup, std::string_view role) {
  const auto camera = std::ranges::find(setup.cameras, role, &MountedCamera::role);
  return camera == setup.cameras.end() ? nullptr : &*camera;
}

const MountedCamera& required_camera(const Setup& setup, std::string_view role) {
  const MountedCamera* const camera = find_camera(setup, role);
  if (!camera) throw std::invalid_argument("a camera '" + std::string(role) + "' is needed");
  return *camera;
}

const CameraFrame* find_frame(std::span<const CameraFrame> frames, std::string_view role) {
  const auto frame = std::ranges::find(frames, role, &CameraFrame::role);
  return frame == frames.end() ? nullptr : &*frame;
}

void confine(Command& command, double speed_limit_mps) {
  if (!std::visit(IsFinite{}, command)) {
    const auto [type, values] = std::visit(TypeAndValues{}, command);
    throw std::invalid_argument(type + " is not finite: " + values);
  }
  if (auto* velocity = std::get_if<VelocityCommand>(&command)) {
    const double speed_mps = velocity->v_WB_W.norm();
    if (speed_mps > speed_limit_mps) velocity->v_WB_W *= speed_limit_mps / speed_mps;
  }
}

void Module::reset(const Setup& setup) {
  setup_.reset();
  last_t_ns_.reset();
  needs_ = needs();
  for (const CameraNeed& need : needs_.cameras) {
    const MountedCamera* camera = find_camera(setup, need.role);
    if (!camera) throw std::invalid_argument("the module needs a camera '" + need.role + "', which the rig lacks");
    if (!(camera->rate_hz > 0.0)) throw std::invalid_argument("camera '" + need.role + "' needs a rate above 0 Hz");
    if (need.pinhole && !camera->model.is_undistorted_pinhole()) {
      throw std::invalid_argument("the module needs camera '" + need.role + "' to be an undistorted pinhole, got a " +
                                  camera->model.lens_name());
    }
  }
  if (!(setup.limits.speed_mps > 0.0)) throw std::invalid_argument("the vehicle's speed limit must be above 0 m/s");
  signal_count_ = signals().size();
  do_reset(setup);
  setup_ = setup;
}

Decision Module::update(const Observation& observation) {
  if (!setup_) throw std::logic_error("a module's update() comes before its reset()");
  if (last_t_ns_ && observation.t_ns <= *last_t_ns_) throw std::logic_error("a module's time must rise");
  if (!is_finite(observation.navigation)) throw std::logic_error("a module's navigation state must be finite");
  if (!observation.goal.p_WG.allFinite() || !std::isfinite(observation.goal.heading_rad)) {
    throw std::logic_error("a module's goal must be finite");
  }
  for (const CameraFrame& frame : observation.frames) check_frame(frame, observation.t_ns, *setup_, needs_);
  last_t_ns_ = observation.t_ns;

  Decision decision = do_update(observation);

  if (decision.signals.size() != signal_count_) {
    throw std::logic_error("a module gave " + std::to_string(decision.signals.size()) + " signals and announced " +
                           std::to_string(signal_count_));
  }
  if (!declares(needs_, type_of(decision.command))) {
    throw std::logic_error("a module gave a command of a type that it does not declare");
  }
  try {
    confine(decision.command, setup_->limits.speed_mps);
  } catch (const std::invalid_argument& error) {
    throw std::logic_error(std::string("the module's ") + error.what());
  }
  return decision;
}

}  // namespace hedgehop::avoidance
