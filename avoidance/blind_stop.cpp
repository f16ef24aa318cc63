#include "avoidance/blind_stop.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace hedgehop::avoidance {
namespace {

template <class Holds>
bool each_row(const cv::Mat& image, Holds holds) {
  for (int row = 0; row < image.rows; ++row) {
    if (!holds(image.ptr<uint8_t>(row), static_cast<size_t>(image.cols) * image.elemSize(), row)) return false;
  }
  return true;
}

/// Returns whether all pixels equal the first one.
bool is_uniform(const cv::Mat& image) {
  const size_t pixel = image.elemSize();
  const uint8_t* const first = image.ptr<uint8_t>(0);
  return each_row(image, [&](const uint8_t* row, size_t size, int) {
    return std::memcmp(row, first, pixel) == 0 && std::memcmp(row, row + pixel, size - pixel) == 0;
  });
}

bool is_black(const cv::Mat& image) {
  const uint8_t* const first = image.ptr<uint8_t>(0);
  return std::all_of(first, first + image.elemSize(), [](uint8_t byte) { return byte == 0; }) && is_uniform(image);
}

bool is_equal(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         each_row(a, [&b](const uint8_t* row, size_t size, int k) { return std::memcmp(row, b.ptr(k), size) == 0; });
}

/// Time of the last good image of one camera.
class ImageMonitor {
 public:
  ImageMonitor(CameraNeed need, double rate_hz) : need_(std::move(need)), limit_ns_(blind_after_ns(rate_hz)) {}

  /// Returns whether the camera is blind. @param frames  of this decision.
  bool is_blind(std::span<const CameraFrame> frames, int64_t t_ns) {
    const CameraFrame* const frame = find_frame(frames, need_.role);
    if (good_ns_ == kNever || (frame && is_good(frame->image))) good_ns_ = t_ns;
    return t_ns - good_ns_ > limit_ns_;
  }

 private:
  static constexpr int64_t kNever = std::numeric_limits<int64_t>::min();

  bool is_good(const cv::Mat& image) {
    const bool is_image = need_.channel == CameraNeed::Channel::grey || need_.channel == CameraNeed::Channel::color;
    if (!is_image || image.empty()) return true;
    const bool frozen = is_equal(image, last_) && !is_uniform(image);
    if (!frozen) image.copyTo(last_);
    return !frozen && !is_black(image);
  }

  CameraNeed need_;
  int64_t limit_ns_, good_ns_ = kNever;
  cv::Mat last_;
};

class StoppingWhenBlind : public Module {
 public:
  explicit StoppingWhenBlind(std::unique_ptr<Module> module) : module_(std::move(module)) {}

 private:
  Needs do_needs() const override { return module_->needs(); }
  std::vector<Signal> do_signals() const override { return module_->signals(); }
  std::vector<Metric> do_metrics() const override { return module_->metrics(); }
  Map do_map() const override { return module_->map(); }
  cv::Mat do_annotate() const override { return module_->annotate(); }

  void do_reset(const Setup& setup) override {
    module_->reset(setup);
    monitors_.clear();
    for (const CameraNeed& need : module_->needs().cameras) {
      monitors_.emplace_back(need, required_camera(setup, need.role).rate_hz);
    }
    no_signals_.assign(module_->signals().size(), std::nan(""));
  }

  Decision do_update(const Observation& observation) override {
    bool blind = false;
    for (ImageMonitor& monitor : monitors_) blind = monitor.is_blind(observation.frames, observation.t_ns) || blind;
    if (blind) return {HoverCommand{}, "blind", no_signals_};
    return module_->update(observation);
  }

  std::unique_ptr<Module> module_;
  std::vector<ImageMonitor> monitors_;
  std::vector<double> no_signals_;
};

}  // namespace

int64_t blind_after_ns(double rate_hz) {
  constexpr double kMaxIntervalS = 0.5;  // half of the time in which a vehicle at 3 m/s stops with 2 m/s^2
  constexpr double kImages = 3.0;
  return std::llround(std::max(kMaxIntervalS, kImages / rate_hz) * 1e9);
}

std::unique_ptr<Module> stopping_when_blind(std::unique_ptr<Module> module) {
  if (module->needs().cameras.empty()) return module;
  return std::make_unique<StoppingWhenBlind>(std::move(module));
}

}  // namespace hedgehop::avoidance
