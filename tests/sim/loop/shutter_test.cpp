#include "sim/loop/shutter.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <vector>

namespace hedgehop::sim {
namespace {

constexpr int kRows = 64, kCols = 8;
constexpr double kGreyPerM = 10.0;
constexpr double kFast = std::numeric_limits<double>::infinity();  // px/s: as many moments as are allowed

/// An image whose every pixel tells how far north the body was.
void draw_north(const Eigen::Isometry3d& X_WB, double, const cv::Range& rows, cv::Mat& out) {
  out.create(rows.size(), kCols, CV_8UC1);
  out.setTo(cv::saturate_cast<uint8_t>(kGreyPerM * X_WB.translation().x()));
}

BodyMotion flying_north(double north_m, double speed_mps) {
  BodyMotion body;
  body.X_WB.translation().x() = north_m;
  body.v_WB_W.x() = speed_mps;
  return body;
}

TEST(Shutter, WithoutImperfectionsThereIsOneMomentAndOneDrawing) {
  Shutter shutter({});
  cv::Mat image;
  int drawings = 0;
  shutter.expose(
      flying_north(12.0, 5.0), kFast, kRows,
      [&](const Eigen::Isometry3d& X_WB, double dt_s, const cv::Range& rows, cv::Mat& out) {
        ++drawings;
        EXPECT_EQ(dt_s, 0.0);
        draw_north(X_WB, dt_s, rows, out);
      },
      image);
  EXPECT_EQ(drawings, 1);
  EXPECT_EQ(image.size(), cv::Size(kCols, kRows));
  EXPECT_EQ(cv::mean(image)[0], 120.0);
}

// Brightness grows linearly in time, so its mean is that of the exposure's middle.
TEST(Shutter, ABlurredImageIsTheMeanOverItsExposure) {
  ImperfectionsConfig config;
  config.shutter_s = 0.4;
  config.shutter_samples = 64;
  Shutter shutter(config);
  cv::Mat image;
  shutter.expose(flying_north(12.0, 5.0), kFast, kRows, draw_north, image);
  EXPECT_NEAR(cv::mean(image)[0], kGreyPerM * (12.0 - 5.0 * 0.2), 1.0);  // levels are rounded twice
}

/// When an image that moves so fast is drawn, s after its instant.
std::vector<double> moments_s(double image_speed_pxps, int most) {
  ImperfectionsConfig config;
  config.shutter_s = 0.01;
  config.shutter_samples = most;
  std::vector<double> moments;
  cv::Mat image;
  Shutter(config).expose(
      {}, image_speed_pxps, kRows,
      [&](const Eigen::Isometry3d& X_WB, double dt_s, const cv::Range& rows, cv::Mat& out) {
        moments.push_back(dt_s);
        draw_north(X_WB, dt_s, rows, out);
      },
      image);
  return moments;
}

TEST(Shutter, MomentsLieNoFartherApartThanTheImageMovesByFourTenthsOfAPixelUntilThereAreTooMany) {
  EXPECT_EQ(moments_s(0.0, 8), std::vector<double>{-0.005});
  EXPECT_EQ(moments_s(39.0, 8), std::vector<double>{-0.005});
  for (const double speed_pxps : {41.0, 119.0, 121.0, 260.0}) {
    const std::vector<double> moments = moments_s(speed_pxps, 8);
    const double part_s = 0.01 / static_cast<double>(moments.size());
    EXPECT_LE(speed_pxps * part_s, 0.4) << speed_pxps;
    EXPECT_GT(speed_pxps * 0.01 / static_cast<double>(moments.size() - 1), 0.4) << speed_pxps;  // and no more than that
    for (size_t k = 0; k < moments.size(); ++k)
      EXPECT_NEAR(moments[k], -part_s * (static_cast<double>(k) + 0.5), 1e-15);
  }
  EXPECT_EQ(moments_s(5000.0, 8).size(), 8u);
  EXPECT_EQ(moments_s(kFast, 8).size(), 8u);
  EXPECT_EQ(moments_s(kFast, 1), std::vector<double>{-0.005});
}

TEST(Shutter, RowsOfARollingShutterAreExposedOneAfterTheOtherTheLastAtTheInstant) {
  ImperfectionsConfig config;
  config.readout_s = 0.5;
  config.readout_strips = kRows;
  Shutter shutter(config);
  cv::Mat image;
  shutter.expose(flying_north(20.0, 20.0), kFast, kRows, draw_north, image);
  for (int row = 0; row < kRows; ++row) {
    const double t_s = -0.5 * (1.0 - static_cast<double>(row) / (kRows - 1));
    EXPECT_NEAR(image.at<uint8_t>(row, 3), kGreyPerM * (20.0 + 20.0 * t_s), 0.5 + 1e-9) << row;
  }
}

TEST(Shutter, StripsThatDoNotDivideTheImageStillCoverIt) {
  ImperfectionsConfig config;
  config.readout_s = 0.1;
  config.readout_strips = 7;
  Shutter shutter(config);
  cv::Mat image;
  int rows_drawn = 0;
  shutter.expose(
      flying_north(10.0, 0.0), 0.0, kRows,
      [&](const Eigen::Isometry3d& X_WB, double dt_s, const cv::Range& rows, cv::Mat& out) {
        EXPECT_EQ(rows.start, rows_drawn);
        rows_drawn = rows.end;
        draw_north(X_WB, dt_s, rows, out);
      },
      image);
  EXPECT_EQ(rows_drawn, kRows);
  EXPECT_EQ(cv::countNonZero(image == 100), kRows * kCols);
}

TEST(Shutter, ABodyTurnsAboutItsOwnAxes) {
  BodyMotion body;
  body.X_WB.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  body.w_WB_B = Eigen::Vector3d(0.0, 0.0, 2.0);
  const Eigen::Isometry3d later = body.X_WB_after(0.25);
  EXPECT_TRUE(later.linear().isApprox(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()).toRotationMatrix(), 1e-12));
}

TEST(Shutter, ACutCameraSeesItsRowsAsTheWholeOneDoes) {
  const vision::camera::Camera whole = vision::camera::PinholeCamera::from_fov(64, 48, std::numbers::pi / 2);
  const vision::camera::Camera part = cut(whole, {10, 20});
  EXPECT_EQ(part.height_px, 10);
  for (const Eigen::Vector3d& p_C : {Eigen::Vector3d(0.1, -0.4, 1.0), Eigen::Vector3d(-0.7, -0.2, 2.0)}) {
    EXPECT_TRUE((*part.project(p_C) + Eigen::Vector2d(0.0, 10.0)).isApprox(*whole.project(p_C), 1e-12));
  }
}

}  // namespace
}  // namespace hedgehop::sim
