#include "avoidance/policy/onnx_policy.h"

#include <gmock/gmock.h>

#include <limits>
#include <random>
#include <stdexcept>

#include "avoidance/policy/action_pilot.h"
#include "tests/avoidance/flow_balance/flow_rig.h"
#include "tests/avoidance/policy/onnx_file.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::avoidance::policy {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr int kSizePx = 16;

class OnnxPolicy : public testing::Test {
 protected:
  OnnxPolicy() {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<float> even(-0.05f, 0.05f);
    for (int i = 0; i < 44; ++i) weights.push_back(even(random));
    offset = {0.1f, -0.2f, 0.3f, -0.4f};
    write();
  }
  void SetUp() override {
    try {
      make_onnx_policy(config());
    } catch (const std::invalid_argument& fault) {
      if (std::string(fault.what()).find("libopencv-dnn-dev") != std::string::npos) GTEST_SKIP() << fault.what();
      throw;
    }
  }
  void write(uint64_t size_px = kSizePx, const std::string& output = "action") {
    onnx_file::write_linear_policy(file(), size_px, size_px, weights, offset, output);
  }
  std::filesystem::path file() const { return folder.path() / "linear.onnx"; }
  OnnxPolicyConfig config() const {
    return {.file = file(), .images = {{.camera = "front", .mean = 100.0, .scale = 0.01}}};
  }
  /// The output of the network, computed by hand.
  Action expected(const cv::Mat& image, const State& state) const {
    Action action;
    for (int row = 0; row < 4; ++row) {
      const float* const w = weights.data() + 11 * row;
      double sum = offset[static_cast<size_t>(row)] + w[0] * (cv::mean(image)[0] - 100.0) * 0.01;
      for (int i = 0; i < 10; ++i) sum += static_cast<double>(w[i + 1]) * static_cast<double>(state[i]);
      action[row] = sum;
    }
    return action;
  }

  const sim::TemporaryFolder folder;
  std::vector<float> weights, offset;
};

cv::Mat random_image(int seed) {
  cv::Mat image(kSizePx, kSizePx, CV_8UC1);
  cv::RNG random(static_cast<uint64_t>(seed));
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

TEST_F(OnnxPolicy, FliesTheNetworksActionsAndKeepsTheLastImage) {
  const auto module = make_onnx_policy(config());
  const avoidance::Setup setup = four_cameras(kSizePx, 25.0, 3.0);
  module->reset(setup);
  const Goal goal{{8.0, -3.0, -7.0}, 0.0};
  NavigationState navigation = level_flight({0, 0, -6}, 0.4, {0.5, 0.2});
  ActionPilot pilot(navigation);
  cv::Mat image = cv::Mat::zeros(kSizePx, kSizePx, CV_8UC1);
  for (int i = 0; i < 6; ++i) {
    navigation.p_WB_est.x() = 0.1 * i;
    std::vector<CameraFrame> frames;
    if (i != 3) {
      image = random_image(i + 1);
      frames.push_back({"front", 40'000'000 * int64_t{i}, image});
    }
    const Decision decision = module->update({40'000'000 * int64_t{i}, frames, navigation, goal});
    const Action action = expected(image, state_of(navigation, goal));
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(decision.signals[static_cast<size_t>(k)], action[k], 1e-5) << i;
    const VelocityCommand command = pilot.fly(action, navigation, 3.0, 0.04);
    const auto& flown = std::get<VelocityCommand>(decision.command);
    EXPECT_LT((flown.v_WB_W - command.v_WB_W).norm(), 1e-4);
    EXPECT_NEAR(flown.altitude_m, command.altitude_m, 1e-4);
    EXPECT_NEAR(flown.heading_rad, command.heading_rad, 1e-4);
  }
}

TEST_F(OnnxPolicy, DepthIsThatOfTheEnvironmentInWhichPoliciesAreTrained) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN(), kSky = std::numeric_limits<float>::infinity();
  onnx_file::write_linear_policy(file(), 2, 2, weights, offset, "action", "front_depth");
  OnnxPolicyConfig config{.file = file(),
                          .images = {{.camera = "front", .channel = CameraNeed::Channel::depth, .mean = 10.0}}};
  const NavigationState navigation = level_flight({0, 0, -6}, 0.4, {0.5, 0.2});
  const Goal goal{{8.0, -3.0, -7.0}, 0.0};
  for (const double far_m : {100.0, 20.0}) {
    if (far_m != 100.0) config.images[0].far_m = far_m;  // 100 m is the default
    const auto module = make_onnx_policy(config);
    module->reset(four_cameras(2, 25.0));
    // Sum of the four pixels: far, NaN and infinite ones have the depth `far`. Before the first image, all of them do.
    const auto first_action = [&](double sum_m) {
      double sum = offset[0] + weights[0] * (sum_m / 4.0 - 10.0) / 255.0;
      for (int i = 0; i < 10; ++i) sum += static_cast<double>(weights[i + 1] * state_of(navigation, goal)[i]);
      return sum;
    };
    EXPECT_NEAR(module->update({0, {}, navigation, goal}).signals[0], first_action(4.0 * far_m), 1e-5);
    const cv::Mat depth = (cv::Mat_<float>(2, 2) << kUnknown, kSky, 3.0f, 5000.0f);
    const std::vector<CameraFrame> frames{{"front", 40'000'000, depth}};
    const Decision decision = module->update({40'000'000, frames, navigation, goal});
    EXPECT_NEAR(decision.signals[0], first_action(3.0 * far_m + 3.0), 1e-5) << far_m;
  }
}

TEST_F(OnnxPolicy, RejectsFilesThatAreNoNetworkInOneLine) {
  OnnxPolicyConfig missing = config();
  missing.file = folder.path() / "none.onnx";
  EXPECT_THAT([&] { make_onnx_policy(missing); }, ThrowsMessage<std::invalid_argument>(HasSubstr("no such file")));
  std::ofstream(file()) << "no network\n";
  EXPECT_THAT([&] { make_onnx_policy(config()); },
              ThrowsMessage<std::invalid_argument>(
                  ::testing::AllOf(HasSubstr("no network of ONNX"), ::testing::Not(HasSubstr("\n")))));
  OnnxPolicyConfig blind = config();
  blind.images.clear();
  blind.state = false;
  EXPECT_THAT([&] { make_onnx_policy(blind); }, ThrowsMessage<std::invalid_argument>(HasSubstr("'images' or 'state'")));
}

TEST_F(OnnxPolicy, AMaximumDepthIsForDepthOnly) {
  OnnxPolicyConfig grey = config();
  grey.images.push_back({.camera = "left", .channel = CameraNeed::Channel::color, .far_m = 100.0});
  EXPECT_THAT([&] { make_onnx_policy(grey); },
              ThrowsMessage<std::invalid_argument>("images.1.far: only for the channel depth"));
}

TEST_F(OnnxPolicy, RejectsNetworksWithOtherInputsAndOutputsBeforeTheFlight) {
  const avoidance::Setup setup = four_cameras(kSizePx, 25.0);
  const auto refused = [&](const OnnxPolicyConfig& bad, const std::string& why) {
    const auto module = make_onnx_policy(bad);
    EXPECT_THAT([&] { module->reset(setup); }, ThrowsMessage<std::invalid_argument>(HasSubstr(why))) << why;
  };
  OnnxPolicyConfig left = config();
  left.images[0].camera = "left";
  refused(left, "does not take");
  OnnxPolicyConfig stateless = config();
  stateless.state = false;
  refused(stateless, "does not take");
  write(kSizePx, "steering");
  refused(config(), "does not take");
  offset.pop_back();
  weights.resize(33);
  write();
  refused(config(), "has 3 numbers; must have 4");
}

TEST_F(OnnxPolicy, ActionThatIsNotFiniteEndsTheFlight) {
  offset[2] = std::numeric_limits<float>::quiet_NaN();
  write();
  const auto module = make_onnx_policy(config());
  EXPECT_THAT([&] { module->reset(four_cameras(kSizePx, 25.0)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("not finite")));

  // Finite before the flight, with inputs of 0; a white image overflows a float.
  offset[2] = 0.3f;
  weights.assign(weights.size(), 3e38f);
  write();
  const auto overflowing = make_onnx_policy(config());
  overflowing->reset(four_cameras(kSizePx, 25.0));
  const std::vector<CameraFrame> white{{"front", 0, cv::Mat(kSizePx, kSizePx, CV_8UC1, cv::Scalar(255))}};
  EXPECT_THAT(
      [&] {
        overflowing->update({0, white, level_flight({0, 0, -6}, 0.0, {0, 0}), {{8.0, 0.0, -6.0}, 0.0}});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("not finite")));
}

}  // namespace
}  // namespace hedgehop::avoidance::policy
