#include "sim/loop/imperfections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hedgehop::sim {
namespace {

constexpr double kPeriodS = 0.02;

cv::Mat flat(double level, int type = CV_8UC1, int size = 400) { return {size, size, type, cv::Scalar::all(level)}; }

double mean_of(const cv::Mat& image) { return cv::mean(image)[0]; }

double variance_of(const cv::Mat& image) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  return deviation[0] * deviation[0];
}

TEST(Imperfections, OffByDefaultNoPixelChanges) {
  Imperfections camera({}, kPeriodS, 1);
  cv::Mat image(50, 60, CV_8UC3);
  cv::randu(image, 0, 256);
  const cv::Mat before = image.clone();
  camera.apply(3, image);
  EXPECT_EQ(cv::norm(image, before, cv::NORM_INF), 0.0);
  for (int64_t frame = 0; frame < 1000; ++frame) EXPECT_EQ(camera.frame_fault(frame), Imperfections::FrameFault::none);
}

// Poisson: the variance of the electrons is their mean, so in levels it is mean * 255 / full well; rounding adds 1/12.
TEST(Imperfections, PhotonNoiseHasPoissonsVariance) {
  ImperfectionsConfig config;
  config.full_well = 5000.0;
  Imperfections camera(config, kPeriodS, 7);
  for (const double level : {20.0, 60.0, 120.0, 200.0}) {
    cv::Mat image = flat(level);
    camera.apply(static_cast<int64_t>(level), image);
    const double expected = level * 255.0 / config.full_well + 1.0 / 12.0;
    const double kSampling = 4.0 * expected * std::sqrt(2.0 / 160000.0);  // four standard errors of a variance
    EXPECT_NEAR(variance_of(image), expected, kSampling) << level;
    EXPECT_NEAR(mean_of(image), level, 4.0 * std::sqrt(expected / 160000.0)) << level;
  }
}

TEST(Imperfections, ReadNoiseAddsToPhotonNoiseInVariance) {
  ImperfectionsConfig config;
  config.full_well = 10000.0;
  config.read_noise = 2.0;
  Imperfections camera(config, kPeriodS, 8);
  cv::Mat image = flat(100.0);
  camera.apply(0, image);
  const double expected = 100.0 * 255.0 / 10000.0 + 4.0 + 1.0 / 12.0;
  EXPECT_NEAR(variance_of(image), expected, 4.0 * expected * std::sqrt(2.0 / 160000.0));
}

// Rounding adds 1/12 to the variance of the pattern, and the same pattern again of another image.
TEST(Imperfections, TheFixedPatternStaysAndScalesWithTheLight) {
  ImperfectionsConfig config;
  config.fixed_pattern = 0.05;
  Imperfections camera(config, kPeriodS, 9), other(config, kPeriodS, 10);
  cv::Mat bright = flat(200.0), again = flat(200.0), dim = flat(50.0), elsewhere = flat(200.0);
  camera.apply(0, bright);
  camera.apply(8, again);
  camera.apply(3, dim);
  other.apply(0, elsewhere);
  EXPECT_EQ(cv::norm(bright, again, cv::NORM_INF), 0.0);
  for (const auto& [image, level] : {std::pair(bright, 200.0), std::pair(dim, 50.0)}) {
    const double expected = std::pow(0.05 * level, 2) + 1.0 / 12.0;
    EXPECT_NEAR(variance_of(image), expected, 4.0 * expected * std::sqrt(2.0 / 160000.0)) << level;
    EXPECT_NEAR(mean_of(image), level, 4.0 * std::sqrt(expected / 160000.0)) << level;
  }
  cv::Mat difference;
  cv::subtract(bright, elsewhere, difference, cv::noArray(), CV_32F);
  EXPECT_NEAR(variance_of(difference), 2.0 * variance_of(bright), 0.02 * variance_of(bright));  // unrelated
}

TEST(Imperfections, ExposureMultipliesLightAndSaturates) {
  ImperfectionsConfig config;
  config.exposure_stops = 1.0;
  Imperfections camera(config, kPeriodS, 1);
  cv::Mat dim = flat(60.0), bright = flat(200.0);
  camera.apply(0, dim);
  camera.apply(1, bright);
  EXPECT_EQ(mean_of(dim), 120.0);
  EXPECT_EQ(mean_of(bright), 255.0);
}

TEST(Imperfections, VignettingTakesItsShareInTheCornersAndZeroInTheMiddle) {
  ImperfectionsConfig config;
  config.vignetting = 0.4;
  Imperfections camera(config, kPeriodS, 1);
  cv::Mat image = flat(200.0, CV_8UC3, 401);
  camera.apply(0, image);
  EXPECT_EQ(image.at<cv::Vec3b>(200, 200), cv::Vec3b(200, 200, 200));
  EXPECT_EQ(image.at<cv::Vec3b>(0, 0), cv::Vec3b(120, 120, 120));
  EXPECT_EQ(image.at<cv::Vec3b>(400, 0), cv::Vec3b(120, 120, 120));
  EXPECT_EQ(image.at<cv::Vec3b>(200, 0), cv::Vec3b(160, 160, 160));  // half the corner's distance squared
}

// First order in the logarithm: after one time constant the way to mid-grey is done but for 1/e.
TEST(Imperfections, AutomaticExposureSettlesToMidGreyInItsTimeConstant) {
  ImperfectionsConfig config;
  config.auto_exposure_s = 0.2;
  Imperfections camera(config, kPeriodS, 1);
  cv::Mat image;
  for (int frame = 0; frame < 10; ++frame) {
    image = flat(40.0);
    camera.expose(image);
    camera.apply(frame, image);
  }
  EXPECT_NEAR(mean_of(image), 127.5 * std::pow(40.0 / 127.5, std::exp(-1.0)), 0.5 + 1e-6);  // rounding to levels
  for (int frame = 10; frame < 200; ++frame) {
    image = flat(40.0);
    camera.expose(image);
    camera.apply(frame, image);
  }
  EXPECT_NEAR(mean_of(image), 127.5, 0.5 + 1e-6);
}

TEST(Imperfections, ObserversDoNotAdvanceTheExposure) {
  ImperfectionsConfig config;
  config.auto_exposure_s = 0.2;
  Imperfections watched(config, kPeriodS, 1), alone(config, kPeriodS, 1);
  cv::Mat a, b;
  for (int frame = 0; frame < 10; ++frame) {
    a = flat(40.0), b = flat(40.0);
    for (int look = 0; look < 3; ++look) {
      cv::Mat seen = flat(200.0);
      watched.apply(frame, seen);
    }
    watched.expose(a), watched.apply(frame, a);
    alone.expose(b), alone.apply(frame, b);
  }
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0.0);
}

TEST(Imperfections, EqualSeedsGiveEqualNoiseAndEveryImageItsOwn) {
  ImperfectionsConfig config;
  config.read_noise = 3.0;
  Imperfections one(config, kPeriodS, 5), same(config, kPeriodS, 5), other(config, kPeriodS, 6);
  cv::Mat a = flat(100.0), b = flat(100.0), c = flat(100.0), d = flat(100.0);
  one.apply(4, a);
  same.apply(3, d);
  same.apply(4, b);
  other.apply(4, c);
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(a, c, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(a, d, cv::NORM_INF), 0.0);
}

TEST(Imperfections, DisparityNoiseScattersDepthWithItsSquare) {
  ImperfectionsConfig config;
  config.disparity_noise_px = 0.25;
  constexpr double kFocalPx = 200.0;
  const auto spread_m = [&](double z_m) {
    Imperfections camera(config, kPeriodS, 3, kFocalPx);
    cv::Mat depth_m(200, 200, CV_32FC1, cv::Scalar(z_m));
    camera.apply(1, depth_m);
    cv::Scalar mean, spread;
    cv::meanStdDev(depth_m, mean, spread);
    return spread[0];
  };
  // dz = z^2 / (f b) d(disparity), to first order.
  const double kSampling = 0.03;
  EXPECT_NEAR(spread_m(2.0) / (4.0 / (kFocalPx * 0.3) * 0.25), 1.0, kSampling);
  EXPECT_NEAR(spread_m(4.0) / (16.0 / (kFocalPx * 0.3) * 0.25), 1.0, kSampling);
}

TEST(Imperfections, DisparityNoiseLeavesTheUnknownUnknownAndTheSkyFar) {
  ImperfectionsConfig config;
  config.disparity_noise_px = 1.0;
  Imperfections camera(config, kPeriodS, 3, 200.0);
  cv::Mat depth_m(100, 100, CV_32FC1, cv::Scalar(std::numeric_limits<double>::infinity()));
  depth_m.rowRange(0, 10).setTo(std::numeric_limits<double>::quiet_NaN());
  camera.apply(1, depth_m);
  EXPECT_TRUE(std::isnan(depth_m.at<float>(5, 5)));
  const cv::Mat sky = depth_m.rowRange(10, 100);
  const int infinite = cv::countNonZero(sky == std::numeric_limits<float>::infinity());
  EXPECT_NEAR(infinite / 9000.0, 0.5, 0.03);  // noise below 0
  EXPECT_EQ(cv::countNonZero(sky > 0.0F), 9000);
}

TEST(Imperfections, FrameFaultsComeAsOftenAsRequired) {
  ImperfectionsConfig config;
  config.drop = 0.1;
  config.freeze = 0.2;
  config.black = 0.05;
  const Imperfections camera(config, kPeriodS, 11);
  constexpr int kImages = 100000;
  std::array<double, 4> share{};
  for (int64_t image = 0; image < kImages; ++image) {
    share[static_cast<size_t>(camera.frame_fault(image))] += 1.0 / kImages;
  }
  const double kSampling = 4.0 * std::sqrt(0.25 / kImages);
  EXPECT_NEAR(share[1], 0.1, kSampling);
  EXPECT_NEAR(share[2], 0.9 * 0.2, kSampling);
  EXPECT_NEAR(share[3], 0.9 * 0.8 * 0.05, kSampling);
}

}  // namespace
}  // namespace hedgehop::sim
