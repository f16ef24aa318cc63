// Calibration files of other programs give the camera exactly the numbers that they state.
#include "sim/scenario/calibration_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core/persistence.hpp>
#include <string>

#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Model = CameraConfig::Model;

constexpr const char* kPose = "[[0, -1, 0, 0.5], [0, 0, -1, 0.25], [1, 0, 0, -0.125], [0, 0, 0, 1]]";

CalibratedCamera only(const std::string& text) { return parse_calibration(text, "calibration").at(0); }

std::string fault_of_calibration(const std::string& text) {
  const std::vector<std::string> errors = faults_of([&] { parse_calibration(text, "calibration"); });
  return errors.empty() ? "" : errors[0];
}

/// A camera of Kalibr with the given model.
std::string kalibr(const std::string& model, const std::string& intrinsics, const std::string& distortion_model,
                   const std::string& coefficients) {
  return fmt::format(
      "cam0:\n  camera_model: {}\n  intrinsics: [{}]\n  distortion_model: {}\n  distortion_coeffs: [{}]\n"
      "  resolution: [640, 480]\n  rostopic: /front/image_raw\n  T_cam_imu: {}\n",
      model, intrinsics, distortion_model, coefficients, kPose);
}

/// A camera of OpenCV's FileStorage with the given coefficients.
std::string opencv(const std::string& coefficients, const std::string& more = "") {
  return fmt::format(
      "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\n{}camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n"
      "   dt: d\n   data: [ 458.5, 0., 367.25, 0., 457.125, 248.375, 0., 0., 1. ]\n"
      "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: [{}]\n",
      more, coefficients);
}

void expect_intrinsics(const CameraConfig& camera, double focal_x, double focal_y, double center_u, double center_v) {
  EXPECT_EQ(camera.focal_x_px, focal_x);
  EXPECT_EQ(camera.focal_y_px, focal_y);
  EXPECT_EQ(camera.center_u_px, center_u);
  EXPECT_EQ(camera.center_v_px, center_v);
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.height_px, 480);
}

TEST(CalibrationFile, ModelsOfKalibr) {
  const CalibratedCamera radtan = only(kalibr("pinhole", "460, 461, 320, 240", "radtan", "-0.28, 0.07, 1e-4, 2e-5"));
  EXPECT_EQ(radtan.name, "cam0");
  EXPECT_EQ(radtan.role, "front");
  EXPECT_EQ(radtan.config.model_kind, Model::pinhole);
  EXPECT_THAT(radtan.config.distortion, ElementsAre(-0.28, 0.07, 1e-4, 2e-5));
  EXPECT_THAT(radtan.config.camera_from_imu, ElementsAre(0, -1, 0, 0.5, 0, 0, -1, 0.25, 1, 0, 0, -0.125, 0, 0, 0, 1));
  expect_intrinsics(radtan.config, 460, 461, 320, 240);

  const CameraConfig fisheye =
      only(kalibr("pinhole", "190, 191, 255, 257", "equidistant", "3e-3, 7e-4, -2e-3, 2e-4")).config;
  EXPECT_EQ(fisheye.model_kind, Model::fisheye);
  EXPECT_THAT(fisheye.distortion, ElementsAre(3e-3, 7e-4, -2e-3, 2e-4));

  const CameraConfig omni = only(kalibr("omni", "1.7, 800, 801, 320, 240", "radtan", "-0.1, 0.02, 0, 1e-3")).config;
  EXPECT_EQ(omni.model_kind, Model::unified);
  EXPECT_EQ(omni.xi, 1.7);
  expect_intrinsics(omni, 800, 801, 320, 240);

  const CameraConfig sphere = only(kalibr("ds", "-0.2, 0.59, 158, 159, 320, 240", "none", "")).config;
  EXPECT_EQ(sphere.model_kind, Model::double_sphere);
  EXPECT_EQ(sphere.xi, -0.2);
  EXPECT_EQ(sphere.alpha, 0.59);
  expect_intrinsics(sphere, 158, 159, 320, 240);
}

TEST(CalibrationFile, SensorOfEuroc) {
  const CalibratedCamera camera = only(
      "# General sensor definitions.\nsensor_type: camera\ncomment: VI-Sensor cam0\nT_BS:\n  cols: 4\n  rows: 4\n"
      "  data: [0, -1, 0, -0.5,\n         1, 0, 0, -0.0625,\n         0, 0, 1, 0.25,\n         0, 0, 0, 1]\nrate_hz: "
      "20\n"
      "resolution: [640, 480]\ncamera_model: pinhole\nintrinsics: [458.5, 457.25, 367.125, 248.5] #fu, fv, cu, cv\n"
      "distortion_model: radial-tangential\ndistortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, "
      "1.76187114e-05]\n");
  EXPECT_EQ(camera.rate_hz, 20.0);
  EXPECT_THAT(camera.config.distortion, ElementsAre(-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05));
  EXPECT_THAT(camera.config.imu_from_camera, ElementsAre(0, -1, 0, -0.5, 1, 0, 0, -0.0625, 0, 0, 1, 0.25, 0, 0, 0, 1));
  expect_intrinsics(camera.config, 458.5, 457.25, 367.125, 248.5);
}

TEST(CalibrationFile, ChainOfOpenVinsStatesTheInversePose) {
  std::string chain = kalibr("pinhole", "460, 461, 320, 240", "radtan", "0, 0, 0, 0");
  chain.replace(chain.find("T_cam_imu"), 9, "T_imu_cam");
  const CameraConfig camera = only(chain).config;
  EXPECT_TRUE(camera.camera_from_imu.empty());
  EXPECT_THAT(camera.imu_from_camera, ElementsAre(0, -1, 0, 0.5, 0, 0, -1, 0.25, 1, 0, 0, -0.125, 0, 0, 0, 1));
}

TEST(CalibrationFile, TheEndOfADocumentMayFollow) {
  for (const char* end : {"---\n", "---", "...\n\n"})
    EXPECT_EQ(only(opencv("0, 0, 0, 0, 0") + end).config.focal_x_px, 458.5) << end;
  EXPECT_THAT(fault_of_calibration(opencv("0, 0, 0, 0, 0") + "---\nimage_width: 3\n"), HasSubstr("second document"));
}

TEST(CalibrationFile, CameraInfoOfRos) {
  const auto info = [](const std::string& model, const std::string& k) {
    return fmt::format(
        "image_width: 640\nimage_height: 480\ncamera_name: head\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
        "  data: [554.5, 0, 364.25, 0, 551.5, 252.125, 0, 0, 1]\ndistortion_model: {}\ndistortion_coefficients:\n"
        "  rows: 1\n  cols: 5\n  data: [{}]\nprojection_matrix: {{rows: 3, cols: 4, data: [1, 0, 0, 0, 0, 1, 0, 0, 0, "
        "0, 1, 0]}}\n",
        model, k);
  };
  const CalibratedCamera plumb_bob = only(info("plumb_bob", "-0.4, 0.27, 1e-3, 2e-4, -0.13"));
  EXPECT_EQ(plumb_bob.name, "head");
  EXPECT_THAT(plumb_bob.config.distortion, ElementsAre(-0.4, 0.27, 1e-3, 2e-4, -0.13));
  expect_intrinsics(plumb_bob.config, 554.5, 551.5, 364.25, 252.125);
  EXPECT_THAT(only(info("rational_polynomial", "1, 2, 3, 4, 5, 6, 7, 8")).config.distortion,
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_EQ(only(info("equidistant", "1, 2, 3, 4")).config.model_kind, Model::fisheye);
  EXPECT_EQ(only("width: 640\nheight: 480\ndistortion_model: plumb_bob\nD: [0, 0, 0, 0, 0]\n"
                 "K: [554.5, 0, 364.25, 0, 551.5, 252.125, 0, 0, 1]\n")
                .config.focal_x_px,
            554.5);
}

TEST(CalibrationFile, YamlAndXmlOfOpenCv) {
  const CameraConfig five = only(opencv("-0.28, 0.07, 1.9e-4, 1.76e-05, 0.")).config;
  EXPECT_THAT(five.distortion, ElementsAre(-0.28, 0.07, 1.9e-4, 1.76e-05, 0.0));
  expect_intrinsics(five, 458.5, 457.125, 367.25, 248.375);
  EXPECT_THAT(only(opencv("1., 2., 3., 4., 5., 6., 7., 8., 0., 0., 0., 0., 0., 0.")).config.distortion,
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_EQ(only(opencv("1., 2., 3., 4.", "camera_model: fisheye\n")).config.model_kind, Model::fisheye);

  for (const int format : {cv::FileStorage::FORMAT_XML, cv::FileStorage::FORMAT_YAML}) {
    cv::FileStorage storage("calibration", cv::FileStorage::WRITE | cv::FileStorage::MEMORY | format);
    const cv::Mat K = (cv::Mat_<double>(3, 3) << 458.654, 0, 367.215, 0, 457.296, 248.375, 0, 0, 1);
    const cv::Mat D = (cv::Mat_<double>(1, 5) << -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.1 / 3.0);
    storage << "image_width" << 640 << "image_height" << 480 << "camera_matrix" << K << "distortion_coefficients" << D;
    const CameraConfig read = only(storage.releaseAndGetString()).config;
    expect_intrinsics(read, 458.654, 457.296, 367.215, 248.375);
    EXPECT_THAT(read.distortion, ElementsAre(-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.1 / 3.0));
  }
}

TEST(CalibrationFile, RefusesModelsThatAreNotImplementedByTheirNames) {
  EXPECT_THAT(fault_of_calibration(opencv("1, 2, 3, 4, 5, 6, 7, 8, 1e-3, 0, 0, 0")), HasSubstr("thin prism"));
  EXPECT_THAT(fault_of_calibration(opencv("1, 2, 3, 4, 5, 6, 7, 8, 0, 0, 0, 0, 0.1, 0")), HasSubstr("tilted"));
  EXPECT_THAT(fault_of_calibration(kalibr("eucm", "0.6, 1.1, 460, 461, 320, 240", "none", "")),
              HasSubstr("extended unified"));
  EXPECT_THAT(fault_of_calibration(kalibr("pinhole", "460, 461, 320, 240", "fov", "0.9")),
              HasSubstr("'fov' is not implemented"));
}

TEST(CalibrationFile, RefusesAnUnknownModelNextToACameraMatrix) {
  EXPECT_THAT(fault_of_calibration(opencv("0.01, 0, 0, 0", "camera_model: kannala_brandt_8\n")),
              HasSubstr("calibration:5:15: unknown camera model 'kannala_brandt_8'; valid: pinhole, fisheye, omnidir"));
  EXPECT_EQ(only(opencv("0.01, 0, 0, 0", "camera_model: pinhole\n")).config.model_kind, Model::pinhole);
}

TEST(CalibrationFile, RefusesOtherFilesWithLineAndValidValues) {
  EXPECT_THAT(fault_of_calibration("a: 1"), HasSubstr("valid: Kalibr's camera chain"));
  EXPECT_THAT(fault_of_calibration("M1: [1, 0, 0, 0, 1, 0, 0, 0, 1]"), HasSubstr("camera_matrix (or cameraMatrix, K)"));
  EXPECT_THAT(fault_of_calibration(""), HasSubstr("calibration"));
  EXPECT_EQ(fault_of_calibration("<opencv_storage><a>"),
            "calibration: is not complete XML, or is not a file of cv::FileStorage (<opencv_storage>)");
  EXPECT_THAT(fault_of_calibration(opencv("1, 2, 3")), HasSubstr("calibration:11:4: a pinhole has"));
  EXPECT_THAT(fault_of_calibration(opencv("1, x, 3, 4")), HasSubstr("expected a number, got 'x'"));
  EXPECT_THAT(fault_of_calibration(kalibr("pinhole", "460, 461, 320", "radtan", "0, 0, 0, 0")),
              HasSubstr("intrinsics must have 4"));
  EXPECT_THAT(fault_of_calibration(kalibr("pinhole", "460, .nan, 320, 240", "radtan", "0, 0, 0, 0")),
              HasSubstr("expected a number"));
}

}  // namespace
}  // namespace hedgehop::sim
