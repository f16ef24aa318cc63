#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

namespace hedgehop::avoidance::policy {

/// A neural network in OpenCV's dnn. The implementation is in libhedgehop_network.so, which is loaded for the first
/// network, because dnn takes as long to load as the rest of the program.
/// All functions throw std::invalid_argument with OpenCV's message on one line.
class Network {
 public:
  virtual ~Network() = default;
  /// Converts an image to an input of 1 x channels x rows x columns: (value - mean) * scale.
  virtual void to_input(const cv::Mat& image, double scale, double mean, cv::Mat& input) = 0;
  virtual void set_input(const cv::Mat& input, const std::string& name) = 0;
  virtual cv::Mat output(const std::string& name) = 0;
};

/// Returns the network of an ONNX file. Throws std::invalid_argument also if this build, or this installation, has no
/// libhedgehop_network.so.
std::unique_ptr<Network> read_network(const std::filesystem::path& onnx);

/// The function of the library. @param[out] made  the network.
using MakeNetwork = void(const std::filesystem::path& onnx, std::unique_ptr<Network>& made);
constexpr const char* kNetworkLibrary = "libhedgehop_network.so";
constexpr const char* kMakeNetwork = "hedgehop_make_network";

}  // namespace hedgehop::avoidance::policy
