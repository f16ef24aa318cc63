#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <stdexcept>

#include "avoidance/policy/network.h"

namespace hedgehop::avoidance::policy {
namespace {

/// Suppresses the printing of exceptions by OpenCV.
class Quiet {
 public:
  Quiet() : before_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~Quiet() { cv::utils::logging::setLogLevel(before_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  cv::utils::logging::LogLevel before_;
};

/// Returns the result of an action. Throws std::invalid_argument with `fault_head` and OpenCV's message on one line,
/// without the locations in its sources.
template <class Action>
auto quietly(Action action, const char* fault_head = "") {
  const Quiet quiet;
  try {
    return action();
  } catch (const cv::Exception& fault) {
    std::string text = fault.err.substr(0, fault.err.find('\n'));
    text = text.substr(0, text.find(" parse error"));
    throw std::invalid_argument(fault_head + (text.starts_with("> ") ? text.substr(2) : text));
  }
}

class OpenCvNetwork final : public Network {
 public:
  explicit OpenCvNetwork(const std::filesystem::path& onnx)
      : network_(quietly([&] { return cv::dnn::readNetFromONNX(onnx.string()); },
                         "OpenCV reads no network of ONNX from it: ")) {
    network_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    network_.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  }

  void to_input(const cv::Mat& image, double scale, double mean, cv::Mat& input) override {
    cv::dnn::blobFromImage(image, input, scale, {}, cv::Scalar::all(mean));
  }
  void set_input(const cv::Mat& input, const std::string& name) override {
    quietly([&] { network_.setInput(input, name); });
  }
  cv::Mat output(const std::string& name) override {
    return quietly([&] { return network_.forward(name); });
  }

 private:
  cv::dnn::Net network_;
};

}  // namespace
}  // namespace hedgehop::avoidance::policy

extern "C" void hedgehop_make_network(const std::filesystem::path& onnx,
                                      std::unique_ptr<hedgehop::avoidance::policy::Network>& made);
void hedgehop_make_network(const std::filesystem::path& onnx,
                           std::unique_ptr<hedgehop::avoidance::policy::Network>& made) {
  made = std::make_unique<hedgehop::avoidance::policy::OpenCvNetwork>(onnx);
}
