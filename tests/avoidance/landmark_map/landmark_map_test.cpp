#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "avoidance/landmark_map/landmark_map.h"
#include "avoidance/landmark_map/wall_stop.h"
#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance::landmark_map {
namespace {

constexpr int64_t kStepNs = 100'000'000;
constexpr double kStepS = 1e-9 * kStepNs, kSpeedMps = 2.0, kHeightM = 15.0, kVehicleRadiusM = 1.0;

/// A tower on the ground, observed as its eight corners.
struct Tower {
  Eigen::AlignedBox3d box_W;
  Tower(double north_m, double east_m, double half_m, double height_m)
      : box_W(Eigen::Vector3d(north_m - half_m, east_m - half_m, -height_m),
              Eigen::Vector3d(north_m + half_m, east_m + half_m, 0.0)) {}
};

/// A point that follows its commands exactly, with exact navigation and a corner detector with 0.5 px noise.
class CornerFlight {
 public:
  explicit CornerFlight(std::vector<Eigen::Vector3d> corners_W, LandmarkMapModuleConfig config = {})
      : corners_W_(std::move(corners_W)) {
    config.observer.source = CornerSource::corners;
    config.observer.map.position_sigma_m = 0.1;
    config.speed_mps = kSpeedMps;
    module_ = make_landmark_map(config);
    camera_ = level_camera("front", 0.0, 320, 1.0 / kStepS);
    module_->reset({{camera_}, {kSpeedMps, 2.0, kVehicleRadiusM}, 1});
  }

  Decision step(std::optional<double> range_m = std::nullopt) {
    NavigationState navigation = level_flight(p_WB_, heading_rad_, v_W_);
    navigation.p_WB_est.y() += east_error_m(1e-9 * static_cast<double>(t_ns_));
    navigation.range_m = range_m;
    t_ns_ += kStepNs;
    const std::vector<CameraFrame> frames = {{"front", t_ns_, seen()}};
    const Decision decision = module_->update({t_ns_, frames, navigation, {goal_W, 0.0}});
    v_W_.setZero();
    if (const auto* velocity = std::get_if<VelocityCommand>(&decision.command)) {
      v_W_ = velocity->v_WB_W;
      const double turn_rad = std::remainder(velocity->heading_rad - heading_rad_, 2.0 * M_PI);
      heading_rad_ += std::clamp(turn_rad, -kStepS * kTurnRadps, kStepS * kTurnRadps);
      p_WB_.head<2>() += kStepS * v_W_;
    }
    return decision;
  }
  const Eigen::Vector3d& p_WB() const { return p_WB_; }
  bool arrived() const { return (goal_W - p_WB_).norm() < 3.0; }

  Eigen::Vector3d goal_W{120.0, 0.0, -kHeightM};
  std::function<double(double t_s)> east_error_m = [](double) { return 0.0; };  ///< of the estimated position

 private:
  static constexpr double kTurnRadps = 0.8;

  cv::Mat seen() {
    Eigen::Isometry3d X_WB(Eigen::AngleAxisd(heading_rad_, Eigen::Vector3d::UnitZ()));
    X_WB.translation() = p_WB_;
    const Eigen::Isometry3d X_CW = (X_WB * camera_.X_BC).inverse();
    std::normal_distribution<double> noise_px(0.0, 0.5);
    cv::Mat corners_px(0, 1, CV_64FC2);
    for (const Eigen::Vector3d& corner_W : corners_W_) {
      const Eigen::Vector3d p_C = X_CW * corner_W;
      if (p_C.z() < 1.0) continue;
      const auto lens = camera_.model.pinhole();
      const Eigen::Vector2d pixel(lens.center_u_px + lens.focal_x_px * p_C.x() / p_C.z() + noise_px(random_),
                                  lens.center_v_px + lens.focal_y_px * p_C.y() / p_C.z() + noise_px(random_));
      if (pixel.minCoeff() >= 0.0 && pixel.maxCoeff() <= 319.0) corners_px.push_back(cv::Vec2d(pixel.x(), pixel.y()));
    }
    return corners_px;
  }

  std::vector<Eigen::Vector3d> corners_W_;
  std::unique_ptr<Module> module_;
  MountedCamera camera_;
  std::mt19937_64 random_{3};
  Eigen::Vector3d p_WB_{0.0, 0.0, -kHeightM};
  Eigen::Vector2d v_W_ = Eigen::Vector2d::Zero();
  double heading_rad_ = 0.0;
  int64_t t_ns_ = 0;
};

std::vector<Eigen::Vector3d> corners_of(const std::vector<Tower>& towers) {
  std::vector<Eigen::Vector3d> corners_W;
  for (const Tower& tower : towers) {
    for (int k = 0; k < 8; ++k) {
      corners_W.emplace_back(tower.box_W.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)));
    }
  }
  return corners_W;
}

TEST(LandmarkMapModule, PassesTowersWithItsClearanceAndReturnsToItsCourse) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> aside_m(-4.0, 4.0);
  const LandmarkMapModuleConfig config;
  for (int trial = 0; trial < 4; ++trial) {
    const Tower tower(55.0, aside_m(random), 5.0, 25.0);
    CornerFlight flight(corners_of({tower}));
    std::set<std::string> statuses;
    double least_m = std::numeric_limits<double>::infinity(), most_off_m = 0.0;
    for (int i = 0; i < 1200 && !flight.arrived(); ++i) {
      statuses.insert(flight.step().status);
      least_m = std::min(least_m, tower.box_W.exteriorDistance(flight.p_WB()));
      most_off_m = std::max(most_off_m, std::abs(flight.p_WB().y()));
    }
    EXPECT_TRUE(flight.arrived()) << trial;
    constexpr double kOfTheMapM = 1.0;
    EXPECT_GT(least_m, config.clearance_m + kVehicleRadiusM - kOfTheMapM) << trial;
    // Minimum effort: around the nearer side, and no farther than the assumed extent behind the corners requires.
    EXPECT_LT(most_off_m, 5.0 + config.clearance_m + kVehicleRadiusM + config.behind_m) << trial;
    EXPECT_LT(std::abs(flight.p_WB().y()), 1.0) << trial;
    EXPECT_TRUE(statuses.contains("avoid") && statuses.contains("rejoin") && statuses.contains("cruise")) << trial;
  }
}

TEST(LandmarkMapModule, FliesStraightPastLandmarksThatAreNoObstacles) {
  const std::vector<Eigen::Vector3d> low = {{50.0, -3.0, 0.0}, {50.0, 3.0, -2.0}, {55.0, 0.0, -1.0}};
  const std::vector<Eigen::Vector3d> far_aside = corners_of({Tower(50.0, 40.0, 5.0, 25.0)});
  for (const auto& corners_W : {std::vector<Eigen::Vector3d>{}, low, far_aside}) {
    CornerFlight flight(corners_W);
    for (int i = 0; i < 500; ++i) {
      ASSERT_EQ(flight.step().status, "cruise") << corners_W.size() << ' ' << flight.p_WB().x();
      ASSERT_LT(std::abs(flight.p_WB().y()), 1e-6) << corners_W.size();
    }
  }
}

TEST(LandmarkMapModule, TreatsASingleCornerAsTheEndOfAFacade) {
  constexpr double kHalfFaceM = 7.0, kOfTheMapM = 1.0;
  for (const double aside_m : {-3.0, 0.0, 3.0}) {
    CornerFlight flight({{50.0, aside_m, -20.0}});
    double least_m = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 1200 && !flight.arrived(); ++i) {
      flight.step();
      least_m = std::min(least_m, (flight.p_WB().head<2>() - Eigen::Vector2d(50.0, aside_m)).norm());
    }
    EXPECT_TRUE(flight.arrived()) << aside_m;
    EXPECT_GT(least_m, kHalfFaceM + LandmarkMapModuleConfig{}.clearance_m - kOfTheMapM) << aside_m;
  }
}

// The position wanders by 1.5 m in a minute. Of a first-order low pass with 20 s remains 1.5 m / sqrt(1 + (2 pi /
// 3)^2), after a start that adds up to 0.2 m.
TEST(LandmarkMapModule, FollowsTheVelocityMoreThanAWanderingPosition) {
  constexpr double kWanderM = 1.5, kStartM = 0.2;
  const auto max_off_m = [&](Law law) {
    LandmarkMapModuleConfig config;
    config.law = law;
    CornerFlight flight({}, config);
    flight.east_error_m = [&](double t_s) { return kWanderM * std::sin(2.0 * M_PI * t_s / 60.0); };
    double max_m = 0.0;
    for (int i = 0; i < 600 && !flight.arrived(); ++i) {
      flight.step();
      max_m = std::max(max_m, std::abs(flight.p_WB().y()));
    }
    return max_m;
  };
  EXPECT_LT(max_off_m(Law::modified), kWanderM / std::hypot(1.0, 2.0 * M_PI / 3.0) + kStartM);
  EXPECT_GT(max_off_m(Law::published), 0.8 * kWanderM);
}

TEST(LandmarkMapModule, StopsPermanentlyAfterSixSuccessiveRangeAlarms) {
  // The stop includes 0.5 s of reaction and the braking distance.
  const double stops_m = kStopRangeM + kReactionS * kSpeedMps + 0.5 * kSpeedMps * kSpeedMps / kBrakingMps2;
  CornerFlight flight({});
  flight.step();
  for (int i = 0; i < 50; ++i) EXPECT_NE(flight.step(stops_m + 0.1).status, "stop");
  for (int i = 0; i < 5; ++i) EXPECT_NE(flight.step(stops_m - 0.1).status, "stop");
  EXPECT_NE(flight.step().status, "stop");
  for (int i = 0; i < 5; ++i) EXPECT_NE(flight.step(stops_m - 0.1).status, "stop");
  EXPECT_EQ(flight.step(stops_m - 0.1).status, "stop");
  const Decision after = flight.step();
  EXPECT_EQ(after.status, "stop");
  EXPECT_TRUE(std::holds_alternative<HoverCommand>(after.command));
}

TEST(LandmarkMapModule, ZeroClearanceMapsAndFliesStraight) {
  const Tower tower(55.0, 2.0, 5.0, 25.0);
  LandmarkMapModuleConfig config;
  config.clearance_m = 0.0;
  CornerFlight flight(corners_of({tower}), config);
  double landmarks = 0.0;
  for (int i = 0; i < 300; ++i) {
    const Decision decision = flight.step();
    ASSERT_EQ(decision.status, "cruise") << flight.p_WB().x();
    landmarks = std::max(landmarks, decision.signals.at(1));
  }
  EXPECT_GE(landmarks, 4.0);
}

// The thesis leaves avoidance and stopping to future work.
TEST(LandmarkMapModule, PublishedLawNeitherAvoidsNorStops) {
  LandmarkMapModuleConfig config;
  config.law = Law::published;
  CornerFlight flight(corners_of({Tower(55.0, 2.0, 5.0, 25.0)}), config);
  for (int i = 0; i < 300; ++i) ASSERT_EQ(flight.step(0.5).status, "cruise") << flight.p_WB().x();
}

TEST(LandmarkMapModule, RejectsABadConfigAndNamesTheKey) {
  LandmarkMapModuleConfig config;
  config.observer.map.pixel_sigma_px = 0.0;
  try {
    make_landmark_map(config);
    FAIL();
  } catch (const std::invalid_argument& fault) {
    EXPECT_EQ(std::string(fault.what()), "map.pixel_sigma: must be > 0 px, got 0");
  }
}

}  // namespace
}  // namespace hedgehop::avoidance::landmark_map
