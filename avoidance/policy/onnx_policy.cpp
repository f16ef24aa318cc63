#include "avoidance/policy/onnx_policy.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "avoidance/policy/action_pilot.h"
#include "avoidance/policy/network.h"
#include "sim/fields/bounds.h"
#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::policy {

std::string PolicyImage::input() const {
  switch (channel) {
    case CameraNeed::Channel::color:
      return camera + "_color";
    case CameraNeed::Channel::depth:
      return camera + "_depth";
    default:
      return camera + "_grey";
  }
}

namespace {

[[noreturn]] void refuse(const OnnxPolicyConfig& config, const std::string& why) {
  throw std::invalid_argument("file '" + config.file.string() + "': " + why);
}

std::unique_ptr<Network> network_of(const OnnxPolicyConfig& config) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(config.file, error)) refuse(config, "no such file");
  try {
    return read_network(config.file);
  } catch (const std::invalid_argument& fault) {
    refuse(config, fault.what());
  }
}

/// Returns depth as hedgehop.Env does: 0 to `far_m`, m, which is also the depth of missing and unknown surfaces.
cv::Mat bounded_depth(const cv::Mat& depth_m, double far_m) {
  cv::Mat_<float> bounded = depth_m.clone();
  const auto most_m = static_cast<float>(far_m);
  for (float& m : bounded) m = std::isfinite(m) ? std::clamp(m, 0.0f, most_m) : most_m;
  return bounded;
}

class OnnxPolicy final : public Module {
 public:
  explicit OnnxPolicy(const OnnxPolicyConfig& config) : config_(config) {
    fields::require_bounds(config);
    for (size_t i = 0; i < config.images.size(); ++i) {
      fields::require(!config.images[i].far_m || config.images[i].channel == CameraNeed::Channel::depth,
                      "images." + std::to_string(i) + ".far", "only for the channel depth");
    }
    if (config.images.empty() && !config.state) throw std::invalid_argument("needs 'images' or 'state'");
    network_ = network_of(config);
  }

 private:
  Needs do_needs() const override {
    Needs needs{.cameras = {}, .commands = {CommandType::velocity}};
    for (const PolicyImage& image : config_.images) needs.cameras.push_back({image.camera, image.channel});
    return needs;
  }

  std::vector<Signal> do_signals() const override {
    return {{"action_forward", ""}, {"action_right", ""}, {"action_climb", ""}, {"action_turn", ""}};
  }

  void do_reset(const Setup& setup) override {
    speed_limit_mps_ = setup.limits.speed_mps;
    first_step_s_ = config_.images.empty() ? 0.04 : 0.0;
    pilot_.reset();
    last_t_ns_.reset();
    blobs_.clear();
    for (const PolicyImage& image : config_.images) {
      const MountedCamera& camera = required_camera(setup, image.camera);
      const int channels = image.channel == CameraNeed::Channel::color ? 3 : 1;
      const bool is_depth = image.channel == CameraNeed::Channel::depth;
      const double before_first = is_depth ? (image.far_m.value_or(kDefaultFarM) - image.mean) * image.scale : 0.0;
      blobs_.push_back(cv::Mat({1, channels, camera.model.height_px, camera.model.width_px}, CV_32F, before_first));
      first_step_s_ = std::max(first_step_s_, 1.0 / camera.rate_hz);
    }
    run(State::Zero());  // reports a misfit before the flight
  }

  Decision do_update(const Observation& observation) override {
    for (const CameraFrame& frame : observation.frames) take(frame);  // if an image is lost, the previous one is used
    const NavigationState& navigation = observation.navigation;
    if (!pilot_) pilot_.emplace(navigation);
    const double step_s = last_t_ns_ ? seconds(observation.t_ns - *last_t_ns_) : first_step_s_;
    last_t_ns_ = observation.t_ns;
    const Action action = run(state_of(navigation, observation.goal));
    return {pilot_->fly(action, navigation, speed_limit_mps_, step_s),
            "policy",
            {action[0], action[1], action[2], action[3]}};
  }

  void take(const CameraFrame& frame) {
    for (size_t i = 0; i < config_.images.size(); ++i) {
      const PolicyImage& image = config_.images[i];
      if (image.camera != frame.role) continue;
      const bool is_depth = image.channel == CameraNeed::Channel::depth;
      network_->to_input(is_depth ? bounded_depth(frame.image, image.far_m.value_or(kDefaultFarM)) : frame.image,
                         image.scale, image.mean, blobs_[i]);
    }
  }

  /// Throws std::invalid_argument if inputs or outputs differ from the config, or if an action is not finite.
  Action run(const State& state) {
    cv::Mat answer;
    try {
      for (size_t i = 0; i < blobs_.size(); ++i) network_->set_input(blobs_[i], config_.images[i].input());
      if (config_.state) {
        network_->set_input(
            cv::Mat(1, static_cast<int>(state.size()), CV_32F, const_cast<float*>(state.data())).clone(), "state");
      }
      answer = network_->output("action");
    } catch (const std::invalid_argument& fault) {
      refuse(config_, std::string("the network does not take these images and state: ") + fault.what());
    }
    if (answer.total() != 4 || answer.type() != CV_32F) {
      refuse(config_, "the output 'action' has " + std::to_string(answer.total()) + " numbers; must have 4");
    }
    Action action;
    for (int i = 0; i < 4; ++i) action[i] = static_cast<double>(answer.ptr<float>()[i]);
    if (!action.allFinite()) refuse(config_, "the network's action is not finite");
    return action;
  }

  OnnxPolicyConfig config_;
  std::unique_ptr<Network> network_;
  std::vector<cv::Mat> blobs_;  ///< of config_.images
  double speed_limit_mps_ = 0.0, first_step_s_ = 0.0;
  std::optional<ActionPilot> pilot_;
  std::optional<int64_t> last_t_ns_;
};

}  // namespace

std::unique_ptr<Module> make_onnx_policy(const OnnxPolicyConfig& config) {
  return std::make_unique<OnnxPolicy>(config);
}

}  // namespace hedgehop::avoidance::policy
