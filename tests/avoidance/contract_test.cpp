#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include "avoidance/registry.h"
#include "tests/avoidance/flow_balance/flow_rig.h"

/// What every module of the registry promises, whatever it is for.
namespace hedgehop::avoidance {
namespace {

struct Row {
  std::string name;
  ModuleConfig config;
  bool stereo = false;           ///< looks forward with a pair of cameras
  bool holds_heading = true;     ///< and height; else it flies where it looks
  bool fisheye = false;          ///< looks down with one camera
  std::string blank = "cruise";  ///< status where nothing can be seen
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

// Every row of the registry with its defaults, and the ways of a row that differ much.
std::vector<Row> rows() {
  auto all = default_rows(std::make_index_sequence<std::variant_size_v<ModuleConfig>>{});
  for (Row& row : all) {
    row.stereo = row.name == "section_grid" || row.name == "stereo_corridor";
    row.fisheye = row.name == "corridor_centering";
    row.holds_heading = !row.stereo && !row.fisheye && row.name != "landmark_map";
    // Between walls that cannot be seen the way is not free.
    if (row.fisheye) row.blank = "blind";
  }
  flow_balance::FlowBalanceConfig balance;
  balance.law = flow_balance::FlowBalanceConfig::Law::printed;
  balance.spiral_angle_rad = 0.1;
  all.push_back({"flow_balance_printed", balance});
  flow_balance::FlowBalanceConfig filtered;
  filtered.flow.margin_px = 0;
  filtered.command_time_constant_s = 0.3;
  filtered.spiral_angle_rad = 0.1;
  all.push_back({"flow_balance_filtered", filtered});
  flow_balance::ZigZagConfig zig_zag;
  zig_zag.law = flow_balance::ZigZagConfig::Law::printed;
  all.push_back({"zig_zag_printed", zig_zag});
  landmark_map::LandmarkMapModuleConfig thesis;
  thesis.law = landmark_map::Law::printed;
  all.push_back({.name = "landmark_map_printed", .config = thesis, .holds_heading = false});
  return all;
}

class Contract : public testing::TestWithParam<Row> {
 protected:
  static constexpr int kSizePx = 160, kSteps = 4;

  // A flight past two walls; made once, for drawing takes most of a test's time.
  struct Step {
    NavigationState navigation;
    std::vector<CameraFrame> frames;
  };
  static const std::vector<Step>& flight() {
    static const std::vector<Step> all_round = make_flight(four_cameras(kSizePx, 25.0));
    static const std::vector<Step> ahead = make_flight(stereo_pair(kSizePx, 25.0));
    static const std::vector<Step> below = make_flight(fisheye_below(2 * kSizePx, 25.0));
    if (GetParam().fisheye) return below;
    return GetParam().stereo ? ahead : all_round;
  }
  static std::vector<Step> make_flight(const avoidance::Setup& rig) {
    const vision::WaveTexture texture(5, 0.3, 4.0, 12);
    const std::vector<vision::TexturedPlane> walls = {wall(9, 0, M_PI), wall(0, 5, -0.5 * M_PI)};
    std::vector<Step> made;
    for (int i = 0; i < kSteps; ++i) {
      Step step;
      step.navigation = level_flight({0.04 * i, 0.02 * i, -6.0}, 0.3, {1.0, 0.5});
      step.navigation.w_WB_B_est = {0.01, -0.02, 0.05};
      step.frames = see(rig, step.navigation, int64_t{40'000'000} * i, walls, texture);
      made.push_back(std::move(step));
    }
    return made;
  }
  static avoidance::Setup setup(double speed_limit_mps = 10.0) {
    if (GetParam().fisheye) return fisheye_below(2 * kSizePx, 25.0, speed_limit_mps);
    return GetParam().stereo ? stereo_pair(kSizePx, 25.0, speed_limit_mps)
                             : four_cameras(kSizePx, 25.0, speed_limit_mps);
  }
  static Observation observation(const Step& step, int i) {
    return {int64_t{40'000'000} * i, step.frames, step.navigation, {{40, 10, -8}, 0.3}};
  }
  static std::vector<Decision> fly(Module& module, double speed_limit_mps = 10.0, bool annotate = false) {
    module.reset(setup(speed_limit_mps));
    std::vector<Decision> decisions;
    for (int i = 0; i < kSteps; ++i) {
      decisions.push_back(module.update(observation(flight()[static_cast<size_t>(i)], i)));
      if (annotate) module.annotate();
    }
    return decisions;
  }

  // All numbers of a decision, bit by bit, so that NaN equals NaN.
  static std::vector<uint64_t> bits(const Decision& decision) {
    std::vector<double> numbers = decision.signals;
    if (const auto* velocity = std::get_if<VelocityCommand>(&decision.command)) {
      numbers.insert(numbers.end(),
                     {velocity->v_WB_W.x(), velocity->v_WB_W.y(), velocity->altitude_m, velocity->heading_rad});
    }
    if (const auto* position = std::get_if<PositionCommand>(&decision.command)) {
      numbers.insert(numbers.end(),
                     {position->p_WB.x(), position->p_WB.y(), position->p_WB.z(), position->heading_rad});
    }
    std::vector<uint64_t> result = {decision.command.index()};
    for (const double number : numbers) result.push_back(std::bit_cast<uint64_t>(number));
    return result;
  }
  static void expect_same(const std::vector<Decision>& a, const std::vector<Decision>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(bits(a[i]), bits(b[i])) << i;
      EXPECT_EQ(a[i].status, b[i].status) << i;
    }
  }
};

TEST_P(Contract, SameInputGivesTheSameBits) {
  const auto a = make_module(GetParam().config), b = make_module(GetParam().config);
  expect_same(fly(*a), fly(*b));
}

TEST_P(Contract, ResetEqualsANewModule) {
  const auto used = make_module(GetParam().config), fresh = make_module(GetParam().config);
  fly(*used);
  expect_same(fly(*used), fly(*fresh));
}

TEST_P(Contract, DrawingChangesNothingAndGivesRgb) {
  const auto drawn = make_module(GetParam().config), plain = make_module(GetParam().config);
  expect_same(fly(*drawn, 10.0, true), fly(*plain));
  const cv::Mat image = drawn->annotate();
  if (!image.empty()) {
    EXPECT_EQ(image.type(), CV_8UC3);
  }
  const auto unused = make_module(GetParam().config);
  EXPECT_NO_THROW(unused->annotate());
}

TEST_P(Contract, SpeedLimitsHold) {
  const auto module = make_module(GetParam().config);
  for (const Decision& decision : fly(*module, 0.7)) {
    if (const auto* velocity = std::get_if<VelocityCommand>(&decision.command)) {
      EXPECT_LE(velocity->v_WB_W.norm(), 0.7 + 1e-12);
    }
  }
}

TEST_P(Contract, HoldsTheGoalsHeadingAndHeightOrFliesWhereItLooks) {
  const auto module = make_module(GetParam().config);
  for (const Decision& decision : fly(*module)) {
    if (const auto* velocity = std::get_if<VelocityCommand>(&decision.command)) {
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
}

TEST_P(Contract, BlankImagesAreSurvivedAndLeaveTheWayFree) {
  const auto module = make_module(GetParam().config);
  module->reset(setup());
  for (int i = 0; i < kSteps; ++i) {
    Step step = flight()[static_cast<size_t>(i)];
    for (CameraFrame& frame : step.frames) frame.image = cv::Mat(frame.image.size(), CV_8UC1, cv::Scalar(i % 2 * 255));
    const Decision decision = module->update(observation(step, i));
    EXPECT_EQ(decision.status, GetParam().blank);
  }
}

TEST_P(Contract, MissingFramesAreSurvived) {
  const auto module = make_module(GetParam().config);
  module->reset(setup());
  for (int i = 0; i < kSteps; ++i) {
    Step step = flight()[static_cast<size_t>(i)];
    if (i == 1) step.frames.clear();
    if (i == 2) step.frames.pop_back();
    EXPECT_NO_THROW(module->update(observation(step, i)));
  }
}

TEST_P(Contract, NavigationThatIsNotFiniteIsRejected) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto refuse = [&](auto change) {
    const auto module = make_module(GetParam().config);
    module->reset(setup());
    Observation bad = observation(flight()[0], 0);
    change(bad);
    EXPECT_THROW(module->update(bad), std::logic_error);
  };
  refuse([](Observation& o) { o.navigation.p_WB_est.x() = kNan; });
  refuse([](Observation& o) { o.navigation.q_WB_est.w() = kNan; });
  refuse([](Observation& o) { o.navigation.v_WB_B_est.y() = INFINITY; });
  refuse([](Observation& o) { o.navigation.w_WB_B_est.z() = kNan; });
  refuse([](Observation& o) { o.navigation.q_WB_gyro.x() = kNan; });
  refuse([](Observation& o) { o.navigation.height_above_ground_m = kNan; });
  refuse([](Observation& o) { o.navigation.range_m = INFINITY; });
  refuse([](Observation& o) { o.goal.p_WG.z() = kNan; });
  refuse([](Observation& o) { o.goal.heading_rad = kNan; });
}

TEST_P(Contract, SignalsAndMetricsAreNamedOnceAndSteady) {
  const auto module = make_module(GetParam().config);
  const auto before = module->signals();
  const auto decisions = fly(*module);
  std::set<std::string> names;
  for (const Signal& signal : before) {
    EXPECT_TRUE(names.insert(signal.name).second) << signal.name;
    EXPECT_EQ(signal.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos) << signal.name;
  }
  EXPECT_EQ(module->signals().size(), before.size());
  for (const Decision& decision : decisions) {
    EXPECT_EQ(decision.signals.size(), before.size());
    EXPECT_FALSE(decision.status.empty());
    EXPECT_EQ(decision.status.find_first_of(" ,\"\n"), std::string::npos);
  }
  for (const Metric& metric : module->metrics()) EXPECT_FALSE(std::isinf(metric.value)) << metric.name;
}

TEST_P(Contract, AllNeededCamerasMustBeThere) {
  const auto module = make_module(GetParam().config);
  for (const CameraNeed& need : module->needs().cameras) {
    avoidance::Setup blind = setup();
    std::erase_if(blind.cameras, [&](const MountedCamera& camera) { return camera.role == need.role; });
    EXPECT_THROW(module->reset(blind), std::invalid_argument) << need.role;
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, Contract, testing::ValuesIn(rows()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace hedgehop::avoidance
