#include "avoidance/corridor_centering/corridor_centering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "avoidance/corridor_centering/pursuit.h"
#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance::corridor_centering {
namespace {

using vision::StraightCorridor;

constexpr int64_t kPeriodNs = 100'000'000;
constexpr double kAltitudeM = 1.5;

// Flies north at constant velocity through the drawn scene and returns the decisions.
std::vector<Decision> fly(Module& module, const std::vector<vision::TexturedPlane>& walls,
                          const Eigen::Vector2d& from_NE, const Eigen::Vector2d& v_WB_W, int images,
                          const std::function<void(cv::Mat&)>& alter = {}, double largest_wave_m = 0.8,
                          double heading_rad = 0.0, const std::function<void(NavigationState&)>& disturb = {}) {
  const vision::WaveTexture texture(11, 0.15 * largest_wave_m, largest_wave_m, 40);
  Setup setup = fisheye_below(480, 10.0);
  module.reset(setup);
  std::vector<Decision> decisions;
  for (int i = 0; i < images; ++i) {
    const Eigen::Vector2d p_NE = from_NE + 0.1 * i * v_WB_W;
    NavigationState navigation = level_flight({p_NE.x(), p_NE.y(), -kAltitudeM}, heading_rad, v_WB_W);
    std::vector<CameraFrame> frames = see(setup, navigation, kPeriodNs * i, walls, texture);
    if (alter) alter(frames.front().image);
    if (disturb) disturb(navigation);
    decisions.push_back(module.update({kPeriodNs * i, frames, navigation, {{30, 0, -kAltitudeM}, 0.0}}));
  }
  return decisions;
}

double signal(const Module& module, const Decision& decision, const std::string& name) {
  const auto signals = module.signals();
  for (size_t i = 0; i < signals.size(); ++i) {
    if (signals[i].name == name) return decision.signals[i];
  }
  throw std::invalid_argument(name);
}

TEST(CorridorCentering, MeasuresTheErrorAndBothWalls) {
  for (const double east_m : {-0.5, 0.0, 0.4}) {
    const auto module = make_corridor_centering({});
    const StraightCorridor corridor;
    const Decision last = fly(*module, corridor.planes(), {0, east_m}, {0.8, 0}, 3).back();
    EXPECT_EQ(last.status, "cruise");
    EXPECT_NEAR(signal(*module, last, "centering_error"), -east_m / 1.25, 0.03);
    EXPECT_NEAR(signal(*module, last, "left_m"), 1.25 + east_m, 0.05);
    EXPECT_NEAR(signal(*module, last, "right_m"), 1.25 - east_m, 0.05);
    // Towards the middle, 1.5 m ahead.
    const auto& command = std::get<VelocityCommand>(last.command);
    EXPECT_NEAR(std::atan2(command.v_WB_W.y(), command.v_WB_W.x()), std::atan2(-east_m, 1.5), 0.06);
    EXPECT_EQ(command.altitude_m, kAltitudeM);
  }
}

TEST(CorridorCentering, DriftAcrossTheCorridorDoesNotShiftTheMiddle) {
  const auto module = make_corridor_centering({});
  const StraightCorridor corridor;
  const Decision last = fly(*module, corridor.planes(), {0, 0.3}, {0.7, -0.3}, 3).back();
  const double east_m = 0.3 - 2 * 0.1 * 0.3;
  EXPECT_NEAR(signal(*module, last, "centering_error"), -east_m / 1.25, 0.03);
}

TEST(CorridorCentering, BothDerotationsAgree) {
  const StraightCorridor corridor;
  CorridorCenteringConfig rays;  // the published law derotates rays, the modified law the image
  rays.law = Law::published;
  const auto a = make_corridor_centering({}), b = make_corridor_centering(rays);
  const Decision by_image = fly(*a, corridor.planes(), {0, 0.4}, {0.8, 0}, 2).back();
  const Decision by_rays = fly(*b, corridor.planes(), {0, 0.4}, {0.8, 0}, 2).back();
  EXPECT_NEAR(signal(*a, by_image, "centering_error"), signal(*b, by_rays, "centering_error"), 0.02);
}

TEST(CorridorCentering, PublishedLawRollsAndTurnsTowardsTheMiddle) {
  CorridorCenteringConfig config;
  config.law = Law::published;
  const auto module = make_corridor_centering(config);
  const StraightCorridor corridor;
  const std::vector<Decision> decisions = fly(*module, corridor.planes(), {0, -0.5}, {0.4, 0}, 8);
  const auto error = [&](size_t i) { return signal(*module, decisions[i], "centering_error"); };
  const auto command = [&](size_t i) { return std::get<AttitudeCommand>(decisions[i].command); };
  EXPECT_NEAR(error(1), 0.5 / 1.25, 0.03);
  // The samples are 0.5 s apart. kD multiplies the error and kp its change since the sample before.
  constexpr double kRoundOffRad = 1e-12;
  EXPECT_NEAR(command(1).roll_rad, 0.009 * error(1), kRoundOffRad);
  EXPECT_NEAR(command(7).roll_rad, 0.009 * error(6) + 0.2 * (error(6) - error(1)), kRoundOffRad);
  EXPECT_NEAR(command(7).pitch_rad, -0.5 * std::numbers::pi / 180.0, kRoundOffRad);
  EXPECT_GT(command(7).heading_rad, 0.0);
}

TEST(CorridorCentering, HoversBetweenPlainWallsWithAnyFloor) {
  // Only the floor is textured; the walls are uniformly grey.
  const std::vector<vision::TexturedPlane> floor = {
      {{0, 0, 0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 1.25}};
  for (const auto law : {Law::modified, Law::published}) {
    CorridorCenteringConfig config;
    config.law = law;
    const auto module = make_corridor_centering(config);
    const auto decisions = fly(*module, floor, {0, 0}, {0.0, 0}, 45);
    EXPECT_TRUE(std::holds_alternative<HoverCommand>(decisions.back().command));
    EXPECT_EQ(decisions.back().status, "blind");
  }
}

TEST(CorridorCentering, OneWallAloneGivesAnUnknownError) {
  const auto module = make_corridor_centering({});
  const Decision last = fly(*module, {wall(0, 1.2, -0.5 * std::numbers::pi)}, {0, 0}, {0.6, 0}, 12).back();
  EXPECT_TRUE(std::isnan(signal(*module, last, "centering_error")));
  EXPECT_GT(signal(*module, last, "vectors_right"), 12.0);
  EXPECT_TRUE(std::holds_alternative<HoverCommand>(last.command));
}

TEST(CorridorCentering, DeceleratesInFrontOfAWallAcrossAndTurnsAwayWithAnyTexture) {
  for (const double largest_wave_m : {0.04, 0.3, 0.8}) {
    const auto command_before = [&](double path_m, double v_mps) {
      const auto module = make_corridor_centering({});
      StraightCorridor corridor;
      corridor.end_m = path_m + 2 * 0.1 * v_mps;  // after two images
      return fly(*module, corridor.planes(), {0, 0}, {v_mps, 0}, 3, {}, largest_wave_m).back();
    };
    const Decision far = command_before(6.0, 0.8), near = command_before(0.9, 0.8), at_it = command_before(0.38, 0.3);
    const double far_mps = std::get<VelocityCommand>(far.command).v_WB_W.norm();
    EXPECT_NEAR(far_mps, 0.8, 1e-9) << largest_wave_m;
    EXPECT_LT(std::get<VelocityCommand>(near.command).v_WB_W.norm(), 0.75) << largest_wave_m;
    ASSERT_TRUE(std::holds_alternative<HoverCommand>(at_it.command)) << largest_wave_m;
    EXPECT_NE(std::get<HoverCommand>(at_it.command).yaw_rate_radps, 0.0);
  }
}

TEST(CorridorCentering, TurnsAwayFromABlankWallAcrossBetweenTexturedWalls) {
  const auto blank_ahead = [](cv::Mat& image) { image(cv::Rect(145, 0, 190, 96)).setTo(128); };
  const auto module = make_corridor_centering({});
  const StraightCorridor corridor;
  const Decision last = fly(*module, corridor.planes(), {0, 0}, {0.8, 0}, 8, blank_ahead).back();
  EXPECT_EQ(last.status, "blocked");
  ASSERT_TRUE(std::holds_alternative<HoverCommand>(last.command));
  EXPECT_NE(std::get<HoverCommand>(last.command).yaw_rate_radps, 0.0);
}

TEST(CorridorCentering, HeadingErrorIsNoOffsetExceptInThePublishedLaw) {
  const double heading_rad = 0.3, east_m = 0.3;
  const auto error = [&](Law law) {
    CorridorCenteringConfig config;
    config.law = law;
    const auto module = make_corridor_centering(config);
    const StraightCorridor corridor;
    const Decision last = fly(*module, corridor.planes(), {0, east_m}, {0.8, 0}, 3, {}, 0.3, heading_rad).back();
    return signal(*module, last, "centering_error");
  };
  EXPECT_NEAR(error(Law::modified), -east_m / 1.25, 0.03);
  EXPECT_GT(std::abs(error(Law::published) + east_m / 1.25), 0.06);
}

TEST(CorridorCentering, CourseStaysWithinItsMaximumAngleToTheWallsAtAnyHeading) {
  const auto module = make_corridor_centering({});
  StraightCorridor corridor;
  corridor.left_m = 0.6, corridor.right_m = 3.0;
  const double heading_rad = 0.6, most_rad = kMaxCourseRad;
  const Decision last = fly(*module, corridor.planes(), {0, 0}, {0.7, 0.4}, 3, {}, 0.3, heading_rad).back();
  const auto& command = std::get<VelocityCommand>(last.command);
  const double off_walls_rad = std::atan2(command.v_WB_W.y(), command.v_WB_W.x());
  EXPECT_GT(off_walls_rad, 0.5 * most_rad);
  EXPECT_LT(off_walls_rad, most_rad + 0.03);
}

TEST(CorridorCentering, AttitudeCorrectionsAreNotATurn) {
  // The filter corrects the heading by two degrees between images, while the gyros measure no rotation.
  const auto module = make_corridor_centering({});
  const StraightCorridor corridor;
  int image = 0;
  const Decision last = fly(*module, corridor.planes(), {0, 0.3}, {0.8, 0}, 3, {}, 0.8, 0.0, [&](NavigationState& n) {
                          n.q_WB_est = n.q_WB_est * Eigen::AngleAxisd(0.035 * image++, Eigen::Vector3d::UnitZ());
                        }).back();
  EXPECT_NEAR(signal(*module, last, "centering_error"), -0.3 / 1.25, 0.04);
}

TEST(CorridorCentering, ConstantImagePartsDoNotChangeTheMedians) {
  // A band keeps its first content, like a part of the vehicle.
  cv::Mat stuck;
  const auto alter = [&stuck](cv::Mat& image) {
    cv::Mat band = image.rowRange(200, 246);
    if (stuck.empty()) stuck = band.clone();
    stuck.copyTo(band);
  };
  const auto module = make_corridor_centering({});
  const StraightCorridor corridor;
  const Decision last = fly(*module, corridor.planes(), {0, 0.4}, {0.8, 0}, 3, alter).back();
  EXPECT_NEAR(signal(*module, last, "centering_error"), -0.4 / 1.25, 0.05);
}

TEST(CorridorCentering, DrawsTheFisheyeImageNextToTheMap) {
  const auto module = make_corridor_centering({});
  const StraightCorridor corridor;
  fly(*module, corridor.planes(), {0, 0.3}, {0.8, 0}, 3);
  const cv::Mat image = module->annotate();
  EXPECT_EQ(image.size(), cv::Size(960, 480));
  EXPECT_EQ(image.type(), CV_8UC3);
}

TEST(CorridorCentering, RejectsAnInvalidConfig) {
  const auto refuse = [](auto change) {
    CorridorCenteringConfig config;
    change(config);
    EXPECT_THROW(make_corridor_centering(config), std::invalid_argument);
  };
  refuse([](CorridorCenteringConfig& c) { c.sample_s = 0.0; });
  refuse([](CorridorCenteringConfig& c) { c.lookahead_m = 0.0; });
  refuse([](CorridorCenteringConfig& c) { c.margin_m = -0.1; });
  refuse([](CorridorCenteringConfig& c) { c.probe_mps = 0.0; });
}

}  // namespace
}  // namespace hedgehop::avoidance::corridor_centering
