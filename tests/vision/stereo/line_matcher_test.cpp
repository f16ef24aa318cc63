#include "vision/stereo/line_matcher.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/vision/stereo/surface_images.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {
namespace {

constexpr int kWidth = 320, kHeight = 160, kCell = LineMatcher::kCellPx;
constexpr double kBehindPx = 2.0, kLinePx = 6.3;  // disparities
constexpr int kBranchGrey = 50;

/// A line through a cell in the middle of the left image, in front of a surface at one disparity.
struct ThinScene {
  double angle_rad = 0.5 * std::numbers::pi;  ///< from the rows
  double thickness_px = 1.0;
  double texture = 25.0;  ///< standard deviation of the surface, grey levels
  bool has_line = true;
  uint64_t seed = 1;

  /// Distance of a point of the left image from the axis of the line, px.
  double off_px(double u, double v) const {
    return std::abs((u - 0.5 * (kWidth + kCell)) * std::sin(angle_rad) - (v - 0.5 * kHeight) * std::cos(angle_rad));
  }

  /// The image of a camera in which the surface and the line appear farther left, with noise.
  cv::Mat image(double behind_px, double line_px, uint64_t noise_seed) const {
    constexpr int kMargin = 64, kSamples = 4;
    const cv::Mat surface = textured_surface(seed, {kWidth + 2 * kMargin, kHeight}, 1.5, texture);
    const cv::Mat noise = camera_noise(noise_seed, {kWidth, kHeight});
    cv::Mat image(kHeight, kWidth, CV_8UC1);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const double at = u + kMargin + behind_px;
        const auto first = static_cast<int>(std::floor(at));
        const double share = at - first;
        double grey = (1.0 - share) * surface.at<float>(v, first) + share * surface.at<float>(v, first + 1);
        int covered = 0;
        for (int i = 0; has_line && i < kSamples * kSamples; ++i) {
          const double du = (i % kSamples + 0.5) / kSamples - 0.5, dv = (i / kSamples + 0.5) / kSamples - 0.5;
          covered += off_px(u + du + line_px, v + dv) < 0.5 * thickness_px;
        }
        const double cover = covered / static_cast<double>(kSamples * kSamples);
        grey = (1.0 - cover) * grey + cover * kBranchGrey + noise.at<float>(v, u);
        image.at<uint8_t>(v, u) = cv::saturate_cast<uint8_t>(grey);
      }
    }
    return image;
  }

  /// The lines of the pair, if a block matcher has found the surface only, or no surface.
  cv::Mat lines16(bool surface_is_matched = true) const {
    const int16_t surface16 = surface_is_matched ? static_cast<int16_t>(kDisparityUnits * kBehindPx) : kNoDisparity;
    cv::Mat lines;
    LineMatcher matcher;
    matcher.match(image(0.0, 0.0, 2 * seed), image(kBehindPx, kLinePx, 2 * seed + 1),
                  cv::Mat(kHeight, kWidth, CV_16SC1, cv::Scalar(surface16)), cv::Range::all(), lines);
    return lines;
  }
};

struct Matches {
  int cells = 0, found = 0, off = 0;  ///< cells that the line crosses far inside; found in them; found elsewhere
  int wrong = 0;                      ///< of the found ones, off by more than two sigma of the map
  double mean_px = 0.0;               ///< of the found ones
};

Matches count(const ThinScene& scene, const cv::Mat& lines16) {
  Matches matches;
  for (int row = 0; row < lines16.rows; ++row) {
    for (int col = 0; col < lines16.cols; ++col) {
      const double off_px = scene.off_px((col + 0.5) * kCell, (row + 0.5) * kCell);
      const bool found = lines16.at<int16_t>(row, col) >= 0;
      const bool outside = col == 0 || col + 1 == lines16.cols || row == 0 || row + 1 == lines16.rows;
      if (off_px < 0.25 * kCell && !outside) {
        ++matches.cells;
        matches.found += found;
        if (!found) continue;
        const double d_px = lines16.at<int16_t>(row, col) / kDisparityUnits;
        matches.mean_px += d_px;
        matches.wrong += std::abs(d_px - kLinePx) > 1.0;
      }
      matches.off += found && off_px > 2.0 * kCell;
    }
  }
  if (matches.found > 0) matches.mean_px /= matches.found;
  return matches;
}

constexpr double kRounding = 0.5;  // px

TEST(LineMatcher, FindsThinLinesInFrontOfATexturedSurface) {
  for (const double degrees : {90.0, 60.0, 30.0, 120.0}) {
    for (const double thickness_px : {1.0, 2.0, 3.0}) {
      const ThinScene scene{.angle_rad = degrees * std::numbers::pi / 180.0, .thickness_px = thickness_px};
      const Matches matches = count(scene, scene.lines16());
      EXPECT_GT(matches.cells, 8) << degrees;
      EXPECT_GT(matches.found, 0.6 * matches.cells) << degrees << " " << thickness_px;
      EXPECT_LE(matches.off, 2) << degrees << " " << thickness_px;
      EXPECT_LE(matches.wrong, 0.1 * matches.found) << degrees << " " << thickness_px;
      EXPECT_NEAR(matches.mean_px, kLinePx, kRounding) << degrees << " " << thickness_px;
    }
  }
}

// Against the sky or a plain wall, a line of half a pixel is enough.
TEST(LineMatcher, FindsAFractionOfAPixelInFrontOfAPlainSurface) {
  const ThinScene scene{.thickness_px = 0.4, .texture = 0.0};
  const Matches matches = count(scene, scene.lines16(/*surface_is_matched=*/false));
  EXPECT_GT(matches.found, 0.9 * matches.cells);
  EXPECT_EQ(matches.off, 0);
  EXPECT_EQ(matches.wrong, 0);
}

TEST(LineMatcher, FindsFewLinesInTexture) {
  int found = 0, cells = 0;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const cv::Mat lines16 = ThinScene{.has_line = false, .seed = seed}.lines16();
    cells += static_cast<int>(lines16.total());
    found += cv::countNonZero(lines16 >= 0);
  }
  EXPECT_LE(found, 0.002 * cells);
}

TEST(LineMatcher, FindsNoLineInCameraNoise) {
  const ThinScene scene{.texture = 0.0, .has_line = false};
  EXPECT_EQ(cv::countNonZero(scene.lines16(/*surface_is_matched=*/false) >= 0), 0);
}

// The surface is textured, and the line is painted on it.
TEST(LineMatcher, LineOnAMatchedSurfaceIsNotNearer) {
  const ThinScene scene{.thickness_px = 2.0};
  cv::Mat lines16;
  LineMatcher matcher;
  matcher.match(scene.image(0.0, 0.0, 1), scene.image(kBehindPx, kBehindPx, 2),
                cv::Mat(kHeight, kWidth, CV_16SC1, cv::Scalar(kDisparityUnits * kBehindPx)), cv::Range::all(), lines16);
  EXPECT_EQ(cv::countNonZero(lines16 >= 0), 0);
}

// Poles at equal distances have several equally good matches.
TEST(LineMatcher, LeavesRegularPolesOpen) {
  const auto fence = [](double shift_px) {
    cv::Mat image(kHeight, kWidth, CV_8UC1, cv::Scalar(150));
    for (int u = 0; u < kWidth; ++u) {
      if (static_cast<int>(u + shift_px) % 10 < 2) image.col(u).setTo(50);
    }
    return image;
  };
  cv::Mat lines16;
  LineMatcher matcher;
  matcher.match(fence(0.0), fence(6.0), cv::Mat(kHeight, kWidth, CV_16SC1, cv::Scalar(kNoDisparity)), cv::Range::all(),
                lines16);
  EXPECT_EQ(cv::countNonZero(lines16.colRange(7, lines16.cols) >= 0), 0);
}

}  // namespace
}  // namespace hedgehop::vision::stereo
