#include "vision/stereo/stereo_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/vision/real_data.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {
namespace {

using Method = StereoMatcherConfig::Method;

cv::Mat texture(uint64_t seed, cv::Size size) {
  cv::Mat fine(size, CV_8UC1), coarse(size / 4, CV_8UC1);
  cv::RNG random(seed);
  random.fill(fine, cv::RNG::UNIFORM, 0, 256);
  random.fill(coarse, cv::RNG::UNIFORM, 0, 256);
  cv::resize(coarse, coarse, size, 0, 0, cv::INTER_CUBIC);
  cv::Mat both = 0.5 * fine + 0.5 * coarse;
  cv::GaussianBlur(both, both, {}, 0.8);
  return both;
}

/// Returns the right image of a wall at a fractional disparity.
cv::Mat seen_from_the_right(const cv::Mat& left, double disparity_px) {
  cv::Mat right;
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, -disparity_px, 0, 1, 0);
  cv::warpAffine(left, right, shift, left.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  return right;
}

TEST(StereoMatcher, AWallsDisparityIsFoundToAFifthOfAPixel) {
  const cv::Mat left = texture(1, {320, 240});
  for (const Method method : {Method::block, Method::semi_global}) {
    StereoMatcherConfig config;
    config.method = method;
    config.block_px = 9;
    StereoMatcher matcher(config);
    for (const double truth_px : {3.0, 10.25, 24.5}) {
      cv::Mat d16;
      matcher.match(left, seen_from_the_right(left, truth_px), d16);
      const cv::Mat inner = d16(cv::Rect(80, 20, 220, 200));
      EXPECT_GT(cv::countNonZero(inner >= 0), 0.95 * static_cast<double>(inner.total()));
      const double kPixelLocking = 0.2;  // OpenCV's parabola is biased toward whole pixels
      EXPECT_NEAR(cv::mean(inner, inner >= 0)[0] / kDisparityUnits, truth_px, kPixelLocking);
    }
  }
}

// OpenCV itself computes no disparities for the 64 left columns.
TEST(StereoMatcher, MatchesAllColumnsInViewOfTheRightCamera) {
  const int kWallPx = 12;
  const cv::Mat left = texture(4, {320, 240}), right = seen_from_the_right(left, kWallPx);
  for (const Method method : {Method::block, Method::semi_global}) {
    StereoMatcherConfig config;
    config.method = method;
    config.block_px = 9;
    cv::Mat d16;
    StereoMatcher(config).match(left, right, d16);
    const cv::Mat seen = d16(cv::Rect(kWallPx + config.block_px, 20, config.disparities_px, 200));
    EXPECT_GT(cv::countNonZero(cv::abs(seen - kDisparityUnits * kWallPx) < 4),
              0.95 * static_cast<double>(seen.total()));
    for (int u = 0; u < kWallPx; ++u) {
      double largest = 0.0;
      cv::minMaxLoc(d16.col(u), nullptr, &largest);
      EXPECT_LE(largest, kDisparityUnits * u) << "matched outside the right image";
    }
  }
}

TEST(StereoMatcher, EqualPairsGiveEqualDisparities) {
  const cv::Mat left = texture(2, {160, 120}), right = seen_from_the_right(left, 7.3);
  StereoMatcher one({}), other({});
  cv::Mat a, b;
  one.match(texture(3, {160, 120}), left, a);
  one.match(left, right, a);
  other.match(left, right, b);
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0.0);
}

TEST(StereoMatcher, RejectsConfigsThatOpenCvRejects) {
  StereoMatcherConfig odd;
  odd.disparities_px = 40;
  EXPECT_THROW(StereoMatcher{odd}, std::invalid_argument);
  StereoMatcherConfig even;
  even.block_px = 8;
  EXPECT_THROW(StereoMatcher{even}, std::invalid_argument);
  StereoMatcher matcher({});
  cv::Mat d16;
  EXPECT_THROW(matcher.match(cv::Mat(8, 8, CV_8UC3), cv::Mat(8, 8, CV_8UC3), d16), std::invalid_argument);
}

/// The image pair described in tests/vision/images/README.md.
struct DrawnPair {
  cv::Mat left, right, truth_px;  ///< truth 0 for surfaces that are not visible to the right camera

  DrawnPair() {
    const std::filesystem::path folder = HEDGEHOP_SOURCE_DIR "/tests/vision/images";
    left = cv::imread((folder / "left.png").string(), cv::IMREAD_GRAYSCALE);
    right = cv::imread((folder / "right.png").string(), cv::IMREAD_GRAYSCALE);
    const cv::Mat depth_mm = cv::imread((folder / "left_depth_mm.png").string(), cv::IMREAD_UNCHANGED);
    constexpr double kBaselineMm = 200.0, kFocalPx = 140.0;
    truth_px = cv::Mat(depth_mm.size(), CV_32F, cv::Scalar(0));
    for (int v = 0; v < depth_mm.rows; ++v) {
      // From right to left: closer surfaces farther right cover columns of the right image first.
      double covered_u = depth_mm.cols;
      for (int u = depth_mm.cols - 1; u >= 0; --u) {
        const double d_px = kBaselineMm * kFocalPx / depth_mm.at<uint16_t>(v, u), right_u = u - d_px;
        if (right_u >= 0.0 && right_u < covered_u) truth_px.at<float>(v, u) = static_cast<float>(d_px);
        covered_u = std::min(covered_u, right_u);
      }
    }
  }
};

// The limits are 1.5 times the errors of both methods, as for the real pairs below.
TEST(StereoMatcher, MatchesMostOfASyntheticNoisyPairCorrectly) {
  const DrawnPair pair;
  ASSERT_EQ(pair.left.size(), cv::Size(160, 120));
  ASSERT_EQ(pair.right.size(), pair.truth_px.size());
  const double known = cv::countNonZero(pair.truth_px > 0);
  ASSERT_GT(known, 0.85 * static_cast<double>(pair.truth_px.total()));
  for (const Method method : {Method::block, Method::semi_global}) {
    StereoMatcherConfig config{.method = method, .disparities_px = 32};
    if (method == Method::block) config.block_px = 9;
    cv::Mat d16, found_px;
    StereoMatcher(config).match(pair.left, pair.right, d16);
    d16.convertTo(found_px, CV_32F, 1.0 / kDisparityUnits);
    const cv::Mat valid = (d16 >= 0) & (pair.truth_px > 0);
    const cv::Mat wrong = valid & (cv::abs(found_px - pair.truth_px) > 1.0);
    RecordProperty(method == Method::block ? "block_valid" : "semi_global_valid",
                   std::to_string(cv::countNonZero(valid) / known));
    RecordProperty(method == Method::block ? "block_wrong" : "semi_global_wrong",
                   std::to_string(cv::countNonZero(wrong) / known));
    EXPECT_GT(cv::countNonZero(valid), 0.8 * known);
    EXPECT_LT(cv::countNonZero(wrong), 0.045 * known);
  }
}

struct Pair {
  std::string name, truth;
  double scale;
  int disparities_px;
  double worst_bad_share;  ///< of known pixels that are matched and off by more than 2 px
  friend std::ostream& operator<<(std::ostream& out, const Pair& pair) { return out << pair.name; }
};

class StereoOnRealPairs : public testing::TestWithParam<Pair> {};

// The limits are 1.5 times the errors of the semi-global matcher, to detect regressions.
TEST_P(StereoOnRealPairs, FewPixelsAreOffByMoreThanTwo) {
  const std::filesystem::path folder = kRealData / "stereo" / GetParam().name;
  HEDGEHOP_NEEDS_REAL_DATA(folder);
  const cv::Mat left = cv::imread((folder / "left.png").string(), cv::IMREAD_GRAYSCALE);
  const cv::Mat right = cv::imread((folder / "right.png").string(), cv::IMREAD_GRAYSCALE);
  cv::Mat truth_px, known;
  cv::imread((folder / GetParam().truth).string(), cv::IMREAD_UNCHANGED)
      .convertTo(truth_px, CV_32F, 1.0 / GetParam().scale);
  known = truth_px > 0;
  if (std::filesystem::exists(folder / "nonocc.png")) {
    known &= cv::imread((folder / "nonocc.png").string(), cv::IMREAD_GRAYSCALE) > 0;
  }
  StereoMatcherConfig config;
  config.disparities_px = GetParam().disparities_px;
  StereoMatcher matcher(config);
  const auto shares = [&](int smallest_speck_px) {
    cv::Mat d16, found_px;
    matcher.match(left, right, d16);
    remove_specks(d16, 32, smallest_speck_px);
    d16.convertTo(found_px, CV_32F, 1.0 / kDisparityUnits);
    const cv::Mat valid = (d16 >= 0) & known, bad = valid & (cv::abs(found_px - truth_px) > 2.0);
    const double total = cv::countNonZero(known);
    return std::pair(cv::countNonZero(valid) / total, cv::countNonZero(bad) / total);
  };
  const auto [valid_raw, bad_raw] = shares(0);
  const auto [valid, bad] = shares(200);
  RecordProperty("valid", std::to_string(valid_raw));
  RecordProperty("bad", std::to_string(bad_raw));
  RecordProperty("valid_without_specks", std::to_string(valid));
  RecordProperty("bad_without_specks", std::to_string(bad));
  EXPECT_LT(bad, GetParam().worst_bad_share);
  EXPECT_LE(bad, bad_raw);
  EXPECT_GT(valid, 0.6);
}

INSTANTIATE_TEST_SUITE_P(Pairs, StereoOnRealPairs,
                         testing::Values(Pair{"teddy", "gt.png", 4.0, 64, 0.1}, Pair{"venus", "gt.pgm", 8.0, 32, 0.1},
                                         Pair{"kitti_000001", "gt.png", 256.0, 128, 0.15}),
                         [](const auto& pair) { return pair.param.name; });

}  // namespace
}  // namespace hedgehop::vision::stereo
