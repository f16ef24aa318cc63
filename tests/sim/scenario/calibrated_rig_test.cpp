// A rig takes the cameras of calibration files.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim/scenario/calibration.h"
#include "sim/scenario/calibration_file.h"
#include "sim/scenario/scenario.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A chain of one camera, which looks forward.
constexpr const char* kFront =
    "cam0:\n  camera_model: pinhole\n  intrinsics: [460, 461, 320, 240]\n  distortion_model: radtan\n"
    "  distortion_coeffs: [0, 0, 0, 0]\n  resolution: [640, 480]\n  rostopic: /front/image_raw\n"
    "  T_cam_imu: [[0, -1, 0, 0.5], [0, 0, -1, 0.25], [1, 0, 0, -0.125], [0, 0, 0, 1]]\n";

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

TEST(CalibratedRig, HedgehopReadsItsOwnFilesToTheLastDigit) {
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

TEST(CalibratedRig, CamerasOfARigTakeTheEntryOfTheirRole) {
  Folder folder;
  Folder::write("chain.yaml", kFront);
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

TEST(CalibratedRig, ACameraWithoutALensThatTheFileNamesOtherwiseIsRefused) {
  Folder folder;
  Folder::write("chain.yaml", kFront);
  const auto faults = [](const std::string& camera) {
    return faults_of([&] { flown("{calibration: chain.yaml, cameras: [{role: left" + camera + "}]}"); });
  };
  EXPECT_THAT(faults(""),
              ElementsAre(AllOf(HasSubstr("scenario.yaml:8:"), HasSubstr("'rig.cameras.0': 'left' has no lens"),
                                HasSubstr("does not list: front;"))));
  EXPECT_THAT(faults(", fov: 60"), ElementsAre());
  EXPECT_THAT(faults(", calibration: chain.yaml"), ElementsAre());
  EXPECT_THAT(faults(", channel: depth"), ElementsAre());
}

TEST(CalibratedRig, NumbersThatAreNotInPixelsAreRefused) {
  Folder folder;
  const auto faults = [](const std::string& intrinsics, const std::string& resolution) {
    Folder::write("chain.yaml", fmt::format("cam0: {{camera_model: pinhole, intrinsics: [{}], resolution: [{}]}}\n",
                                            intrinsics, resolution));
    return faults_of([] { flown("{calibration: chain.yaml}"); });
  };
  EXPECT_THAT(faults("458, 457, 367, 248", "752, 480"), ElementsAre());
  EXPECT_THAT(faults("0.458, 0.457, 0.367, 0.248", "752, 480"),
              ElementsAre(HasSubstr("a focal length of 0.458 px with 752 columns")));
  EXPECT_THAT(faults("458, 457, 36700, 24800", "752, 480"), ElementsAre(HasSubstr("far outside the image")));
  EXPECT_THAT(faults("458, 457, 367, 248", "480, 752"),
              ElementsAre(HasSubstr("is the middle of 752 x 480 pixels, not of the stated 480 x 752")));
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

TEST(CalibratedRig, TheRelativePoseOfAChainIsThatOfTheEntryBefore) {
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

TEST(CalibratedRig, APairOfOpenCvEqualsTheChainWithItsNumbers) {
  const auto matrix = [](const std::string& name, int rows, int cols, const std::string& data) {
    return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n", name, rows, cols,
                       data);
  };
  const std::string intrinsics = "%YAML:1.0\n---\n" + matrix("M1", 3, 3, "460., 0., 320., 0., 461., 240., 0., 0., 1.") +
                                 matrix("D1", 1, 5, "-0.2, 0.05, 0., 0., 0.") +
                                 matrix("M2", 3, 3, "461., 0., 320., 0., 461., 240., 0., 0., 1.") +
                                 matrix("D2", 1, 5, "0., 0., 0., 0., 0.");
  const auto extrinsics = [&](const std::string& T) {
    return matrix("R", 3, 3, "1., 0., 0., 0., 1., 0., 0., 0., 1.") + matrix("T", 3, 1, T);
  };
  Folder folder;
  Folder::write("pair.yml", intrinsics + extrinsics("-0.12, 0., 0."));
  Folder::write("chain.yaml", chain_of_two("left", "right"));
  const std::string sizes = "cameras: [{role: left, width: 640, height: 480}, {role: right, width: 640, height: 480}]}";
  const RigConfig pair = flown("{calibration: pair.yml, " + sizes).rig, chain = flown("{calibration: chain.yaml}").rig;
  for (const char* role : {"left", "right"}) {
    const CameraConfig &own = *pair.find(role), &other = *chain.find(role);
    EXPECT_EQ(own.focal_x_px, other.focal_x_px);
    EXPECT_EQ(own.X_BC().matrix(), other.X_BC().matrix());
  }
  EXPECT_THAT(pair.find("left")->distortion, ElementsAre(-0.2, 0.05, 0, 0, 0));
  EXPECT_EQ(parse_calibration(intrinsics, "calibration").size(), 2u);
  const std::string far = intrinsics + extrinsics("-120., 0., 0.");
  EXPECT_THAT(faults_of([&] { parse_calibration(far, "calibration"); }),
              ElementsAre(HasSubstr("120 m; state it in meters")));
}

TEST(CalibratedRig, AStereoPairRefusesAFileOfTwoCamerasUnlessOneIsNamed) {
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

TEST(CalibratedRig, AFileWithoutImageSizeNeedsOneFromTheCamera) {
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

/// Looks to the left, 1.5 m left of and 0.2 m above the body's origin.
constexpr const char* kToTheLeft = "body_from_camera: [1, 0, 0, 0.3, 0, 0, -1, -1.5, 0, 1, 0, -0.2, 0, 0, 0, 1]";

TEST(CalibratedRig, TheMatrixOfAPairIsThePoseOfItsMiddle) {
  Folder folder;
  Folder::write("chain.yaml", kFront);
  const std::string lens = "fov: 60", calibration = "calibration: chain.yaml";
  for (const std::string& given : {lens, calibration}) {
    const RigConfig rig = flown("{stereo: [{baseline: 0.4, " + given + ", " + kToTheLeft + "}]}").rig;
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Isometry3d X_BC = rig.find(side < 0.0 ? "left" : "right")->X_BC();
      EXPECT_NEAR((X_BC.translation() - Eigen::Vector3d(0.3 + 0.2 * side, -1.5, -0.2)).norm(), 0.0, 1e-15);
      EXPECT_EQ(Eigen::Vector3d(X_BC.linear().col(2)), Eigen::Vector3d(0.0, -1.0, 0.0));
    }
  }
  // Without a matrix of its own, a pair keeps its mounting.
  const RigConfig rig = flown("{stereo: [{baseline: 0.4, calibration: chain.yaml}]}").rig;
  EXPECT_EQ(Eigen::Vector3d(rig.find("right")->X_BC().translation()), Eigen::Vector3d(0.0, 0.2, 0.0));
}

TEST(CalibratedRig, APoseStatedTwiceIsRefused) {
  Folder folder;
  const auto faults = [](const std::string& list, const std::string& keys) {
    return faults_of([&] { flown("{" + list + ": [{" + keys + "}]}"); });
  };
  const auto twice = [](const std::string& key, const std::string& first) {
    return ElementsAre(HasSubstr("." + key + "': '" + first + "' states the pose already; valid: one matrix, or"));
  };
  const std::string matrix = kToTheLeft, quaternion = "quaternion: [1, 0, 0, 0]", camera = "role: a, ";
  EXPECT_THAT(faults("cameras", camera + matrix + ", pitch: 3"), twice("pitch", "body_from_camera"));
  EXPECT_THAT(faults("cameras", camera + matrix + ", " + quaternion), twice("quaternion", "body_from_camera"));
  EXPECT_THAT(faults("cameras", camera + matrix + ", down: 1"), twice("down", "body_from_camera"));
  EXPECT_THAT(
      faults("cameras", camera + matrix + ", imu_from_camera: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]"),
      twice("imu_from_camera", "body_from_camera"));
  EXPECT_THAT(faults("cameras", camera + quaternion + ", roll: 3"), twice("roll", "quaternion"));
  EXPECT_THAT(faults("cameras", camera + quaternion + ", down: 1"), ElementsAre());
  EXPECT_THAT(faults("stereo", matrix + ", forward: 1"), twice("forward", "body_from_camera"));
}

// The place of an error is a key that the user wrote: that of the camera, or the rig's `calibration`.
TEST(CalibratedRig, ErrorsOfTheRigsFileNameKeysOfTheRig) {
  Folder folder;
  Folder::write("chain.yaml", kFront);
  const auto faults = [](const std::string& keys) {
    return faults_of([&] { flown("{calibration: chain.yaml, cameras: [{role: front, " + keys + "}]}"); });
  };
  EXPECT_THAT(faults("forward: 1, yaw: 3, quaternion: [1, 0, 0, 0]"),
              ElementsAre(HasSubstr("'rig.cameras.0.yaw': 'quaternion' states the pose already")));
  EXPECT_THAT(faults("model: fisheye"), ElementsAre(HasSubstr("'rig.cameras.0.model': differs from that of the")));
  EXPECT_THAT(faults("fov: 60"), ElementsAre(HasSubstr("'rig.calibration': camera 'front': defines the lens")));
  std::string sheared = kFront;
  sheared.replace(sheared.find("0, 0, 0, 1"), 10, "0, 0, 1, 1");
  Folder::write("chain.yaml", sheared);
  EXPECT_THAT(faults("rate: 30"), ElementsAre(HasSubstr("'rig.calibration': camera 'front': camera_from_imu: its last "
                                                        "row must be 0 0 0 1")));
}

TEST(CalibratedRig, EachErrorOfAFileIsALine) {
  Folder folder;
  Folder::write("twice.yaml", "a: 1\na: 2\nb: 1\nb: 2\n");
  EXPECT_THAT(
      faults_of([] { flown("{cameras: [{role: front, calibration: twice.yaml}]}"); }),
      ElementsAre(AllOf(HasSubstr("'rig.cameras.0.calibration': "), HasSubstr("twice.yaml:2:1: duplicate key")),
                  AllOf(HasSubstr("'rig.cameras.0.calibration': "), HasSubstr("twice.yaml:4:1: duplicate key"))));
}

TEST(CalibratedRig, KeysThatContradictItAreRefused) {
  Folder folder;
  Folder::write("chain.yaml", kFront);
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
