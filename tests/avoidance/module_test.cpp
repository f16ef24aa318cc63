#include "avoidance/module.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class Scripted final : public Module {
 public:
  Decision next{VelocityCommand{}, "cruise", {0.0}};
  bool pinhole = false;
  std::vector<CommandType> commands;

 private:
  Needs do_needs() const override { return {{{"front", CameraNeed::Channel::grey, pinhole}}, commands}; }
  std::vector<Signal> do_signals() const override { return {{"one", ""}}; }
  void do_reset(const Setup&) override {}
  Decision do_update(const Observation&) override { return next; }
};

struct Checked : testing::Test {
  Scripted module;
  avoidance::Setup setup = four_cameras(32, 50.0, 3.0);
  Observation observation;
  int64_t t_ns = 0;

  Decision update() {
    observation.t_ns = t_ns += 20'000'000;
    return module.update(observation);
  }
};

TEST_F(Checked, UpdateRequiresReset) {
  EXPECT_THROW(update(), std::logic_error);
  module.reset(setup);
  EXPECT_NO_THROW(update());
}

TEST_F(Checked, FailedResetLeavesTheModuleUnready) {
  module.reset(setup);
  avoidance::Setup blind = setup;
  blind.cameras.erase(blind.cameras.begin());
  EXPECT_THROW(module.reset(blind), std::invalid_argument);
  EXPECT_THROW(update(), std::logic_error);
}

TEST_F(Checked, ResetRejectsAFisheyeIfAPinholeIsRequired) {
  setup.cameras[0].model = {32, 32, vision::camera::FisheyeLens{10.0, 10.0, 15.5, 15.5}};
  EXPECT_NO_THROW(module.reset(setup));
  module.pinhole = true;
  EXPECT_THROW(module.reset(setup), std::invalid_argument);
}

TEST_F(Checked, ResetRejectsMissingCamerasAndRatesAndLimitsThatAreNotPositive) {
  avoidance::Setup bad = setup;
  bad.cameras[0].role = "nose";
  EXPECT_THROW(module.reset(bad), std::invalid_argument);
  bad = setup;
  bad.cameras[0].rate_hz = 0.0;
  EXPECT_THROW(module.reset(bad), std::invalid_argument);
  bad.cameras[0].rate_hz = kNan;
  EXPECT_THROW(module.reset(bad), std::invalid_argument);
  bad = setup;
  bad.limits.speed_mps = 0.0;
  EXPECT_THROW(module.reset(bad), std::invalid_argument);
}

/// Requires a corner detector.
class CornerReader final : public Module {
  Needs do_needs() const override { return {{{"front", CameraNeed::Channel::corners}}}; }
  void do_reset(const Setup&) override {}
  Decision do_update(const Observation&) override { return {HoverCommand{}, "hover", {}}; }
};

TEST(CornerFrames, HaveAnySizeWithOneCornerPerRow) {
  CornerReader reader;
  reader.reset(four_cameras(32, 50.0, 3.0));
  int64_t t_ns = 0;
  const auto see = [&](const cv::Mat& image) {
    t_ns += 20'000'000;
    const std::vector<CameraFrame> frames = {{"front", t_ns, image}};
    return reader.update({.t_ns = t_ns, .frames = frames});
  };
  EXPECT_NO_THROW(see(cv::Mat(0, 1, CV_64FC2)));
  EXPECT_NO_THROW(see(cv::Mat(100, 1, CV_64FC2, cv::Scalar(1.0, 2.0))));
  EXPECT_THROW(see(cv::Mat(1, 100, CV_64FC2, cv::Scalar(1.0, 2.0))), std::logic_error);
  EXPECT_THROW(see(cv::Mat(32, 32, CV_8UC1, cv::Scalar(0))), std::logic_error);
  EXPECT_THROW(see(cv::Mat()), std::logic_error);
}

TEST_F(Checked, TimeMustIncreaseUntilReset) {
  module.reset(setup);
  update();
  observation.t_ns = t_ns;
  EXPECT_THROW(module.update(observation), std::logic_error);
  observation.t_ns = t_ns - 1;
  EXPECT_THROW(module.update(observation), std::logic_error);
  module.reset(setup);
  observation.t_ns = 0;
  EXPECT_NO_THROW(module.update(observation));
}

TEST_F(Checked, FramesMustMatchTheirCamera) {
  module.reset(setup);
  std::vector<CameraFrame> frames(1);
  const auto with = [&](const char* role, const cv::Mat& image, int64_t lead_ns) {
    frames[0] = {role, t_ns + 20'000'000 + lead_ns, image};
    observation.frames = frames;
    return update();
  };
  const cv::Mat grey(32, 32, CV_8UC1, cv::Scalar(0)), color(32, 32, CV_8UC3, cv::Scalar::all(0));
  EXPECT_NO_THROW(with("front", grey, -1'000'000));
  EXPECT_THROW(with("front", grey, 1), std::logic_error);
  EXPECT_THROW(with("front", cv::Mat(32, 31, CV_8UC1, cv::Scalar(0)), 0), std::logic_error);
  EXPECT_THROW(with("front", cv::Mat(), 0), std::logic_error);
  EXPECT_THROW(with("front", color, 0), std::logic_error);
  EXPECT_NO_THROW(with("left", color, 0));  // part of the rig, not required by the module
  EXPECT_THROW(with("nose", grey, 0), std::logic_error);
}

TEST_F(Checked, CommandsMustBeFinite) {
  module.reset(setup);
  for (const Command& bad : {Command(VelocityCommand{{kNan, 0}, 0, 0}), Command(VelocityCommand{{0, 0}, kNan, 0}),
                             Command(PositionCommand{{0, 0, kNan}, 0}), Command(AttitudeCommand{0, INFINITY, 0, 0}),
                             Command(HoverCommand{-INFINITY})}) {
    module.next.command = bad;
    EXPECT_THROW(update(), std::logic_error);
  }
}

TEST_F(Checked, ACommandThatIsNotFiniteIsNamedWithItsValues) {
  module.reset(setup);
  module.next.command = VelocityCommand{{kNan, 0}, 5, 0.5};
  try {
    update();
    FAIL() << "accepted";
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(),
                 "the module's VelocityCommand is not finite: velocity (nan, 0) m/s, altitude 5 m, heading 0.5 rad");
  }
}

TEST_F(Checked, CommandsMustBeOfADeclaredType) {
  module.commands = {CommandType::velocity, CommandType::position};
  module.reset(setup);
  for (const Command& good : {Command(VelocityCommand{}), Command(PositionCommand{}), Command(HoverCommand{})}) {
    module.next.command = good;
    EXPECT_NO_THROW(update());
  }
  module.next.command = AttitudeCommand{};
  EXPECT_THROW(update(), std::logic_error);
  module.commands.clear();  // not declared
  module.reset(setup);
  EXPECT_NO_THROW(update());
}

TEST_F(Checked, NumberOfSignalsMustMatchTheDeclaration) {
  module.reset(setup);
  module.next.signals = {1.0, 2.0};
  EXPECT_THROW(update(), std::logic_error);
  module.next.signals = {kNan};
  EXPECT_NO_THROW(update());
}

TEST_F(Checked, SpeedAboveTheLimitIsScaledDownAndKeepsItsDirection) {
  module.reset(setup);
  module.next.command = VelocityCommand{{6.0, -8.0}, 5.0, 1.0};
  const auto command = std::get<VelocityCommand>(update().command);
  EXPECT_NEAR(command.v_WB_W.norm(), 3.0, 1e-12);
  EXPECT_NEAR(command.v_WB_W.x() / command.v_WB_W.y(), -0.75, 1e-12);
  module.next.command = VelocityCommand{{0.5, 0.1}, 5.0, 1.0};
  EXPECT_EQ(std::get<VelocityCommand>(update().command).v_WB_W, Eigen::Vector2d(0.5, 0.1));
}

}  // namespace
}  // namespace hedgehop::avoidance
