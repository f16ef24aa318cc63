#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "avoidance/section_grid/section_grid.h"
#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance::section_grid {
namespace {

constexpr int kWidthPx = 160, kHeightPx = 90;
constexpr double kThresholdM = 9.144;

/// One depth camera, and a module that uses it to fly towards a goal far to the north.
class Pilot {
 public:
  enum class Mount { upright, on_its_side };
  explicit Pilot(SectionGridConfig config = {}, Mount mount = Mount::upright)
      : module_(make_section_grid(with_camera(config))) {
    Setup setup;
    MountedCamera camera = level_camera("depth", 0.0, kWidthPx, 12.5);
    vision::camera::PinholeCamera lens = vision::camera::PinholeCamera::from_fov(kWidthPx, kHeightPx, 1.48);
    if (mount == Mount::on_its_side) {
      camera.X_BC.linear() << 0, 0, 1, 0, -1, 0, 1, 0, 0;  // rows point down, columns to the left
      std::swap(lens.width_px, lens.height_px);
      std::swap(lens.center_u_px, lens.center_v_px);
    }
    camera.model = lens;
    setup.cameras = {camera};
    setup.limits = {5.0, 2.0, 1.0};
    module_->reset(setup);
  }

  Decision see(const cv::Mat& depth_m, const Eigen::Vector3d& p_WB = {0.0, 0.0, -5.0}, double heading_rad = 0.0) {
    t_ns_ += 80'000'000;
    const std::vector<CameraFrame> frames = {{"depth", t_ns_, depth_m}};
    return module_->update({t_ns_, frames, level_flight(p_WB, heading_rad, {1.0, 0.0}), {{100.0, 0.0, -5.0}, 0.0}});
  }
  const Module& module() const { return *module_; }

 private:
  static SectionGridConfig with_camera(SectionGridConfig config) {
    config.depth = stereo::DisparitySource::From::camera;
    return config;
  }
  std::unique_ptr<Module> module_;
  int64_t t_ns_ = 0;
};

cv::Mat far() { return {kHeightPx, kWidthPx, CV_32FC1, cv::Scalar(30.0)}; }

/// A near obstacle in a band of columns.
cv::Mat near_between(int first_px, int last_px) {
  cv::Mat depth_m = far();
  depth_m.colRange(first_px, last_px).setTo(4.0);
  return depth_m;
}

const PositionCommand& position(const Decision& decision) { return std::get<PositionCommand>(decision.command); }

// The image of a camera on its side is the upright one, turned.
TEST(SectionGridModule, CameraOnItsSideGivesTheDecisionsOfAnUprightOne) {
  cv::Mat high = far();
  high(cv::Rect(100, 0, 60, 60)).setTo(4.0);
  for (const cv::Mat& upright_m : {far(), near_between(0, 80), near_between(80, kWidthPx), high}) {
    cv::Mat mounted_m;
    cv::rotate(upright_m, mounted_m, cv::ROTATE_90_COUNTERCLOCKWISE);
    Pilot upright, on_its_side({}, Pilot::Mount::on_its_side);
    const Decision a = upright.see(upright_m), b = on_its_side.see(mounted_m);
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.signals, b.signals);
    EXPECT_TRUE(position(a).p_WB.isApprox(position(b).p_WB, 1e-9));
    EXPECT_NEAR(position(a).heading_rad, position(b).heading_rad, 1e-9);
  }
}

TEST(SectionGridModule, ContinuesToTheGoalIfThePathIsFree) {
  Pilot pilot;
  const Decision decision = pilot.see(far());
  EXPECT_EQ(decision.status, "cruise");
  EXPECT_EQ(position(decision).p_WB, Eigen::Vector3d(100.0, 0.0, -5.0));
}

TEST(SectionGridModule, MovesByTheThresholdToTheFreeSideOfAnObstacle) {
  for (const bool left : {true, false}) {
    Pilot pilot;
    const Decision decision = pilot.see(left ? near_between(0, 80) : near_between(80, kWidthPx), {0.0, 0.0, -5.0});
    EXPECT_EQ(decision.status, "avoid");
    // It first turns on the spot towards a position on the free side, within the view of the camera.
    const double heading_rad = position(decision).heading_rad;
    EXPECT_GT(left ? heading_rad : -heading_rad, 0.17);
    EXPECT_LT(std::abs(heading_rad), 0.74);
    EXPECT_EQ(position(decision).p_WB, Eigen::Vector3d(0.0, 0.0, -5.0));
    // Now the obstacle is at the edge of the image, in front of the goal.
    const Decision facing =
        pilot.see(left ? near_between(0, 30) : near_between(130, kWidthPx), {0.0, 0.0, -5.0}, heading_rad);
    constexpr double kHalfPixelM = 1e-3;  // the center of the middle section is half a pixel off the camera axis
    EXPECT_NEAR(position(facing).p_WB.head<2>().norm(), kThresholdM, kHalfPixelM);
  }
}

TEST(SectionGridModule, ResumesTheRouteAsSoonAsTheGoalIsFree) {
  Pilot pilot;
  const double heading_rad = position(pilot.see(near_between(0, 80))).heading_rad;
  EXPECT_EQ(pilot.see(near_between(0, 30), {0.0, 0.0, -5.0}, heading_rad).status, "avoid");
  EXPECT_EQ(pilot.see(far(), {0.0, 0.0, -5.0}, heading_rad).status, "resume");
}

TEST(SectionGridModule, DoesNotResumeTheRouteWhileAnObstacleIsStraightAhead) {
  Pilot pilot;
  // The goal is 0.4 rad to the right of the heading, an obstacle a little to the left of it.
  cv::Mat ahead = far();
  ahead(cv::Rect(50, 35, 20, 20)).setTo(4.0);
  const Eigen::Vector3d start(0.0, 0.0, -5.0);
  EXPECT_EQ(pilot.see(ahead, start, -0.4).status, "avoid");
  EXPECT_EQ(pilot.see(ahead, start, -0.4).status, "avoid");
  EXPECT_EQ(pilot.see(far(), start, -0.4).status, "resume");
}

TEST(SectionGridModule, ResumesTheRouteAfterMovingAside) {
  Pilot pilot;
  const double heading_rad = position(pilot.see(near_between(0, 80))).heading_rad;
  const cv::Mat goal_blocked = near_between(0, 30);
  const Eigen::Vector3d aside = position(pilot.see(goal_blocked, {0.0, 0.0, -5.0}, heading_rad)).p_WB;
  const Decision there = pilot.see(goal_blocked, aside, heading_rad);
  EXPECT_EQ(there.status, "resume");
  const double to_goal_rad = position(there).heading_rad;
  EXPECT_NEAR(to_goal_rad, std::atan2(-aside.y(), 100.0 - aside.x()), 1e-12);
  const Decision onwards = pilot.see(far(), aside, to_goal_rad);
  EXPECT_EQ(onwards.status, "cruise");
  EXPECT_EQ(position(onwards).p_WB.head<2>(), Eigen::Vector2d(100.0, 0.0));
}

TEST(SectionGridModule, HoversAndTurnsInFrontOfAWallAndCountsTheTime) {
  Pilot pilot;
  const cv::Mat wall = near_between(0, kWidthPx);
  for (int i = 0; i < 6; ++i) {
    const Decision decision = pilot.see(wall);
    EXPECT_EQ(decision.status, "hover_and_yaw");
    EXPECT_NE(std::get<HoverCommand>(decision.command).yaw_rate_radps, 0.0);
  }
  double hover_s = 0.0;
  for (const Metric& metric : pilot.module().metrics()) {
    if (metric.name == "hover_time_s") hover_s = metric.value;
  }
  EXPECT_NEAR(hover_s, 5 * 0.08, 1e-9);
  EXPECT_EQ(pilot.see(far()).status, "avoid");  // off the route: the found path is flown first
}

TEST(SectionGridModule, EveryAnswerHasItsOwnDirection) {
  const auto moved = [](Answer answer) {
    SectionGridConfig config;
    config.answer = answer;
    Pilot pilot(config);
    const Eigen::Vector3d start(0.0, 0.0, -5.0);
    Decision decision = pilot.see(near_between(0, 80), start);
    if (answer == Answer::heading) decision = pilot.see(near_between(0, 30), start, position(decision).heading_rad);
    return Eigen::Vector3d(position(decision).p_WB - start);
  };
  const Eigen::Vector3d heading = moved(Answer::heading), sideways = moved(Answer::sideways);
  EXPECT_EQ(heading.z(), 0.0);
  EXPECT_GT(heading.x(), 5.0);
  EXPECT_TRUE(sideways.isApprox(Eigen::Vector3d(0.0, kThresholdM, 0.0), 1e-9));
  EXPECT_TRUE(moved(Answer::climb).isApprox(Eigen::Vector3d(0.0, 0.0, -kThresholdM), 1e-9));
  const Eigen::Vector3d combined = moved(Answer::combined);
  EXPECT_NEAR(combined.y(), -combined.z(), 1e-9);
  EXPECT_GT(combined.y(), 0.0);
}

SectionGridConfig published() {
  SectionGridConfig config;
  config.law = Law::published;
  return config;
}

// [Perez2018] sec. V-D: "if another new position is determined to be a better solution, the UAS will adjust".
TEST(SectionGridModule, PublishedLawMovesToABetterPositionWhileTheModifiedLawKeepsItsPath) {
  for (const Law law : {Law::published, Law::modified}) {
    SectionGridConfig config;
    config.law = law;
    Pilot pilot(config);
    const double heading_rad = position(pilot.see(near_between(0, 80))).heading_rad;
    const Eigen::Vector3d start(0.0, 0.0, -5.0);
    const Eigen::Vector3d aside = position(pilot.see(near_between(0, 30), start, heading_rad)).p_WB;
    // A few pixels of the section of the path show a threat; another section has none.
    cv::Mat later = near_between(0, 30);
    later(cv::Rect(78, 43, 3, 3)).setTo(4.0);
    const Eigen::Vector3d path = position(pilot.see(later, start, heading_rad)).p_WB;
    EXPECT_EQ((path - aside).norm() > 0.1, law == Law::published) << path.transpose() << " " << aside.transpose();
  }
}

TEST(SectionGridModule, PublishedLawContinuesOrTurnsThenMovesOrHovers) {
  Pilot free(published()), beside(published()), before(published());
  EXPECT_EQ(position(free.see(far())).p_WB, Eigen::Vector3d(100.0, 0.0, -5.0));
  const Decision waits = beside.see(near_between(0, 80));
  EXPECT_EQ(waits.status, "avoid");
  EXPECT_EQ(position(waits).p_WB, Eigen::Vector3d(0.0, 0.0, -5.0));
  const Decision moves = beside.see(far(), {0.0, 0.0, -5.0}, position(waits).heading_rad);
  constexpr double kHalfPixelM = 1e-3;
  EXPECT_NEAR(position(moves).p_WB.head<2>().norm(), kThresholdM, kHalfPixelM);
  const Decision hovers = before.see(near_between(0, kWidthPx));
  EXPECT_EQ(hovers.status, "hover_and_yaw");
  EXPECT_GT(std::get<HoverCommand>(hovers.command).yaw_rate_radps, 0.0);
}

TEST(SectionGridModule, RejectsValuesOutOfRangeAndNamesTheKey) {
  SectionGridConfig config;
  config.threshold_m = 0.0;
  EXPECT_THAT([&] { make_section_grid(config); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("threshold: must be > 0 m, got 0")));
}

TEST(SectionGridModule, NeverDescendsBelowItsMinimumAltitude) {
  cv::Mat ceiling = far();
  ceiling.rowRange(0, 60).setTo(4.0);
  const auto altitude_m = [&](double lowest_m) {
    SectionGridConfig config;
    config.lowest_m = lowest_m;
    Pilot pilot(config);
    return -position(pilot.see(ceiling, {0.0, 0.0, -4.0})).p_WB.z();
  };
  EXPECT_LT(altitude_m(2.0), 3.9);
  EXPECT_EQ(altitude_m(4.0), 4.0);
}

// A hedge 1 m ahead, 2.4 m below the vehicle, is 12 deg below the horizon in an image from 10 m behind. The straight
// path to the goal, 3 m lower and 100 m ahead, passes above it, but a vehicle that sinks at 45 deg does not.
TEST(SectionGridModule, DescendsOnlyIfItCanSinkBeforeItMovesAhead) {
  cv::Mat hedge = far();
  hedge.rowRange(64, kHeightPx).setTo(11.0);
  const auto altitude_m = [](const cv::Mat& from_behind) {
    Pilot pilot;
    pilot.see(from_behind, {-10.0, 0.0, -8.0});
    return -position(pilot.see(far(), {0.0, 0.0, -8.0})).p_WB.z();
  };
  EXPECT_NEAR(altitude_m(far()), 8.0 - 0.03 * 2.0, 1e-9);  // 2 m ahead on the path
  EXPECT_GT(altitude_m(hedge), 7.98);
}

TEST(SectionGridModule, SpeedDependentThresholdIncludesFartherObstaclesAtHigherSpeed) {
  SectionGridConfig config;
  config.threshold_time_s = 20.0;  // at the 1 m/s of this flight, and a radius of 1 m: 21 m
  cv::Mat beyond = far();
  beyond.colRange(0, 80).setTo(20.0);
  EXPECT_EQ(Pilot(config).see(beyond).status, "avoid");
  EXPECT_EQ(Pilot().see(beyond).status, "cruise");
}

TEST(SectionGridModule, StaysAsideWhileAnObstacleOutOfViewBlocksThePathToTheGoal) {
  for (const bool remembers : {true, false}) {
    SectionGridConfig config;
    config.passed_radius_m = remembers ? 1.2 : 0.0;
    Pilot pilot(config);
    // A wall 2 m ahead, from the left edge past the middle. After a right turn the image still shows the path to the
    // goal, but no longer the wall, which begins half a meter to the left of that path.
    cv::Mat wall = far();
    wall.colRange(0, 90).setTo(2.0);
    pilot.see(wall);
    EXPECT_EQ(pilot.see(far(), {0.0, 0.0, -5.0}, 0.5).status, remembers ? "avoid" : "resume");
  }
}

TEST(SectionGridModule, StaysAsideWhileAnObstacleInViewIsCloserToThePathThanTheRadius) {
  for (const double radius_m : {0.0, 0.4, 1.2}) {
    SectionGridConfig config;
    config.passed_radius_m = radius_m;
    Pilot pilot(config);
    pilot.see(near_between(0, 60));  // 0.9 m to the left of the path
    // A wire 1.9 m ahead, 0.6 m above the path to the goal and above the middle section.
    cv::Mat wire = far();
    wire.rowRange(15, 19).setTo(1.9);
    EXPECT_EQ(pilot.see(wire).status == "avoid", radius_m > 1.0) << radius_m;
  }
}

TEST(SectionGridModule, HoveringVehicleStaysAtItsEvasionPosition) {
  SectionGridConfig config;
  config.answer = Answer::sideways;
  Pilot pilot(config);
  const Eigen::Vector3d goal(100.0, 0.0, -5.0);
  const Eigen::Vector3d aside = position(pilot.see(near_between(0, 80), goal)).p_WB;
  EXPECT_NEAR((aside - goal).norm(), kThresholdM, 1e-9);
  EXPECT_GT(aside.y(), 0.5 * kThresholdM);
  EXPECT_EQ(position(pilot.see(far(), aside)).p_WB, aside);
}

TEST(SectionGridModule, HoveringVehicleEvadesEvenIfNoSectionIsFree) {
  SectionGridConfig config;
  config.answer = Answer::sideways;
  Pilot pilot(config);
  const Eigen::Vector3d goal(100.0, 0.0, -5.0);
  const Eigen::Vector3d aside = position(pilot.see(near_between(0, kWidthPx), goal)).p_WB;
  EXPECT_NEAR((aside - goal).norm(), kThresholdM, 1e-9);
}

}  // namespace
}  // namespace hedgehop::avoidance::section_grid
