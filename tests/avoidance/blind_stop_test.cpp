#include "avoidance/blind_stop.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance {
namespace {

/// Counts the calls of update().
class CallCounter : public Module {
 public:
  explicit CallCounter(int& count) : count_(count) {}

 private:
  Needs do_needs() const override { return {{{"front"}, {"left"}}}; }
  std::vector<Signal> do_signals() const override { return {{"calls", ""}}; }
  void do_reset(const Setup&) override {}
  Decision do_update(const Observation&) override {
    return {VelocityCommand{{1.0, 0.0}, 5.0, 0.0}, "cruise", {1.0 * ++count_}};
  }
  int& count_;
};

constexpr int kSizePx = 32;
constexpr double kRateHz = 25.0;
constexpr int64_t kPeriodNs = 40'000'000;

/// Returns the statuses of two seconds. `fault` changes the images of the front camera from the tenth on.
std::vector<std::string> fly(const std::function<void(CameraFrame&, int)>& fault) {
  int calls = 0;
  const auto module = stopping_when_blind(std::make_unique<CallCounter>(calls));
  module->reset(four_cameras(kSizePx, kRateHz));
  std::vector<std::string> statuses;
  for (int i = 0; i < 50; ++i) {
    std::vector<CameraFrame> frames;
    for (const char* role : {"front", "left"}) {
      CameraFrame frame{role, i * kPeriodNs, cv::Mat(kSizePx, kSizePx, CV_8UC1)};
      cv::randu(frame.image, 1, 255);
      if (i >= 10 && frame.role == "front") fault(frame, i);
      if (!frame.image.empty()) frames.push_back(frame);
    }
    const Decision decision = module->update({i * kPeriodNs, frames, {}, {}});
    statuses.push_back(decision.status);
    EXPECT_EQ(std::holds_alternative<HoverCommand>(decision.command), decision.status == "blind");
    EXPECT_EQ(std::isnan(decision.signals.at(0)), decision.status == "blind");
  }
  EXPECT_EQ(calls, std::ranges::count(statuses, "cruise"));
  return statuses;
}

/// Half a second after the last good image, the ninth.
void expect_blind_from_then_on(const std::vector<std::string>& statuses, int good_again = 50) {
  for (int i = 0; i < 50; ++i) {
    const bool blind = (i - 9) * kPeriodNs > 500'000'000 && i < good_again;
    EXPECT_EQ(statuses[static_cast<size_t>(i)], blind ? "blind" : "cruise") << i;
  }
}

TEST(BlindStop, StopsIfOneRequiredCameraIsMissingBlackOrFrozen) {
  expect_blind_from_then_on(fly([](CameraFrame& frame, int) { frame.image.release(); }));
  expect_blind_from_then_on(fly([](CameraFrame& frame, int) { frame.image.setTo(0); }));
  cv::Mat last(kSizePx, kSizePx, CV_8UC1);
  cv::randu(last, 1, 255);
  // The first frozen image is new.
  const std::vector<std::string> frozen = fly([&](CameraFrame& frame, int i) {
    if (i > 9) last.copyTo(frame.image);
  });
  EXPECT_EQ(frozen[22], "cruise");
  EXPECT_EQ(frozen[23], "blind");
  EXPECT_EQ(frozen[49], "blind");
}

TEST(BlindStop, ContinuesWithTheFirstGoodImage) {
  expect_blind_from_then_on(fly([](CameraFrame& frame, int i) {
                              if (i < 40) frame.image.setTo(0);
                            }),
                            40);
}

TEST(BlindStop, BlankWallIsNeitherBlackNorFrozen) {
  for (const std::string& status : fly([](CameraFrame&frame, int) { frame.image.setTo(80); }))
    EXPECT_EQ(status, "cruise");
}

TEST(BlindStop, AllowsThreePeriodsOfASlowCamera) {
  EXPECT_EQ(blind_after_ns(25.0), 500'000'000);
  EXPECT_EQ(blind_after_ns(2.0), 1'500'000'000);
}

}  // namespace
}  // namespace hedgehop::avoidance
