#include "sim/scenario/calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <opencv2/calib3d.hpp>
#include <random>

#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::sim {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kPx = 1e-9;

/// A distorted pinhole, a fisheye and a pinhole, anyhow mounted.
RigConfig three_cameras(bool with_k3) {
  std::mt19937_64 random(31);
  RigConfig rig;
  for (const char* role : {"left", "wide", "down"}) {
    CameraConfig& camera = rig.cameras.emplace_back();
    camera.role = role;
    camera.width_px = 320;
    camera.height_px = 240;
    camera.yaw_rad = uniform(random, -3, 3);
    camera.pitch_rad = uniform(random, -1, 1);
    camera.roll_rad = uniform(random, -3, 3);
    camera.forward_m = uniform(random, -1, 1);
    camera.right_m = uniform(random, -1, 1);
  }
  rig.cameras[0].distortion = {-0.2, 0.04, 1e-3, -2e-3, with_k3 ? 0.01 : 0.0};
  rig.cameras[0].center_u_px = 151.25;
  rig.cameras[1].model_kind = CameraConfig::Model::fisheye;
  rig.cameras[1].fov_rad = 3.2;
  rig.cameras[1].distortion = {0.01, -2e-3, 1e-4, -1e-5};
  return rig;
}

/// Compares the pixels of another program's camera with ours, for points in front of it.
void expect_same_pixels(const CameraConfig& config, bool fisheye, const cv::Mat& K, const cv::Mat& D) {
  std::mt19937_64 random(32);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d p_C(uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5), 1.0);
    const std::vector<cv::Point3d> point = {{p_C.x(), p_C.y(), p_C.z()}};
    std::vector<cv::Point2d> pixel;
    if (fisheye) {
      cv::fisheye::projectPoints(point, pixel, cv::Vec3d(), cv::Vec3d(), K, D);
    } else {
      cv::projectPoints(point, cv::Vec3d(), cv::Vec3d(), K, D, pixel);
    }
    const auto ours = config.model().project(p_C);
    ASSERT_TRUE(ours.has_value());
    ASSERT_NEAR(ours->x(), pixel[0].x, kPx) << config.role;
    ASSERT_NEAR(ours->y(), pixel[0].y, kPx) << config.role;
  }
}

dynamics::sensors::ImuConfig imu_of_test() { return {.p_BI_m = {0.1, -0.05, 0.2}}; }

/// The IMU's frame by its definition: forward, left, up, at the IMU. Returns the position in F of a point in B.
Eigen::Vector3d in_F(const Eigen::Vector3d& p_B) {
  const Eigen::Vector3d p_IP_B = p_B - imu_of_test().p_BI_m;
  return {p_IP_B.x(), -p_IP_B.y(), -p_IP_B.z()};
}

TEST(Calibration, OpenCvReadsItAndSeesTheSame) {
  const RigConfig rig = three_cameras(true);
  const cv::FileStorage file(opencv_calibration(rig.cameras, imu_of_test()),
                             cv::FileStorage::READ | cv::FileStorage::MEMORY);
  for (const CameraConfig& camera : rig.cameras) {
    const cv::FileNode node = file[camera.role];
    ASSERT_FALSE(node.empty()) << camera.role;
    EXPECT_EQ(static_cast<int>(node["image_width"]), 320);
    EXPECT_EQ(static_cast<int>(node["image_height"]), 240);
    cv::Mat K, D, X_BC;
    node["camera_matrix"] >> K;
    node["distortion_coefficients"] >> D;
    node["body_from_camera"] >> X_BC;
    expect_same_pixels(camera, std::string(node["camera_model"]) == "fisheye", K, D);
    for (int row = 0; row < 4; ++row) {
      for (int col = 0; col < 4; ++col) EXPECT_EQ(X_BC.at<double>(row, col), camera.X_BC().matrix()(row, col));
    }
  }
}

Eigen::Isometry3d pose(const YAML::Node& rows) {
  Eigen::Isometry3d X;
  for (int row = 0; row < 4; ++row) {
    for (int col = 0; col < 4; ++col) X.matrix()(row, col) = rows[row][col].as<double>();
  }
  return X;
}

TEST(Calibration, KalibrsChainHoldsLensesAndPoses) {
  const RigConfig rig = three_cameras(false);
  const YAML::Node chain = YAML::Load(kalibr_calibration(rig.cameras, imu_of_test()));
  ASSERT_EQ(chain.size(), 3u);
  for (size_t i = 0; i < rig.cameras.size(); ++i) {
    const YAML::Node node = chain["cam" + std::to_string(i)];
    const auto intrinsics = node["intrinsics"].as<std::vector<double>>();
    const auto distortion = node["distortion_coeffs"].as<std::vector<double>>();
    ASSERT_EQ(intrinsics.size(), 4u);
    ASSERT_EQ(distortion.size(), 4u);
    const cv::Mat K =
        (cv::Mat_<double>(3, 3) << intrinsics[0], 0, intrinsics[2], 0, intrinsics[1], intrinsics[3], 0, 0, 1);
    const bool fisheye = node["distortion_model"].as<std::string>() == "equidistant";
    EXPECT_EQ(fisheye, i == 1);
    expect_same_pixels(rig.cameras[i], fisheye, K, cv::Mat(distortion));

    const Eigen::Vector3d p_B(0.3, -2.0, 1.1);
    EXPECT_NEAR((rig.cameras[i].X_BC() * (pose(node["T_cam_imu"]) * in_F(p_B)) - p_B).norm(), 0.0, 1e-14);
    if (i == 0) continue;
    const Eigen::Vector3d p_before = pose(chain["cam" + std::to_string(i - 1)]["T_cam_imu"]) * in_F(p_B);
    EXPECT_NEAR((pose(node["T_cn_cnm1"]) * p_before - pose(node["T_cam_imu"]) * in_F(p_B)).norm(), 0.0, 1e-14);
  }
}

TEST(Calibration, AnyRoleReadsBackFromKalibrsChain) {
  RigConfig rig = three_cameras(false);
  rig.cameras[0].role = "a: b #1";
  rig.cameras[1].role = "\"quoted\"";
  const std::string text = kalibr_calibration(rig.cameras, imu_of_test());
  const YAML::Node chain = YAML::Load(text);
  EXPECT_EQ(chain["cam0"]["rostopic"].as<std::string>(), "/a: b #1/image_raw");
  EXPECT_EQ(chain["cam1"]["rostopic"].as<std::string>(), "/\"quoted\"/image_raw");
  EXPECT_THAT(text, HasSubstr("rostopic: /down/image_raw\n"));
}

TEST(Calibration, OpenCvReadsKalibrsChainWithItsHeader) {
  const RigConfig rig = three_cameras(false);
  const std::string chain = kalibr_calibration(rig.cameras, imu_of_test());
  const std::string with_header = kalibr_calibration(rig.cameras, imu_of_test(), /*opencv_header=*/true);
  EXPECT_TRUE(with_header.ends_with(chain));
  const YAML::Node expected = YAML::Load(chain);
  const cv::FileStorage file(with_header, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  for (const std::string camera : {"cam0", "cam1", "cam2"}) {
    std::vector<double> intrinsics;
    file[camera]["intrinsics"] >> intrinsics;
    EXPECT_EQ(intrinsics, expected[camera]["intrinsics"].as<std::vector<double>>());
    for (int row = 0; row < 4; ++row) {
      std::vector<double> numbers;
      file[camera]["T_cam_imu"][row] >> numbers;
      EXPECT_EQ(numbers, expected[camera]["T_cam_imu"][row].as<std::vector<double>>());
    }
  }
}

TEST(Calibration, RefusesLensesThatAFormatCannotHold) {
  EXPECT_THAT([] { kalibr_calibration(three_cameras(true).cameras, imu_of_test()); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("camera 'left' has k3 or more")));
  RigConfig rig = three_cameras(true);
  rig.cameras[2].role = "2nd";
  EXPECT_THAT([&] { opencv_calibration(rig.cameras, imu_of_test()); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("camera '2nd': OpenCV's files need names")));
}

}  // namespace
}  // namespace hedgehop::sim
