#include "avoidance/stereo_corridor/stereo_corridor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "avoidance/contract.h"
#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance::stereo_corridor {
namespace {

constexpr int kSizePx = 160;
constexpr double kBackdropM = 45.0;

/// Flies towards a goal far to the north with a stereo pair, a far backdrop and nearer walls.
class Pilot {
 public:
  explicit Pilot(StereoCorridorConfig config = {}, double pair_right_m = 0.0) : setup_(stereo_pair(kSizePx, 10.0)) {
    for (MountedCamera& camera : setup_.cameras) camera.X_BC.translation().y() += pair_right_m;
    config.stereo.disparities_px = 16;
    config.corridor = {.radius_m = 1.5, .target_m = 20.0};
    module_ = make_stereo_corridor(config);
    module_->reset(setup_);
  }

  Decision see(std::vector<vision::TexturedPlane> walls, const Eigen::Vector2d& v_WB_W = {3.0, 0.0},
               double north_m = 0.0, const Eigen::Vector2d& goal_W = {200.0, 0.0}, double goal_altitude_m = 6.0) {
    walls.push_back(wall(kBackdropM, 0.0, M_PI));
    const NavigationState navigation = level_flight({north_m, 0.0, -6.0}, 0.0, v_WB_W);
    t_ns_ += 100'000'000;
    const vision::WaveTexture texture(7, 0.4, 6.0, 24);
    const std::vector<CameraFrame> frames = avoidance::see(setup_, navigation, t_ns_, walls, texture);
    return module_->update({t_ns_, frames, navigation, {{goal_W.x(), goal_W.y(), -goal_altitude_m}, 0.0}});
  }
  double metric(const std::string& name) const {
    for (const Metric& metric : module_->metrics()) {
      if (metric.name == name) return metric.value;
    }
    return std::nan("");
  }

 private:
  Setup setup_;
  std::unique_ptr<Module> module_;
  int64_t t_ns_ = 0;
};

const VelocityCommand& velocity(const Decision& decision) { return std::get<VelocityCommand>(decision.command); }

TEST(StereoCorridor, FliesAFreeCourseStraight) {
  Pilot pilot;
  const Decision decision = pilot.see({});
  EXPECT_EQ(decision.status, "cruise");
  const double kOnePixelRad = 2.0 / kSizePx;
  EXPECT_NEAR(velocity(decision).heading_rad, 0.0, kOnePixelRad);
  EXPECT_NEAR(velocity(decision).v_WB_W.norm(), 5.0, 1e-9);
}

TEST(StereoCorridor, GoalDirectionIsFromTheCameraNotFromTheBody) {
  constexpr double kGoalM = 25.0, kFocalPx = 0.5 * kSizePx, kRounding = 0.6;
  for (const double pair_right_m : {-2.0, 0.0, 3.0}) {
    const Decision decision = Pilot({}, pair_right_m).see({}, {3.0, 0.0}, 0.0, {kGoalM, 0.0});
    EXPECT_EQ(decision.status, "cruise");
    EXPECT_NEAR(decision.signals[0], 0.5 * (kSizePx - 1) - kFocalPx * pair_right_m / kGoalM, kRounding);
  }
}

TEST(StereoCorridor, PassesAnObstacleOnItsFreeSide) {
  for (const double side : {-1.0, 1.0}) {
    Pilot pilot;
    // 8 m wide at 14 m, extending 2 m past the course.
    const Decision decision = pilot.see({wall(14.0, -2.0 * side, M_PI, 4.0)});
    EXPECT_NE(decision.status, "cruise");
    const Eigen::Vector2d v_W = velocity(decision).v_WB_W;
    // At the distance of the obstacle the path keeps the radius of the corridor from its edge, within one pixel.
    const double east_m = side * 14.0 * v_W.y() / v_W.x();
    EXPECT_GT(east_m, 2.0 + 1.5 - 0.5);
  }
}

TEST(StereoCorridor, HoversAndTurnsIfAllObstaclesAreNear) {
  Pilot pilot;
  for (int i = 0; i < 3; ++i) {
    const Decision decision = pilot.see({wall(9.0, 0.0, M_PI)});
    EXPECT_EQ(decision.status, "look_round");
    EXPECT_NE(std::get<HoverCommand>(decision.command).yaw_rate_radps, 0.0);
  }
  EXPECT_NEAR(pilot.metric("hover_time_s"), 0.2, 1e-9);
  EXPECT_NEAR(pilot.metric("decision_hz"), 10.0, 1e-9);
}

TEST(StereoCorridor, ResumesTheCourseOnceItIsFree) {
  Pilot pilot;
  pilot.see({wall(14.0, -2.0, M_PI, 4.0)});
  EXPECT_EQ(pilot.see({}, {2.8, 1.0}).status, "cruise");
}

TEST(StereoCorridor, DoesNotTurnIntoAnObstacleThatItIsPassing) {
  for (const bool remembers : {true, false}) {
    Pilot pilot;
    // 3 m to the side of the path. Half a meter in front of the obstacle it has left the image, and the goal is 43
    // degrees to its side.
    const vision::TexturedPlane beside = wall(8.0, 5.0, M_PI, 2.0);
    if (remembers) pilot.see({beside});
    const Decision decision = pilot.see({beside}, {3.0, 0.0}, 7.5, {200.0, 192.5 * std::tan(0.75)});
    EXPECT_EQ(decision.status == "cruise", !remembers) << decision.status;
  }
}

/// Flies to a goal at an elevation, 40 m ahead.
Decision to_goal_above(double elevation_deg, const Eigen::Vector2d& v_WB_W, Law law = Law::modified) {
  StereoCorridorConfig config;
  config.law = law;
  return Pilot(config).see({}, v_WB_W, 0.0, {40.0, 0.0}, 6.0 + 40.0 * std::tan(elevation_deg * M_PI / 180.0));
}

TEST(StereoCorridor, SlowsDownSoThatItsClimbIsAsSteepAsItsCorridor) {
  const double kClimbMps = StereoCorridorConfig().climb_rate_mps, kOnePixel = 2.0 / kSizePx;
  for (const double elevation_deg : {14.0, 18.0}) {
    const Decision decision = to_goal_above(elevation_deg, {2.0, 0.0});
    EXPECT_EQ(decision.status, "cruise");
    const double slope = kClimbMps / velocity(decision).v_WB_W.norm();
    EXPECT_NEAR(slope, std::tan(elevation_deg * M_PI / 180.0), 2.0 * kOnePixel);
  }
  EXPECT_NEAR(velocity(to_goal_above(5.0, {2.0, 0.0})).v_WB_W.norm(), 5.0, 1e-9);
}

TEST(StereoCorridor, RejectsACorridorThatItCannotClimbIntoAtItsSpeed) {
  // At 5 m/s it would get 1.1 m below a ray of 20 degrees, more than half the radius of 1.5 m.
  EXPECT_NE(to_goal_above(20.0, {5.0, 0.0}).status, "cruise");
  EXPECT_EQ(to_goal_above(20.0, {2.0, 0.0}).status, "cruise");
}

TEST(StereoCorridor, BacksOffBeforeItTurnsNextToAnObstacle) {
  Pilot pilot;
  pilot.see({wall(14.0, -2.0, M_PI, 4.0)});  // a free corridor at a safe distance
  EXPECT_EQ(pilot.see({wall(9.0, 0.0, M_PI)}, {0.1, 0.0}, 0.0).status, "look_round");
  const Decision near = pilot.see({wall(9.0, 0.0, M_PI)}, {0.1, 0.0}, 7.0);
  EXPECT_EQ(near.status, "retreat");
  EXPECT_NEAR(std::get<PositionCommand>(near.command).p_WB.x(), 0.0, 1e-9);
}

TEST(StereoCorridor, PublishedLawKeepsTheDirectionOfFlightAndModifiedLawFliesToTheGoal) {
  const Eigen::Vector2d goal_W{100.0, 50.0};
  const auto flown = [&](Law law) {
    StereoCorridorConfig config;
    config.law = law;
    return Pilot(config).see({}, {3.0, 0.0}, 0.0, goal_W);
  };
  const Decision published = flown(Law::published), modified = flown(Law::modified);
  const double kOnePixelRad = 2.0 / kSizePx;
  EXPECT_EQ(published.status, "keep");
  EXPECT_NEAR(velocity(published).heading_rad, 0.0, kOnePixelRad);
  EXPECT_EQ(modified.status, "cruise");
  EXPECT_NEAR(velocity(modified).heading_rad, std::atan2(50.0, 100.0), kOnePixelRad);
}

TEST(StereoCorridor, PublishedLawPassesAnObstacleAndHoversIfAllObstaclesAreNear) {
  StereoCorridorConfig config;
  config.law = Law::published;
  EXPECT_EQ(Pilot(config).see({wall(14.0, -2.0, M_PI, 4.0)}).status, "search");
  EXPECT_EQ(Pilot(config).see({wall(9.0, 0.0, M_PI)}).status, "look_round");
}

TEST(StereoCorridor, ApproachesAGoalBelowTheViewAtTheImageEdgeAndDescendsOnTheSpot) {
  // The view extends 45 degrees downward.
  const Decision above = Pilot().see({}, {3.0, 0.0}, 0.0, {12.0, 0.0}, -9.0);
  EXPECT_EQ(above.status, "approach");
  EXPECT_DOUBLE_EQ(above.signals[1], kSizePx - 1.0);
  EXPECT_LT(velocity(above).altitude_m, 6.0);
  const Decision over_it = Pilot().see({}, {1.0, 0.0}, 0.0, {4.0, 0.0}, -9.0);
  EXPECT_EQ(over_it.status, "arrive");
  EXPECT_DOUBLE_EQ(std::get<PositionCommand>(over_it.command).p_WB.z(), 9.0);
}

/// Returns the course with a single addition, to measure its effect in the tests above.
TEST(StereoCorridor, EachAdditionActsAlone) {
  StereoCorridorConfig goal_first, memory;
  goal_first.additions = {.goal_first = true, .memory = false, .sky = false};
  memory.additions = {.goal_first = false, .memory = true, .sky = false};
  const Eigen::Vector2d aside_W(200.0, 60.0);
  EXPECT_NEAR(velocity(Pilot(goal_first).see({}, {3.0, 0.0}, 0.0, aside_W)).heading_rad, std::atan2(60.0, 200.0), 0.02);
  EXPECT_NEAR(velocity(Pilot(memory).see({}, {3.0, 0.0}, 0.0, aside_W)).heading_rad, 0.0, 0.02);

  const vision::TexturedPlane beside = wall(8.0, 5.0, M_PI, 2.0);
  const Eigen::Vector2d past_it_W(200.0, 192.5 * std::tan(0.75));
  Pilot forgetful(goal_first);
  forgetful.see({beside});
  EXPECT_EQ(forgetful.see({beside}, {3.0, 0.0}, 7.5, past_it_W).status, "cruise");
}

TEST(StereoCorridor, ModifiedLawWithoutAdditionsEqualsThePublishedLaw) {
  StereoCorridorConfig bare, published;
  bare.additions = {.goal_first = false, .memory = false, .sky = false};
  published.law = Law::published;
  Pilot a(bare), b(published);
  for (int i = 0; i < 5; ++i) {
    const double east_m = -2.0 + i;
    const Decision modified = a.see({wall(14.0, east_m, M_PI, 4.0)}), paper = b.see({wall(14.0, east_m, M_PI, 4.0)});
    contract::expect_same({modified}, {paper});
  }
}

TEST(StereoCorridor, ApproachSpeedAllowsATurnToAMissedGoal) {
  for (const double goal_m : {1.0, 4.0, 9.0, 30.0}) {
    Pilot pilot;
    const double v_mps = velocity(pilot.see({}, {3.0, 0.0}, 0.0, {goal_m, 0.0})).v_WB_W.norm();
    const double kAccelerationMps2 = 5.0;  // of the setup
    EXPECT_LE(2.0 * v_mps * v_mps / kAccelerationMps2, goal_m + 1e-9);
    EXPECT_GE(v_mps, 0.5);
  }
}

}  // namespace
}  // namespace hedgehop::avoidance::stereo_corridor
