#include "sim/loop/cameras.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "scenes/worlds/highrise.h"
#include "sim/config/input_error.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// North of the cube, 30 m up, looking south and 30 degrees down.
Eigen::Isometry3d looking_south() {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
  X_WC.linear() << 0, s, -c, -1, 0, 0, 0, c, s;
  X_WC.translation() = Vector3d(50, 0, -38);
  return X_WC;
}

const vision::camera::Camera kCamera = vision::camera::PinholeCamera::from_fov(640, 640, std::numbers::pi / 3.0);

TEST(CornerDetector, ScattersByItsNoiseAroundTheProjections) {
  const std::vector<Vector3d> corners =
      scenes::worlds::highrise_corners({.layout = scenes::worlds::HighriseConfig::Layout::cube}, 1);
  const Eigen::Isometry3d X_WC = looking_south();
  constexpr double kNoisePx = 0.8;
  CornerDetector detector(corners, kNoisePx, 11);
  constexpr int kFrames = 500;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero(), squares = Eigen::Vector2d::Zero();
  for (int i = 0; i < kFrames; ++i) {
    const cv::Mat detected = detector.detect(kCamera, X_WC);
    ASSERT_EQ(detected.type(), CV_64FC2);
    ASSERT_EQ(detected.size(), cv::Size(1, static_cast<int>(corners.size())));
    for (size_t k = 0; k < corners.size(); ++k) {
      const auto& pixel = detected.at<cv::Vec2d>(static_cast<int>(k));
      const Eigen::Vector2d off = Eigen::Vector2d(pixel[0], pixel[1]) - *kCamera.project(X_WC.inverse() * corners[k]);
      sum += off;
      squares += off.cwiseAbs2();
    }
  }
  const double count = static_cast<double>(kFrames * corners.size());
  const double kFiveSigmasPx = 5.0 * kNoisePx / std::sqrt(count);
  EXPECT_LT((sum / count).cwiseAbs().maxCoeff(), kFiveSigmasPx);
  EXPECT_NEAR(std::sqrt(squares.x() / count), kNoisePx, 0.05);
  EXPECT_NEAR(std::sqrt(squares.y() / count), kNoisePx, 0.05);
}

TEST(CornerDetector, ReportsNoCornersOutsideTheImage) {
  CornerDetector detector({{200, 0, 0}, {40, 100, -38}}, 0.5, 1);
  const cv::Mat detected = detector.detect(kCamera, looking_south());
  EXPECT_EQ(detected.rows, 0);
  EXPECT_EQ(detected.type(), CV_64FC2);
}

Scenario from_corners(const std::string& name, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {"duration=8", "film.enabled=false", "drawing.renderer=tiles",
                                        "avoidance.source=corners", "rig.cameras.0.channel=corners"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return load_scenario(HEDGEHOP_SOURCE_DIR "/configs/" + name, overrides);
}

double metric(const Flight& flight, const std::string& name) {
  const auto found = std::ranges::find(flight.result.metrics, name, &MetricValue::name);
  return found == flight.result.metrics.end() ? std::nan("") : found->value;
}

TEST(ProjectedCorners, GiveAMapOfAllTheCubeAndTheResultListsThem) {
  const Flight flight = Simulation(from_corners("shah2009_cube_lateral.yaml")).run();
  EXPECT_EQ(metric(flight, "module.landmarks"), 8.0);  // those that walls hide, too
  EXPECT_THAT(flight.result.truth_used, ElementsAre("camera 'front': projected corners"));
  EXPECT_EQ(flight.decisions.back().signals.at(0), 8.0) << flight.signals.at(0).name;
}

TEST(ProjectedCorners, OfADeadDetectorAreNone) {
  const Flight flight =
      Simulation(from_corners("shah2009_cube_lateral.yaml", {"duration=1", "rig.cameras.0.imperfections.black=1"}))
          .run();
  EXPECT_NE(flight.result.outcome, Outcome::fault) << flight.result.cause;
  EXPECT_EQ(flight.decisions.back().signals.at(0), 0.0);
}

TEST(ProjectedCorners, OfASceneWithoutKnownCornersAreRefused) {
  try {
    Simulation(from_corners("shah2009_wall_textured.yaml")).run();
    FAIL();
  } catch (const InputError& fault) {
    EXPECT_THAT(
        fault.what(),
        HasSubstr("'rig.cameras.0.channel': camera 'front' delivers corners, but scene 'wall' has no known corners"));
  }
}

TEST(TruthUsed, IsEmptyForAFlightWithImages) {
  const std::vector<std::string> overrides = {"duration=0.1", "film.enabled=false", "drawing.renderer=tiles"};
  const Scenario scenario = load_scenario(HEDGEHOP_SOURCE_DIR "/configs/shah2009_cube_lateral.yaml", overrides);
  EXPECT_TRUE(Simulation(scenario).run().result.truth_used.empty());
}

}  // namespace
}  // namespace hedgehop::sim
