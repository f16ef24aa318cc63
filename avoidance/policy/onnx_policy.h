#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "avoidance/module.h"

namespace hedgehop::avoidance::policy {

/// An image that a network wants, as its input `<camera>_<channel>`: float32, 1 x channels x rows x columns.
struct PolicyImage {
  std::string camera;
  CameraNeed::Channel channel = CameraNeed::Channel::grey;  ///< not `corners`
  double mean = 0.0;
  double scale = 1.0 / 255.0;

  std::string input() const;
};

template <class Visitor>
void describe(Visitor& v, PolicyImage& c) {
  v("camera", c.camera, {.required = true, .meaning = "role of the camera"});
  v("channel", c.channel,
    {.choices = {"grey", "color", "depth"}, .meaning = "what it delivers; the network's input is <camera>_<channel>"});
  v("mean", c.mean,
    {.at_least = -1e3,
     .at_most = 1e3,
     .meaning = "taken from each value (0 to 255, or m); a depth that is not known counts as this one"});
  v("scale", c.scale, {.above = 0.0, .at_most = 1e3, .meaning = "by which the difference is multiplied then"});
}

/// Flies what a network says. Its inputs are images and, with `state`, `state` (1 x 10, action_pilot.h); its output
/// `action` is 1 x 4.
struct OnnxPolicyConfig {
  static constexpr std::string_view kName = "onnx_policy";
  static constexpr std::string_view kMeaning = "flies the actions of a neural network, read from an ONNX file";

  std::filesystem::path file;
  std::vector<PolicyImage> images;
  bool state = true;
};

template <class Visitor>
void describe(Visitor& v, OnnxPolicyConfig& c) {
  v("file", c.file, {.required = true, .meaning = "the network, ONNX"});
  v("images", c.images, {.meaning = "its inputs from cameras"});
  v("state", c.state, {.meaning = "whether it has the input 'state': goal, velocity, attitude, yaw rate and height"});
}

/// Throws std::invalid_argument on a bad config, a file that is no network, and in builds without OpenCV's dnn.
std::unique_ptr<Module> make_onnx_policy(const OnnxPolicyConfig& config);

}  // namespace hedgehop::avoidance::policy
