// A module built outside Hedgehop's tree. It flies ahead and moves toward the brighter half of the front camera's
// image. An example of the interface, not of obstacle avoidance; see docs/writing-a-module.md.
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "avoidance/plugin.h"

namespace {

using namespace hedgehop::avoidance;

struct KeepLeftConfig {
  static constexpr std::string_view kName = "keep_left";
  static constexpr std::string_view kMeaning =
      "flight ahead, with a lateral speed toward the brighter half of the image";

  double speed_mps = 1.0;
  double gain_mps = 2.0;
};
template <class Visitor>
void describe(Visitor& v, KeepLeftConfig& c) {
  v("speed", c.speed_mps, {.unit = "m/s", .above = 0.0, .meaning = "speed ahead"});
  v("gain", c.gain_mps,
    {.unit = "m/s",
     .at_least = 0.0,
     .meaning = "lateral speed per unit of brightness difference; 1 is white against black"});
}

class KeepLeft : public Module {
 public:
  explicit KeepLeft(const KeepLeftConfig& config) : config_(config) {}

 private:
  Needs do_needs() const override { return {{{.role = "front", .channel = CameraNeed::Channel::grey}}}; }
  std::vector<Signal> do_signals() const override { return {{"brightness_left", ""}}; }
  void do_reset(const Setup&) override { start_.reset(), images_ = 0; }

  Decision do_update(const Observation& seen) override {
    if (!start_) start_ = seen.goal.heading_rad;
    if (seen.frames.empty()) return {HoverCommand{}, "blind", {std::nan("")}};  // a camera may lose an image
    image_ = seen.frames[0].image.clone();
    const int half = image_.cols / 2;
    const double left = cv::mean(image_.colRange(0, half))[0] / 255.0;
    const double right = cv::mean(image_.colRange(half, image_.cols))[0] / 255.0;
    ++images_;
    const double ahead = config_.speed_mps, aside = config_.gain_mps * (right - left);  // to the right
    const double c = std::cos(*start_), s = std::sin(*start_);
    const VelocityCommand command{.v_WB_W = {ahead * c - aside * s, ahead * s + aside * c},
                                  .altitude_m = -seen.goal.p_WG.z(),
                                  .heading_rad = *start_};
    return {.command = command, .status = "cruise", .signals = {left}};
  }

  std::vector<Metric> do_metrics() const override { return {{"images", static_cast<double>(images_), ""}}; }
  cv::Mat do_annotate() const override {
    cv::Mat drawn;
    if (image_.empty()) return drawn;
    cv::cvtColor(image_, drawn, cv::COLOR_GRAY2RGB);
    cv::line(drawn, {drawn.cols / 2, 0}, {drawn.cols / 2, drawn.rows}, {255, 160, 0});
    return drawn;
  }

  KeepLeftConfig config_;
  std::optional<double> start_;
  cv::Mat image_;
  int images_ = 0;
};

std::unique_ptr<Module> make(const KeepLeftConfig& config) { return std::make_unique<KeepLeft>(config); }

}  // namespace

HEDGEHOP_PLUGIN(ModuleRow<KeepLeftConfig, make>)
