// Calibration tools recover the camera that looked at the boards.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "scenes/generators.h"
#include "sim/render/renderer.h"

namespace hedgehop::sim {
namespace {

constexpr double kFocalPx = 458.0, kCenterU = 371.25, kCenterV = 236.75;

vision::camera::Camera board_camera() {
  return {752, 480, vision::camera::PinholeLens{kFocalPx, kFocalPx + 1.5, kCenterU, kCenterV, -0.28, 0.07, 2e-4, 2e-5}};
}

/// Returns poses in W that see a board 3 m north of the origin at 2 m altitude, from all sides and distances.
/// @param nearest_m  distance of the nearest view.
std::vector<Eigen::Isometry3d> board_views(double nearest_m) {
  const Eigen::Vector3d middle_W(3.0, 0.0, -2.0);
  Eigen::Matrix3d R_WC_south;  // looks north: right is east, down is down
  R_WC_south << 0, 0, 1,       //
      1, 0, 0,                 //
      0, 1, 0;
  std::vector<Eigen::Isometry3d> views;
  for (const double pitch_deg : {-35.0, 0.0, 35.0}) {
    for (const double yaw_deg : {-40.0, -15.0, 15.0, 40.0}) {
      for (const double roll_deg : {0.0, 80.0}) {
        const double distance_m = nearest_m * (1.0 + 0.25 * static_cast<double>(views.size() % 3));
        const double rad = std::numbers::pi / 180.0;
        const Eigen::Matrix3d turn_W = (Eigen::AngleAxisd(yaw_deg * rad, Eigen::Vector3d::UnitZ()) *
                                        Eigen::AngleAxisd(pitch_deg * rad, Eigen::Vector3d::UnitY()))
                                           .toRotationMatrix();
        Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
        // Off the middle of the image, so that the views cover its corners.
        const double aside = 0.12 * (static_cast<double>(views.size() % 5) - 2.0);
        X_WC.linear() = turn_W * R_WC_south *
                        Eigen::AngleAxisd(roll_deg * rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                        Eigen::AngleAxisd(aside, Eigen::Vector3d(1.0, 1.0, 0.0).normalized()).toRotationMatrix();
        X_WC.translation() = middle_W - distance_m * turn_W.col(0);
        views.push_back(X_WC);
      }
    }
  }
  return views;
}

cv::Mat seen(Renderer& renderer, const Eigen::Isometry3d& X_WC) {
  cv::Mat image;
  renderer.draw({board_camera(), X_WC, ImageChannel::grey, 0.0, {}, 4}, image);
  return image;
}

void expect_recovered(const std::vector<std::vector<cv::Point3f>>& points,
                      const std::vector<std::vector<cv::Point2f>>& pixels) {
  cv::Mat K, D;
  std::vector<cv::Mat> rotations, translations;
  const double rms_px = cv::calibrateCamera(points, pixels, {752, 480}, K, D, rotations, translations);
  EXPECT_LT(rms_px, 0.3);
  EXPECT_NEAR(K.at<double>(0, 0), kFocalPx, 1e-3 * kFocalPx);
  EXPECT_NEAR(K.at<double>(1, 1), kFocalPx + 1.5, 1e-3 * kFocalPx);
  EXPECT_NEAR(K.at<double>(0, 2), kCenterU, 0.3);
  EXPECT_NEAR(K.at<double>(1, 2), kCenterV, 0.3);
}

TEST(CalibrationBoard, OpenCvRecoversTheCameraFromTheCheckerboard) {
  const scenes::worlds::CheckerboardConfig config;
  Renderer renderer(scenes::make_scene(config, 1), Culling::none, RendererKind::tiles);
  const cv::Size corners(static_cast<int>(config.columns), static_cast<int>(config.rows));
  std::vector<cv::Point3f> board;
  for (int row = 0; row < corners.height; ++row) {
    for (int col = 0; col < corners.width; ++col) {
      board.emplace_back(static_cast<float>(col * config.square_m), static_cast<float>(row * config.square_m), 0.0f);
    }
  }
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const Eigen::Isometry3d& X_WC : board_views(1.1)) {
    const cv::Mat image = seen(renderer, X_WC);
    std::vector<cv::Point2f> found;
    if (!cv::findChessboardCorners(image, corners, found)) continue;
    cv::cornerSubPix(image, found, {5, 5}, {-1, -1}, {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-4});
    points.push_back(board);
    pixels.push_back(found);
  }
  EXPECT_GT(points.size(), 15u);
  expect_recovered(points, pixels);
}

TEST(CalibrationBoard, TagsAreReadAndTheirCornersRecoverTheCamera) {
  const scenes::worlds::AprilGridConfig config;
  Renderer renderer(scenes::make_scene(config, 1), Culling::none, RendererKind::tiles);
  const double pitch_m = config.tag_m * (1.0 + config.spacing), cell_m = config.tag_m / 10.0;
  const double left_m = -0.5 * (6.0 * pitch_m - config.spacing * config.tag_m);  // of tag 0; the grid is square
  // Position in W of a point of the face, x to the right, y up.
  const auto on_face = [](double x_m, double y_m) { return Eigen::Vector3d(3.0, x_m, -2.0 - y_m); };
  // Codes of the family 36h11, from the AprilTag library: tags 0 and 35.
  constexpr uint64_t kFirst = 0xd5d628584, kLast = 0x686d7002a;
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const Eigen::Isometry3d& X_WC : board_views(0.6)) {
    const cv::Mat image = seen(renderer, X_WC);
    const auto pixel_of = [&](double x_m, double y_m) {
      return board_camera().project(X_WC.inverse() * on_face(x_m, y_m));
    };
    const auto level_of = [&](double x_m, double y_m) {
      const auto pixel = pixel_of(x_m, y_m);
      const bool inside = pixel && pixel->x() > 8.0 && pixel->y() > 8.0 && pixel->x() < 743.0 && pixel->y() < 471.0;
      return inside ? image.at<uint8_t>(static_cast<int>(std::lround(pixel->y())),
                                        static_cast<int>(std::lround(pixel->x())))
                    : -1;
    };
    for (const auto& [tag, code] : {std::pair(0, kFirst), std::pair(35, kLast)}) {
      const double x_m = left_m + pitch_m * (tag % 6), y_m = left_m + pitch_m * (tag / 6);
      uint64_t read = 0;
      bool whole = true;
      for (int row = 0; row < 6; ++row) {  // from the top
        for (int col = 0; col < 6; ++col) {
          const int level = level_of(x_m + (col + 2.5) * cell_m, y_m + (7.5 - row) * cell_m);
          whole = whole && level >= 0;
          read = 2 * read + (level > 100 ? 1 : 0);
        }
      }
      if (whole) {
        EXPECT_EQ(read, code) << "tag " << tag;
      }
    }
    std::vector<cv::Point3f> corners;
    std::vector<cv::Point2f> at;
    for (int row = 0; row < 6; ++row) {
      for (int col = 0; col < 6; ++col) {
        for (const auto& [right, up] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
          const double x_m = left_m + pitch_m * col + config.tag_m * right,
                       y_m = left_m + pitch_m * row + config.tag_m * up;
          if (level_of(x_m, y_m) < 0) continue;
          const auto pixel = pixel_of(x_m, y_m);
          corners.emplace_back(static_cast<float>(x_m), static_cast<float>(y_m), 0.0f);
          at.emplace_back(static_cast<float>(pixel->x() + 1.0),
                          static_cast<float>(pixel->y() - 1.0));  // a rough detection
        }
      }
    }
    if (at.size() < 60) continue;
    cv::cornerSubPix(image, at, {4, 4}, {-1, -1}, {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-3});
    points.push_back(corners);
    pixels.push_back(at);
  }
  EXPECT_GT(points.size(), 15u);
  expect_recovered(points, pixels);
}

}  // namespace
}  // namespace hedgehop::sim
