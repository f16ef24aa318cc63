#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "avoidance/module.h"
#include "sim/fields/field.h"

namespace hedgehop::avoidance::policy {

inline constexpr double kDefaultFarM = 100.0;  ///< of hedgehop.Env

/// An image input of a network, named `<camera>_<channel>`: float32, 1 x channels x rows x columns.
struct PolicyImage {
  std::string camera;
  CameraNeed::Channel channel = CameraNeed::Channel::grey;  ///< not `corners`
  double mean = 0.0;
  double scale = 1.0 / 255.0;
  std::optional<double> far_m = {};  ///< `depth` only; default: kDefaultFarM

  std::string input() const;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PolicyImage> auto& c) {
  v("camera", c.camera, {.required = true, .meaning = "role of the camera"});
  v("channel", c.channel,
    {.choices = {"grey", "color", "depth"},
     .meaning = "channel of the camera; the network's input is <camera>_<channel>"});
  v("mean", c.mean, {.at_least = -1e3, .at_most = 1e3, .meaning = "subtracted from each value (0 to 255, or m)"});
  v("scale", c.scale, {.above = 0.0, .at_most = 1e3, .meaning = "factor on the difference"});
  v("far", c.far_m,
    {.unit = "m",
     .above = 0.0,
     .meaning = "maximum depth, also the depth of missing and unknown surfaces; default: 100 m; only for the channel "
                "depth"});
}

/// Flies the output of a network. The inputs are images and, if `state` is true, `state` (1 x 10, action_pilot.h). The
/// output `action` is 1 x 4.
struct OnnxPolicyConfig {
  static constexpr std::string_view kName = "onnx_policy";
  static constexpr std::string_view kMeaning = "flies the actions of a neural network, read from an ONNX file";

  std::filesystem::path file;
  std::vector<PolicyImage> images;
  bool state = true;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<OnnxPolicyConfig> auto& c) {
  v("file", c.file, {.required = true, .meaning = "ONNX file of the network"});
  v("images", c.images, {.meaning = "image inputs"});
  v("state", c.state,
    {.meaning = "whether the network has the input 'state': goal, velocity, attitude, yaw rate and height"});
}

/// Throws std::invalid_argument on a bad config, if the file is not a network, and in builds without OpenCV dnn.
std::unique_ptr<Module> make_onnx_policy(const OnnxPolicyConfig& config);

}  // namespace hedgehop::avoidance::policy
