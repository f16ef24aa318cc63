// Calibration files of other programs give the camera exactly the numbers that they state.
#include "sim/scenario/calibration_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core/persistence.hpp>
#include <string>

#include "sim/scenario/calibration.h"
#include "sim/scenario/scenario.h"
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

TEST(CalibrationFile, RefusesOtherFilesWithLineAndValidValues) {
  EXPECT_THAT(fault_of_calibration("a: 1"), HasSubstr("valid: Kalibr's camera chain"));
  EXPECT_THAT(fault_of_calibration("M1: [1, 0, 0, 0, 1, 0, 0, 0, 1]"), HasSubstr("camera_matrix (or cameraMatrix, K)"));
  EXPECT_THAT(fault_of_calibration(""), HasSubstr("calibration"));
  EXPECT_THAT(fault_of_calibration("<opencv_storage><a>"), HasSubstr("cannot be read as XML"));
  EXPECT_THAT(fault_of_calibration(opencv("1, 2, 3")), HasSubstr("calibration:11:4: a pinhole has"));
  EXPECT_THAT(fault_of_calibration(opencv("1, x, 3, 4")), HasSubstr("expected a number, got 'x'"));
  EXPECT_THAT(fault_of_calibration(kalibr("pinhole", "460, 461, 320", "radtan", "0, 0, 0, 0")),
              HasSubstr("intrinsics must have 4"));
  EXPECT_THAT(fault_of_calibration(kalibr("pinhole", "460, .nan, 320, 240", "radtan", "0, 0, 0, 0")),
              HasSubstr("expected a number"));
}

/// A scenario with this rig, as text.
Scenario flown(const std::string& rig) {
  Folder::write("scenario.yaml",
                fmt::format("name: a\nscene: {{type: tree}}\nvehicle: {{use: {}/vehicles/firefly.yaml}}\n"
                            "avionics: {{imu: {{position: [0.1, -0.05, 0.02]}}}}\n"
                            "velocimeter: {{enabled: false}}\nstart: {{north: 0, east: 0, altitude: 5}}\n"
                            "avoidance: {{module: go_to_goal}}\nrig: {}\n",
                            kConfigs.string(), rig));
  return load_scenario("scenario.yaml");
}

/// A rig with every lens that both formats support, anyhow mounted.
std::string two_cameras(const std::string& first) {
  return "{cameras: [{role: left, " + first +
         ", yaw: 12.3, pitch: -31.7, roll: 77.7, forward: 0.1234567, right: -0.7654321, down: 0.0333333}, {role: "
         "right, "
         "width: 640, height: 480, fov: 71.3, distortion: [-0.21, 0.031, 1e-3, -2e-4], quaternion: [0.5, 0.5, 0.5, "
         "0.5], forward: 0.3333333, down: 0.7777777}]}";
}

TEST(CalibrationFile, HedgehopReadsItsOwnFilesToTheLastDigit) {
  Folder folder;
  const std::vector<std::string> lenses = {
      "model: fisheye, fov: 171.7, distortion: [0.0123, -0.00456, 7.89e-4, -1.01e-5]",
      "model: unified, xi: 1.23456789, focal_x: 300.123, distortion: [-0.1, 0.02, 1e-3, -1e-3]"};
  for (const std::string& lens : lenses) {
    const Scenario original = flown(two_cameras(lens));
    const auto imu = original.avionics.imu;
    const std::string as_opencv = opencv_calibration(original.rig.cameras, imu);
    const std::string as_kalibr = kalibr_calibration(original.rig.cameras, imu);
    Folder::write("opencv.yaml", as_opencv);
    Folder::write("chain.yaml", as_kalibr);
    Folder::write("chain_with_header.yaml", kalibr_calibration(original.rig.cameras, imu, /*opencv_header=*/true));
    EXPECT_EQ(opencv_calibration(flown("{calibration: opencv.yaml}").rig.cameras, imu), as_opencv);
    for (const std::string chain : {"chain.yaml", "chain_with_header.yaml"}) {
      const Scenario read = flown("{calibration: " + chain + "}");
      ASSERT_EQ(read.rig.cameras.size(), 2u);
      EXPECT_EQ(read.rig.cameras[1].role, "right");
      // The camera relative to the one before is computed from both poses, so that its last digits may differ.
      const auto without_relative = [](std::string text) { return text.substr(0, text.find("  T_cn_cnm1")); };
      EXPECT_EQ(without_relative(kalibr_calibration(read.rig.cameras, imu)), without_relative(as_kalibr));
      for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(read.rig.cameras[i].model(), original.rig.cameras[i].model());
        EXPECT_TRUE(read.rig.cameras[i].X_BC().isApprox(original.rig.cameras[i].X_BC(), 1e-14));
      }
    }
  }
  const Scenario sphere = flown("{cameras: [{role: a, model: double_sphere, xi: -0.2, alpha: 0.6, focal_x: 158.3}]}");
  Folder::write("ds.yaml", kalibr_calibration(sphere.rig.cameras, sphere.avionics.imu));
  EXPECT_EQ(flown("{cameras: [{role: a, calibration: ds.yaml}]}").rig.cameras[0].model(),
            sphere.rig.cameras[0].model());
}

TEST(CalibrationFile, CamerasOfARigTakeTheEntryOfTheirRole) {
  Folder folder;
  Folder::write("chain.yaml", kalibr("pinhole", "460, 461, 320, 240", "radtan", "0, 0, 0, 0"));
  const RigConfig rig =
      flown("{calibration: chain.yaml, cameras: [{role: front, rate: 30}, {role: down, pitch: -90}]}").rig;
  ASSERT_EQ(rig.cameras.size(), 2u);
  EXPECT_EQ(rig.cameras[0].rate_hz, 30.0);
  EXPECT_EQ(rig.cameras[0].focal_x_px, 460.0);
  // T_cam_imu: the camera's x is the IMU's -y (right), its y -z (down), its z x (forward).
  const Eigen::Vector3d p_BC = rig.cameras[0].X_BC().translation();
  EXPECT_NEAR((p_BC - Eigen::Vector3d(0.1 + 0.125, -0.05 - 0.5, 0.02 - 0.25)).norm(), 0.0, 1e-15) << p_BC.transpose();
  EXPECT_EQ(Eigen::Vector3d(rig.cameras[0].X_BC().linear().col(2)), Eigen::Vector3d::UnitX());
  EXPECT_EQ(rig.cameras[1].width_px, 400);
}

/// A chain of two cameras 0.12 m apart, cam1 to the right of cam0.
std::string chain_of_two(const std::string& first, const std::string& second) {
  const auto camera = [](int number, const std::string& role, const std::string& pose) {
    return fmt::format(
        "cam{}: {{camera_model: pinhole, intrinsics: [46{}, 461, 320, 240], distortion_model: none, "
        "distortion_coeffs: [], resolution: [640, 480], rostopic: /{}/image_raw{}}}\n",
        number, number, role, pose);
  };
  return camera(0, first, "") +
         camera(1, second, ", T_cn_cnm1: [[1, 0, 0, -0.12], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]");
}

TEST(CalibrationFile, TheRelativePoseOfAChainIsThatOfTheEntryBefore) {
  Folder folder;
  Folder::write("chain.yaml", chain_of_two("left", "right"));
  for (const std::string rig : {"{calibration: chain.yaml}",
                                "{calibration: chain.yaml, cameras: [{role: right, rate: 30}, {role: down, down: 0.3, "
                                "pitch: -90}, {role: left, rate: 30}]}"}) {
    const RigConfig mounted = flown(rig).rig;
    const CameraConfig &left = *mounted.find("left"), &right = *mounted.find("right");
    EXPECT_EQ(left.focal_x_px, 460.0);
    EXPECT_EQ(right.focal_x_px, 461.0);
    const Eigen::Vector3d p_CCr = (left.X_BC().inverse() * right.X_BC()).translation();
    EXPECT_NEAR((p_CCr - Eigen::Vector3d(0.12, 0, 0)).norm(), 0.0, 1e-15) << rig << ": " << p_CCr.transpose();
  }
}

TEST(CalibrationFile, AStereoPairRefusesAFileOfTwoCamerasUnlessOneIsNamed) {
  Folder folder;
  for (const std::string& text : {chain_of_two("left", "right"), chain_of_two("right", "left")}) {
    Folder::write("chain.yaml", text);
    EXPECT_THAT(faults_of([] { flown("{stereo: [{calibration: chain.yaml}]}"); }),
                ElementsAre(HasSubstr("'rig.stereo.0.calibration': the file has 2 cameras, but those of a stereo pair "
                                      "are equal; state it as 'rig.calibration'")));
  }
  const RigConfig rig = flown("{stereo: [{calibration: chain.yaml, calibration_camera: cam1, baseline: 0.12}]}").rig;
  for (const CameraConfig& camera : rig.cameras) EXPECT_EQ(camera.focal_x_px, 461.0);
}

TEST(CalibrationFile, AFileWithoutImageSizeNeedsOneFromTheCamera) {
  Folder folder;
  const auto faults = [](double center_u, double center_v, const std::string& keys) {
    Folder::write("nosize.yaml", fmt::format("camera_matrix: [458, 0, {}, 0, 457, {}, 0, 0, 1]\n", center_u, center_v));
    return faults_of([&] { flown("{cameras: [{role: front, calibration: nosize.yaml" + keys + "}]}"); });
  };
  const auto refused = ElementsAre(HasSubstr("'rig.cameras.0.calibration': the file has no image size; state width"));
  EXPECT_THAT(faults(367, 248, ""), refused);
  EXPECT_THAT(faults(367, 248, ", width: 752"), refused);
  EXPECT_THAT(faults(367, 248, ", width: 752, height: 480"), ElementsAre());
  EXPECT_THAT(faults(203, 196, ", width: 400, height: 400"), ElementsAre());
}

TEST(CalibrationFile, KeysThatContradictItAreRefused) {
  Folder folder;
  Folder::write("chain.yaml", kalibr("pinhole", "460, 461, 320, 240", "radtan", "0, 0, 0, 0"));
  const auto faults = [](const std::string& keys) {
    return faults_of([&] { flown("{cameras: [{role: front, calibration: chain.yaml, " + keys + "}]}"); });
  };
  EXPECT_THAT(faults("fx: 460"), ElementsAre(HasSubstr("unknown key 'fx' in 'rig.cameras.0'; the focal lengths are "
                                                       "'focal_x' and 'focal_y'")));
  EXPECT_THAT(faults("fov: 60"), ElementsAre(HasSubstr("'rig.cameras.0.calibration': defines the lens")));
  EXPECT_THAT(faults("width: 320, height: 240"), ElementsAre(HasSubstr("the calibration is of 640 x 480 pixels")));
  EXPECT_THAT(faults("model: fisheye"), ElementsAre(HasSubstr("differs from that of the calibration")));
  EXPECT_THAT(faults("calibration_camera: cam7"), ElementsAre(HasSubstr("no camera 'cam7'; valid: cam0")));
  EXPECT_THAT(faults_of([] { flown("{cameras: [{role: a, body_from_camera: [1, 2]}]}"); }),
              ElementsAre(HasSubstr("must have 16 numbers, got 2")));
  EXPECT_THAT(faults_of([] { flown("{cameras: [{role: a, quaternion: [1, 1, 0, 0]}]}"); }),
              ElementsAre(HasSubstr("must have length 1")));
}

}  // namespace
}  // namespace hedgehop::sim
