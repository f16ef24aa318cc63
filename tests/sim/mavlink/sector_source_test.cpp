#include "sim/mavlink/sector_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace hedgehop::sim::mavlink {
namespace {

using avoidance::CameraNeed;

avoidance::MountedCamera forward_at(const std::string& role, double right_m) {
  avoidance::MountedCamera camera{.role = role, .rate_hz = 12.5};
  camera.model = vision::camera::PinholeCamera{640, 360, 350.0, 350.0, 319.5, 179.5};
  camera.X_BC.linear() << 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  camera.X_BC.translation() = Eigen::Vector3d(0.0, right_m, 0.0);
  return camera;
}

avoidance::Needs grey_pair(const std::string& left, const std::string& right) {
  return {{{left, CameraNeed::Channel::grey}, {right, CameraNeed::Channel::grey}}};
}

/// A textured wall across the view: the right image is the left one, moved by its disparity.
TEST(SectorSource, FindsTheRangeOfAWallFromAStereoPair) {
  constexpr double kBaselineM = 0.25;
  constexpr int kDisparityPx = 12;
  avoidance::Setup setup;
  setup.cameras = {forward_at("left", 0.0), forward_at("right", kBaselineM)};
  auto sources = sector_sources({}, grey_pair("left", "right"), setup, {});
  ASSERT_EQ(sources.size(), 1u);

  cv::Mat texture(360, 640 + kDisparityPx, CV_8UC1);
  cv::RNG random(7);
  random.fill(texture, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(texture, texture, {}, 2.0);
  cv::normalize(texture, texture, 0, 255, cv::NORM_MINMAX);
  const cv::Mat left = texture.colRange(0, 640), right = texture.colRange(kDisparityPx, 640 + kDisparityPx);
  const std::vector<avoidance::CameraFrame> frames = {{"left", 1, left}, {"right", 1, right}};
  sources[0].update(1, {.t_ns = 1, .frames = frames});

  const ObstacleSectors* const sectors = sources[0].sectors(1);
  ASSERT_TRUE(sectors);
  const double expected_m = 350.0 * kBaselineM / kDisparityPx;
  constexpr double kSubpixel = 0.05;
  EXPECT_NEAR(sectors->at(0).nearest_m, expected_m, kSubpixel * expected_m);
  EXPECT_NEAR(sectors->at(3).nearest_m, expected_m / std::cos(15.0 * std::numbers::pi / 180.0),
              2.0 * kSubpixel * expected_m);
  EXPECT_FALSE(sectors->at(20).seen);
  EXPECT_FALSE(sources[0].sectors(600'000'000)) << "half a second later";
}

/// A smooth brightness with the noise of two sensors, as of sky or haze: a matcher that fills in finds surfaces in it.
TEST(SectorSource, NoiseOfAPlainSkyIsNoObstacle) {
  avoidance::Setup setup;
  setup.cameras = {forward_at("left", 0.0), forward_at("right", 0.25)};
  auto sources = sector_sources({}, grey_pair("left", "right"), setup, {});
  cv::RNG random(3);
  int obstacles = 0;
  for (int64_t i = 0; i < 10; ++i) {
    cv::Mat left(360, 640, CV_8UC1), right(360, 640, CV_8UC1);
    random.fill(left, cv::RNG::NORMAL, 180, 2);
    random.fill(right, cv::RNG::NORMAL, 180, 2);
    const int64_t t_ns = i * SectorSource::kPeriodNs;
    const std::vector<avoidance::CameraFrame> frames = {{"left", t_ns, left}, {"right", t_ns, right}};
    sources.at(0).update(t_ns, {.t_ns = t_ns, .frames = frames});
    const ObstacleSectors* const sectors = sources[0].sectors(t_ns);
    ASSERT_TRUE(sectors);
    for (int k = 0; k < ObstacleSectors::kCount; ++k) obstacles += std::isfinite(sectors->at(k).nearest_m) ? 1 : 0;
  }
  EXPECT_EQ(obstacles, 0);
}

TEST(SectorSource, TakesPairsWithPrefixesAndNoSideCameras) {
  avoidance::Setup setup;
  setup.cameras = {forward_at("aft_left", 0.0), forward_at("aft_right", 0.25)};
  EXPECT_EQ(sector_sources({}, grey_pair("aft_left", "aft_right"), setup, {}).size(), 1u);
  setup.cameras = {forward_at("left", 0.0), forward_at("right", 0.0)};
  setup.cameras[1].X_BC.linear() = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()) * setup.cameras[1].X_BC.linear();
  EXPECT_TRUE(sector_sources({}, grey_pair("left", "right"), setup, {}).empty());
  EXPECT_TRUE(sector_sources({}, {{{"left", CameraNeed::Channel::grey}}}, setup, {}).empty());
}

TEST(SectorSource, UsesTenImagesPerSecond) {
  avoidance::Setup setup;
  setup.cameras = {forward_at("depth", 0.0)};
  auto sources = sector_sources({}, {{{"depth", CameraNeed::Channel::depth}}}, setup, {});
  const auto see = [&](int64_t t_ms, double depth_m) {
    const std::vector<avoidance::CameraFrame> frames = {
        {"depth", t_ms, cv::Mat(360, 640, CV_32FC1, cv::Scalar(depth_m))}};
    sources.at(0).update(t_ms * 1'000'000, {.t_ns = t_ms, .frames = frames});
    return sources[0].sectors(t_ms * 1'000'000)->at(0).nearest_m;
  };
  EXPECT_NEAR(see(0, 5.0), 5.0, 0.01);
  EXPECT_NEAR(see(50, 4.0), 5.0, 0.01);
  EXPECT_NEAR(see(100, 3.0), 3.0, 0.01);
}

}  // namespace
}  // namespace hedgehop::sim::mavlink
