#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "avoidance/contract.h"
#include "avoidance/registry.h"
#include "tests/avoidance/flow_balance/flow_rig.h"
#include "tests/avoidance/policy/onnx_file.h"
#include "tests/sim/record/temporary_folder.h"

/// The contract of every module of the registry.
namespace hedgehop::avoidance {
namespace {

constexpr int kContractImagePx = 160;

struct Row {
  std::string name;
  ModuleConfig config;
  bool stereo = false;           ///< has a pair of forward cameras
  bool holds_heading = true;     ///< and altitude; otherwise it flies in the direction of view
  bool fisheye = false;          ///< has one downward camera
  bool learned = false;          ///< flies the output of a network
  std::string blank = "cruise";  ///< status with blank images; empty: several
  friend std::ostream& operator<<(std::ostream& out, const Row& row) { return out << row.name; }
};

template <size_t... Index>
std::vector<Row> default_rows(std::index_sequence<Index...>) {
  std::vector<Row> rows;
  (rows.push_back({std::string(std::variant_alternative_t<Index, ModuleConfig>::kName),
                   std::variant_alternative_t<Index, ModuleConfig>{}}),
   ...);
  return rows;
}

/// A network that uses only the brightness of one image.
policy::OnnxPolicyConfig small_policy() {
  static const sim::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "small.onnx";
  onnx_file::write_linear_policy(file, kContractImagePx, kContractImagePx, std::vector<float>(44, 0.01f),
                                 {0.5f, 0.1f, -0.1f, 0.2f});
  return {.file = file, .images = {{.camera = "front"}}};
}

bool reads_networks(const ModuleConfig& config) {
  try {
    return make_module(config) != nullptr;
  } catch (const std::invalid_argument& fault) {
    if (std::string_view(fault.what()).find("libopencv-dnn-dev") == std::string_view::npos) throw;
    return false;
  }
}

// Every row of the registry with its defaults, and the main variants of a row.
std::vector<Row> rows() {
  auto all = default_rows(std::make_index_sequence<std::variant_size_v<ModuleConfig>>{});
  for (Row& row : all) {
    row.stereo = row.name == "section_grid" || row.name == "stereo_corridor" || row.name == "local_map";
    row.fisheye = row.name == "corridor_centering";
    row.learned = row.name == policy::OnnxPolicyConfig::kName;
    row.holds_heading = !row.stereo && !row.fisheye && !row.learned && row.name != "landmark_map";
    if (row.learned) {
      row.config = small_policy();
      row.blank = "policy";
    }
    // Between invisible walls the path is not free.
    if (row.fisheye) row.blank = "blind";
    // It observes, and may move in the space that it assumes to be free
    // (LocalMapFlight.BlindVehicleStaysInTheSpaceAssumedFree).
    if (row.name == "local_map") row.blank.clear();
  }
  std::erase_if(all, [](const Row& row) { return row.learned && !reads_networks(row.config); });
  flow_balance::FlowBalanceConfig balance;
  balance.law = Law::published;
  balance.spiral_angle_rad = 0.1;
  all.push_back({"flow_balance_printed", balance});
  flow_balance::FlowBalanceConfig filtered;
  filtered.flow.margin_px = 0;
  filtered.command_time_constant_s = 0.3;
  filtered.spiral_angle_rad = 0.1;
  all.push_back({"flow_balance_filtered", filtered});
  flow_balance::ZigZagConfig zig_zag;
  zig_zag.law = Law::published;
  all.push_back({"zig_zag_printed", zig_zag});
  landmark_map::LandmarkMapModuleConfig thesis;
  thesis.law = Law::published;
  all.push_back({.name = "landmark_map_printed", .config = thesis, .holds_heading = false});
  return all;
}

class Contract : public testing::TestWithParam<Row> {
 protected:
  static constexpr int kSteps = 4;

  // A flight past two walls; drawn once, because drawing takes most of the time of a test.
  static const std::vector<contract::Step>& flight() {
    static const std::vector<contract::Step> all_round = make_flight(four_cameras(kContractImagePx, 25.0));
    static const std::vector<contract::Step> ahead = make_flight(stereo_pair(kContractImagePx, 25.0));
    static const std::vector<contract::Step> below = make_flight(fisheye_below(2 * kContractImagePx, 25.0));
    if (GetParam().fisheye) return below;
    return GetParam().stereo ? ahead : all_round;
  }
  static std::vector<contract::Step> make_flight(const avoidance::Setup& rig) {
    const vision::WaveTexture texture(5, 0.3, 4.0, 12);
    const std::vector<vision::TexturedPlane> walls = {wall(9, 0, M_PI), wall(0, 5, -0.5 * M_PI)};
    std::vector<contract::Step> made;
    for (int i = 0; i < kSteps; ++i) {
      contract::Step step;
      step.navigation = level_flight({0.04 * i, 0.02 * i, -6.0}, 0.3, {1.0, 0.5});
      step.navigation.w_WB_B_est = {0.01, -0.02, 0.05};
      step.frames = see(rig, step.navigation, int64_t{40'000'000} * i, walls, texture);
      made.push_back(std::move(step));
    }
    return made;
  }
  static avoidance::Setup setup() {
    constexpr double kSpeedLimitMps = 10.0;
    if (GetParam().fisheye) return fisheye_below(2 * kContractImagePx, 25.0, kSpeedLimitMps);
    return GetParam().stereo ? stereo_pair(kContractImagePx, 25.0, kSpeedLimitMps)
                             : four_cameras(kContractImagePx, 25.0, kSpeedLimitMps);
  }
  static contract::Subject subject() {
    return {.make = [config = GetParam().config] { return make_module(config); },
            .setup = setup(),
            .steps = flight(),
            .goal = {{40, 10, -8}, 0.3}};
  }
};

TEST_P(Contract, SameInputGivesTheSameBits) { contract::expect_same_input_gives_the_same_bits(subject()); }
TEST_P(Contract, ResetEqualsANewModule) { contract::expect_reset_equals_a_new_module(subject()); }
TEST_P(Contract, DrawingDoesNotAffectDecisionsAndReturnsRgb) {
  contract::expect_drawing_changes_nothing_and_gives_rgb(subject());
}
TEST_P(Contract, SpeedLimitsHold) { contract::expect_speed_limits_hold(subject()); }
TEST_P(Contract, MissingFramesAreSurvived) { contract::expect_missing_frames_are_survived(subject()); }
TEST_P(Contract, NavigationThatIsNotFiniteIsRejected) {
  contract::expect_navigation_that_is_not_finite_is_rejected(subject());
}
TEST_P(Contract, SignalAndMetricNamesAreUniqueAndConstant) {
  contract::expect_signals_and_metrics_are_named_once_and_steady(subject());
}
TEST_P(Contract, EveryRequiredCameraMustBePresent) { contract::expect_all_needed_cameras_must_be_there(subject()); }

TEST_P(Contract, HoldsTheHeadingAndAltitudeOfTheGoalOrFliesInTheDirectionOfView) {
  if (GetParam().learned) GTEST_SKIP() << "a network may look and fly anywhere";
  if (GetParam().stereo) GTEST_SKIP() << "commands no velocities in this flight, or looks at unknown space";
  const contract::Subject under_test = subject();
  int velocities = 0;
  for (const Decision& decision : under_test.fly(*under_test.make())) {
    if (const auto* velocity = std::get_if<VelocityCommand>(&decision.command)) {
      ++velocities;
      if (GetParam().fisheye) {
        const double way_rad = std::atan2(velocity->v_WB_W.y(), velocity->v_WB_W.x());
        EXPECT_LT(std::abs(std::remainder(velocity->heading_rad - way_rad, 2.0 * M_PI)), 0.5 * M_PI);
        continue;
      }
      if (!GetParam().holds_heading) {
        EXPECT_NEAR(velocity->heading_rad, std::atan2(velocity->v_WB_W.y(), velocity->v_WB_W.x()), 1e-12);
        continue;
      }
      EXPECT_EQ(velocity->heading_rad, 0.3);
      EXPECT_EQ(velocity->altitude_m, 8.0);
    }
  }
  EXPECT_GE(velocities, kSteps - 1);  // the first image alone has no flow
}

TEST_P(Contract, ContinuesWithBlankImagesAndTreatsThePathAsFree) {
  const contract::Subject under_test = subject();
  const auto module = under_test.make();
  module->reset(under_test.setup);
  for (size_t i = 0; i < under_test.steps.size(); ++i) {
    contract::Step step = under_test.steps[i];
    const cv::Scalar level(i % 2 == 0 ? 0.0 : 255.0);
    for (CameraFrame& frame : step.frames) frame.image = cv::Mat(frame.image.size(), CV_8UC1, level);
    const std::string status = module->update(under_test.observation(step, i)).status;
    EXPECT_TRUE(GetParam().blank.empty() || status == GetParam().blank) << status;
  }
}

// The contract must reject a module that violates it.
class Forgetful : public Module {
  Needs do_needs() const override { return {}; }
  void do_reset(const Setup&) override {}
  Decision do_update(const Observation&) override { return {HoverCommand{0.1 * ++count_}, "hover", {}}; }
  int count_ = 0;
};

TEST(ContractViolation, RejectsAModuleThatKeepsStateOfItsLastFlight) {
  static const contract::Subject forgetful{.make = [] { return std::make_unique<Forgetful>(); },
                                           .setup = {.limits = {.speed_mps = 1.0}},
                                           .steps = std::vector<contract::Step>(1)};
  contract::expect_same_input_gives_the_same_bits(forgetful);
  EXPECT_NONFATAL_FAILURE(contract::expect_reset_equals_a_new_module(forgetful), "bits");
}

INSTANTIATE_TEST_SUITE_P(Registry, Contract, testing::ValuesIn(rows()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace hedgehop::avoidance
