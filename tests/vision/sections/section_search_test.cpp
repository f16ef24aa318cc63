#include "vision/sections/section_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

namespace hedgehop::vision::sections {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kThresholdM = 9.144;  // [Perez2018] sec. V-C: 30 ft
const cv::Size kZed(1280, 720);

cv::Mat random_depth(std::mt19937_64& random, cv::Size size, double unknown_share) {
  std::uniform_real_distribution<float> depth_m(1.0f, 20.0f), chance(0.0f, 1.0f);
  cv::Mat depth(size, CV_32F);
  // Random blocks, so that sections differ.
  const int block = 16;
  for (int v = 0; v < size.height; v += block) {
    for (int u = 0; u < size.width; u += block) {
      const cv::Rect area = cv::Rect(u, v, block, block) & cv::Rect({}, size);
      depth(area).setTo(chance(random) < unknown_share ? kNaN : depth_m(random));
    }
  }
  return depth;
}

int count_threats(const cv::Mat& depth, const cv::Rect& section, bool unknown_is_threat) {
  int threats = 0;
  for (int v = section.y; v < section.y + section.height; ++v) {
    for (int u = section.x; u < section.x + section.width; ++u) {
      const float z_m = depth.at<float>(v, u);
      threats += std::isnan(z_m) ? unknown_is_threat : z_m < kThresholdM;
    }
  }
  return threats;
}

TEST(Sections, ThePapersGridHas289OfThemFromEdgeToEdge) {
  const std::vector<cv::Rect> found = sections({}, kZed);
  ASSERT_EQ(found.size(), 289u);
  EXPECT_EQ(found.front(), cv::Rect(0, 0, 628, 252));
  EXPECT_EQ(found.back(), cv::Rect(1280 - 628, 720 - 252, 628, 252));
  EXPECT_EQ(found[16], cv::Rect(1280 - 628, 0, 628, 252));                       // end of the first row
  EXPECT_EQ(found[17], cv::Rect(0, 29, 628, 252));                               // a step of 29.25 px down
  EXPECT_EQ(found[1].x, 41);                                                     // a step of 40.75 px to the right
  EXPECT_EQ(found[144], cv::Rect((1280 - 628) / 2, (720 - 252) / 2, 628, 252));  // the center
}

TEST(Sections, ThreeByThreeWithoutOverlapTileTheImage) {
  const std::vector<cv::Rect> found = sections({3, 3, 1.0 / 3.0, 1.0 / 3.0}, {1281, 720});
  cv::Mat covered(720, 1281, CV_8U, cv::Scalar(0));
  for (const cv::Rect& section : found) covered(section) += 1;
  EXPECT_EQ(cv::countNonZero(covered == 1), 720 * 1281);
}

TEST(Sections, RejectInvalidGrids) {
  EXPECT_THROW(sections({0, 17}, kZed), std::invalid_argument);
  EXPECT_THROW(sections({17, 17, 1.2, 0.5}, kZed), std::invalid_argument);
  EXPECT_THROW(sections({17, 17, 0.001, 0.5}, {100, 100}), std::invalid_argument);
}

TEST(SectionSearch, EqualsAPixelByPixelCount) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const cv::Size size(160 + trial, 90 + 2 * trial);
    const SectionGrid grid{3 + trial % 5, 4 + trial % 7, 0.2 + 0.03 * trial, 0.5};
    SectionSearch search(grid, size);
    const cv::Mat depth = random_depth(random, size, 0.2);
    for (const UnknownDepth unknown : {UnknownDepth::free, UnknownDepth::threat}) {
      search.choose(depth, kThresholdM, 0.15, unknown);
      for (size_t i = 0; i < search.sections().size(); ++i) {
        EXPECT_EQ(search.threats()[i], count_threats(depth, search.sections()[i], unknown == UnknownDepth::threat));
      }
    }
  }
}

TEST(SectionSearch, TheEmptiestSectionWins) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const cv::Size size(320, 180);
    SectionSearch search({9, 9}, size);
    const cv::Mat depth = random_depth(random, size, 0.1);
    const SectionChoice choice = search.choose(depth, kThresholdM, 1.0, UnknownDepth::free);
    ASSERT_GE(choice.section, 0);
    for (const cv::Rect& section : search.sections()) {
      EXPECT_LE(choice.share * section.area(), count_threats(depth, section, false) + 1e-6);
    }
  }
}

TEST(SectionSearch, EqualSharesGoToTheCenter) {
  SectionSearch search({}, kZed);
  cv::Mat depth(kZed, CV_32F, cv::Scalar(20.0));
  EXPECT_EQ(search.choose(depth, kThresholdM, 0.15, UnknownDepth::free).section, 144);
  // A wall that fills all but the right fifth: of the sections in the last column, the one in the middle row.
  depth(cv::Rect(0, 0, 640, 720)).setTo(5.0);
  EXPECT_EQ(search.choose(depth, kThresholdM, 0.15, UnknownDepth::free).section, 8 * 17 + 16);
}

TEST(SectionSearch, IgnoresAnOpeningTooNarrowForFifteenPercent) {
  SectionSearch search({}, kZed);
  const int width = 628, height = 252, area = width * height;
  const auto wall_with = [&](int free_rows) {
    cv::Mat depth(kZed, CV_32F, cv::Scalar(5.0));
    depth(cv::Rect(0, 0, 1280, free_rows)).setTo(20.0);
    return depth;
  };
  const int just_enough = static_cast<int>(std::ceil(0.85 * height));
  const SectionChoice found = search.choose(wall_with(just_enough), kThresholdM, 0.15, UnknownDepth::free);
  EXPECT_EQ(found.section, 8);  // the top row's middle
  EXPECT_NEAR(found.share, double((height - just_enough) * width) / area, 1e-12);
  const SectionChoice missed = search.choose(wall_with(just_enough - 1), kThresholdM, 0.15, UnknownDepth::free);
  EXPECT_EQ(missed.section, -1);
  EXPECT_EQ(missed.best, 8);
  EXPECT_GT(missed.share, 0.15);
}

TEST(SectionSearch, DilatedThreatsAreSquares) {
  const cv::Size size(100, 60);
  SectionSearch search({.rows = 1, .cols = 1, .width_share = 1.0, .height_share = 1.0, .grow_px = 3}, size);
  cv::Mat depth(size, CV_32F, cv::Scalar(20.0));
  depth.at<float>(30, 50) = 5.0f;
  search.choose(depth, kThresholdM, 0.15, UnknownDepth::free);
  EXPECT_EQ(search.threats()[0], 7 * 7);
  depth.at<float>(0, 0) = 5.0f;  // cut off by the image's corner
  search.choose(depth, kThresholdM, 0.15, UnknownDepth::free);
  EXPECT_EQ(search.threats()[0], 7 * 7 + 4 * 4);
}

TEST(SectionSearch, NearestSectionHasTheGivenCenter) {
  SectionSearch search({}, kZed);
  for (int i = 0; i < 289; ++i) {
    const cv::Rect& s = search.sections()[static_cast<size_t>(i)];
    EXPECT_EQ(search.nearest({s.x + 0.5 * s.width, s.y + 0.5 * s.height}), i);
  }
  EXPECT_EQ(search.center(), 144);
  EXPECT_EQ(search.nearest({-500.0, -500.0}), 0);
}

// [Perez2018] fig. 16 and 17: overlapping sections find openings that large sections miss.
TEST(SectionSearch, AnOpeningAlongTheTopIsMissedByThreeByThreeAndFoundBySeventeen) {
  cv::Mat depth(kZed, CV_32F, cv::Scalar(5.0));
  depth(cv::Rect(350, 40, 640, 260)).setTo(20.0);  // below a lintel of 40 px, straddling the rows of thirds
  SectionSearch coarse({3, 3, 1.0 / 3.0, 1.0 / 3.0}, kZed), fine({}, kZed);
  EXPECT_EQ(coarse.choose(depth, kThresholdM, 0.15, UnknownDepth::free).section, -1);
  const SectionChoice found = fine.choose(depth, kThresholdM, 0.15, UnknownDepth::free);
  ASSERT_GE(found.section, 0);
  EXPECT_LT(found.section, 3 * 17);
}

// The reference sorts all sections and selects the first open one with few enough threats.
TEST(SectionSearch, ChoosesTheEmptiestOpenSectionOrAnyIfNoneIsOpen) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const cv::Size size(128, 72);
  int shut = 0, disregarded = 0;
  for (int trial = 0; trial < 200; ++trial) {
    SectionSearch search({.rows = 5, .cols = 5}, size);
    cv::Mat depth(size, CV_32F, cv::Scalar(20.0));
    depth(cv::Rect(0, 0, 1 + static_cast<int>(120 * uniform(random)), 72)).setTo(5.0);
    std::vector<bool> open;
    const double open_share = trial % 4 == 0 ? 0.0 : uniform(random);
    for (size_t i = 0; i < search.sections().size(); ++i) open.push_back(uniform(random) < open_share);
    const SectionChoice all = search.choose(depth, kThresholdM, 0.15, UnknownDepth::free);
    std::vector<std::tuple<int, double, int>> ranked;
    for (int i = 0; i < static_cast<int>(open.size()); ++i) {
      const cv::Rect& s = search.sections()[static_cast<size_t>(i)];
      const double du = s.x + 0.5 * s.width - 64.0, dv = s.y + 0.5 * s.height - 36.0;
      ranked.emplace_back(search.threats()[static_cast<size_t>(i)], du * du + dv * dv, i);
    }
    std::ranges::sort(ranked);
    const auto first = std::ranges::find_if(ranked, [&](const auto& r) {
      const auto i = static_cast<size_t>(std::get<2>(r));
      return open[i] && std::get<0>(r) <= 0.15 * search.sections()[i].area();
    });
    const SectionChoice found = search.choose(depth, kThresholdM, 0.15, UnknownDepth::free,
                                              [&](int i) { return bool(open[static_cast<size_t>(i)]); });
    if (first == ranked.end()) {
      ++disregarded;
      EXPECT_EQ(found.section, all.section);
    } else {
      shut += found.section != all.section;
      EXPECT_EQ(found.section, std::get<2>(*first));
    }
  }
  EXPECT_GT(shut, 20);
  EXPECT_GT(disregarded, 20);
}

TEST(SectionSearch, UnknownDepthIsFreeOrAThreatAsConfigured) {
  SectionSearch search({}, kZed);
  const cv::Mat depth(kZed, CV_32F, cv::Scalar::all(kNaN));
  EXPECT_EQ(search.choose(depth, kThresholdM, 0.15, UnknownDepth::free).section, 144);
  const SectionChoice blocked = search.choose(depth, kThresholdM, 0.15, UnknownDepth::threat);
  EXPECT_EQ(blocked.section, -1);
  EXPECT_EQ(blocked.share, 1.0);
}

TEST(SectionSearch, SkyIsFree) {
  SectionSearch search({}, kZed);
  const cv::Mat depth(kZed, CV_32F, cv::Scalar::all(std::numeric_limits<double>::infinity()));
  EXPECT_EQ(search.choose(depth, kThresholdM, 0.15, UnknownDepth::threat).section, 144);
}

}  // namespace
}  // namespace hedgehop::vision::sections
