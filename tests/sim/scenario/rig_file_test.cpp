#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/config/outline_texts.h"
#include "sim/scenario/rig.h"
#include "sim/scenario/scenario.h"
#include "tests/sim/config/input_files.h"
#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kRigRadPerDeg = std::numbers::pi / 180.0;

/// The one camera of a rig file that has these keys and a role.
CameraConfig camera_of(const std::string& keys) {
  Folder::write("rig.yaml", "cameras:\n  - {role: a, " + keys + "}\n");
  return load_struct<RigConfig>("rig.yaml").cameras.at(0);
}

/// Why a camera's model is refused; empty when it is not.
std::string refusal(const std::string& keys) {
  try {
    camera_of(keys).model();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(RigFile, APinholeTakesOpenCvsNumbers) {
  Folder folder;
  const vision::camera::Camera camera =
      camera_of(
          "width: 640, height: 480, focal_x: 500, focal_y: 510, center_u: 300, center_v: 250, "
          "distortion: [-0.2, 0.05, 1e-3, -2e-3, 0.01]")
          .model();
  EXPECT_EQ(camera, vision::camera::Camera(
                        640, 480, vision::camera::PinholeLens{500, 510, 300, 250, -0.2, 0.05, 1e-3, -2e-3, 0.01}));
}

TEST(RigFile, TheFieldOfViewHoldsAcrossTheRowOfADistortedLens) {
  Folder folder;
  for (const std::string keys : {"fov: 100, distortion: [-0.1, 0.01, 0, 0]", "model: fisheye, fov: 190",
                                 "model: fisheye, fov: 120, distortion: [0.02, -0.003, 0, 0]"}) {
    const CameraConfig config = camera_of(keys + ", width: 500, height: 300");
    const double half_rad = 0.5 * config.fov_rad;
    for (const double side : {-1.0, 1.0}) {
      const auto edge = config.model().project({side * std::sin(half_rad), 0.0, std::cos(half_rad)});
      ASSERT_TRUE(edge.has_value()) << keys;
      EXPECT_NEAR(edge->x(), 249.5 + side * 250.0, 1e-9) << keys;
      EXPECT_NEAR(edge->y(), 149.5, 1e-9) << keys;
    }
  }
}

TEST(RigFile, AFisheyeEndsAtItsLimit) {
  Folder folder;
  const vision::camera::Camera camera = camera_of("model: fisheye, fov: 190, view_limit: 97").model();
  EXPECT_TRUE(camera.project({std::sin(96.9 * kRigRadPerDeg), 0, std::cos(96.9 * kRigRadPerDeg)}).has_value());
  EXPECT_FALSE(camera.project({std::sin(97.1 * kRigRadPerDeg), 0, std::cos(97.1 * kRigRadPerDeg)}).has_value());
}

TEST(RigFile, ACalibrationIsRelativeToTheFileThatNamesIt) {
  Folder folder;
  Folder::write("rigs/lens.txt", vision::kSmallCalibration);
  Folder::write("rigs/rig.yaml",
                "cameras:\n  - {role: a, model: ocam, calibration: lens.txt, width: 752, height: 480}\n");
  const CameraConfig camera = load_struct<RigConfig>("rigs/rig.yaml").cameras.at(0);
  EXPECT_EQ(camera.model(), vision::camera::Camera(vision::camera::parse_ocam_calibration(vision::kSmallCalibration)));
  EXPECT_TRUE(camera.calibration.is_absolute());

  // The written rig names the same file from any folder.
  RigConfig rig;
  rig.cameras = {camera};
  Folder::write("elsewhere/rig.yaml", yaml_text(outline_fields(rig)));
  EXPECT_EQ(load_struct<RigConfig>("elsewhere/rig.yaml").cameras.at(0).calibration, camera.calibration);
}

TEST(RigFile, RefusesKeysThatDoNotGoTogether) {
  Folder folder;
  EXPECT_EQ(refusal("fov: 90"), "");
  EXPECT_EQ(refusal("samples: 8"), "");
  EXPECT_THAT(refusal("samples: 6"), HasSubstr("samples: must be 1, 2, 4 or 8, got 6"));
  EXPECT_THAT(refusal("fov: 180"), HasSubstr("fov: a pinhole shows less than 180 deg"));
  EXPECT_THAT(refusal("distortion: [1, 2, 3]"), HasSubstr("distortion: a pinhole takes"));
  EXPECT_THAT(refusal("model: fisheye, distortion: [1]"), HasSubstr("distortion: a fisheye takes"));
  EXPECT_THAT(refusal("fov: 170, distortion: [-0.3, 0, 0, 0]"), HasSubstr("fov: the distortion folds"));
  EXPECT_THAT(refusal("model: fisheye, fov: 190, distortion: [-0.3, 0, 0, 0]"), HasSubstr("cannot show"));
  EXPECT_THAT(refusal("model: fisheye, view_limit: 170, fov: 90, distortion: [-0.3, 0, 0, 0]"),
              HasSubstr("folds back"));
  EXPECT_THAT(refusal("focal_y: 100"), HasSubstr("focal_y: needs focal_x"));
  EXPECT_THAT(refusal("view_limit: 60"), HasSubstr("view_limit: is for a fisheye"));
  EXPECT_THAT(refusal("model: ocam"), HasSubstr("calibration: model: ocam needs the file"));
  EXPECT_THAT(refusal("model: ocam, calibration: none.txt"), HasSubstr("there is no such file"));
  EXPECT_THAT(refusal("calibration: lens.txt"), HasSubstr("calibration: has not been applied"));
  Folder::write("lens.txt", vision::kSmallCalibration);
  EXPECT_THAT(refusal("model: ocam, calibration: lens.txt"), HasSubstr("width and height must be 752 and 480"));
  EXPECT_THAT(refusal("model: ocam, calibration: lens.txt, width: 752, height: 480, focal_x: 3"),
              HasSubstr("remove the other keys of the lens"));
  Folder::write("lens.txt", "5 1 2");
  EXPECT_THAT(refusal("model: ocam, calibration: lens.txt"), HasSubstr("lens.txt': OCamCalib calibration: direct"));
}

TEST(RigFile, AScenarioNamesThePlaceOfAFaultyLens) {
  const std::vector<std::string> faults = faults_of([] {
    load_scenario(kConfigs / "garratt2009_city_0.yaml",
                  std::vector<std::string>{"rig.cameras.2.model=fisheye", "rig.cameras.2.distortion=[1, 2]"});
  });
  EXPECT_THAT(faults, testing::Contains(HasSubstr("--set rig.cameras.2.distortion: 'rig.cameras.2.distortion'")));
  EXPECT_THAT(faults, testing::Contains(HasSubstr("needs camera 'front' to be an undistorted pinhole")));
}

TEST(RigFile, ARoleIsAName) {
  const auto faults = [](const std::string& list, const std::string& role) {
    return faults_of([&] {
      load_scenario(kConfigs / "garratt2009_city_0.yaml",
                    std::vector<std::string>{"rig." + list + "=[{role: \"" + role + "\"}]", "velocimeter.enabled=false",
                                             "avoidance={module: go_to_goal}"});
    });
  };
  EXPECT_THAT(faults("cameras", "../a: b"), ElementsAre(HasSubstr("role': must not contain '/'")));
  EXPECT_THAT(faults("stereo", "a/b"), testing::Contains(HasSubstr("role': must not contain '/'")));
  EXPECT_THAT(faults("cameras", ""), ElementsAre(HasSubstr("role': must not be empty")));
  EXPECT_THAT(faults("cameras", "front: 1"), ElementsAre());
}

TEST(RigFile, AStereoPairIsTwoParallelCamerasABaselineApart) {
  Folder folder;
  Folder::write("rig.yaml",
                "cameras: [{role: down, pitch: -90}]\n"
                "stereo:\n"
                "  - {baseline: 0.5, width: 320, height: 240, fov: 60, forward: 0.2, yaw: 30, pitch: -10, roll: 5}\n"
                "  - {role: rear, baseline: 0.1, yaw: 180, channel: color}\n");
  RigConfig rig = load_struct<RigConfig>("rig.yaml");
  mount_rig(rig);
  EXPECT_TRUE(rig.stereo.empty());
  std::vector<std::string> roles;
  for (const CameraConfig& camera : rig.cameras) roles.push_back(camera.role);
  EXPECT_THAT(roles, ElementsAre("down", "left", "right", "rear_left", "rear_right"));

  const CameraConfig &left = *rig.find("left"), &right = *rig.find("right");
  EXPECT_EQ(left.model(), right.model());
  EXPECT_EQ(left.X_BC().linear(), right.X_BC().linear());
  const Eigen::Isometry3d X_CCr = left.X_BC().inverse() * right.X_BC();
  EXPECT_NEAR((X_CCr.translation() - Eigen::Vector3d(0.5, 0, 0)).norm(), 0.0, 1e-15);
  const Eigen::Vector3d middle = 0.5 * (left.X_BC().translation() + right.X_BC().translation());
  EXPECT_NEAR((middle - Eigen::Vector3d(0.2, 0, 0)).norm(), 0.0, 1e-15);
  EXPECT_EQ(rig.find("rear_right")->channel, CameraConfig::Channel::color);
  // Looking aft, the right camera is on the vehicle's left.
  EXPECT_NEAR(rig.find("rear_right")->right_m, -0.05, 1e-15);
}

TEST(RigFile, AResolvedScenarioListsTheCamerasOfAPair) {
  Folder folder;
  const Scenario scenario = load_scenario(kConfigs / "garratt2009_city_0.yaml",
                                          std::vector<std::string>{"rig.stereo=[{role: eye, baseline: 0.3}]"});
  Folder::write("resolved.yaml", to_yaml(scenario));
  const Scenario again = load_scenario("resolved.yaml");
  ASSERT_EQ(again.rig.cameras.size(), 7u);
  EXPECT_EQ(again.rig.cameras[6].role, "eye_right");
  EXPECT_EQ(to_yaml(again), to_yaml(scenario));
}

TEST(RigFile, TheSensorIsThatOfEveryImageThatStatesNone) {
  Folder folder;
  Folder::write("sensors/dusk.yaml", "full_well: 1000\nread_noise: 3\n");
  Folder::write("rig.yaml",
                "sensor: {use: sensors/dusk.yaml}\n"
                "cameras:\n"
                "  - {role: grey}\n"
                "  - {role: color, channel: color}\n"
                "  - {role: depth, channel: depth}\n"
                "  - {role: corners, channel: corners}\n"
                "  - {role: own, imperfections: {read_noise: 7}}\n"
                "  - {role: clean, imperfections: {}}\n"
                "stereo: [{role: pair, baseline: 0.3}]\n");
  RigConfig rig = load_struct<RigConfig>("rig.yaml");
  mount_rig(rig);
  EXPECT_FALSE(rig.sensor.has_value());
  for (const std::string role : {"grey", "color", "pair_left", "pair_right"}) {
    const auto& imperfections = rig.find(role)->imperfections;
    ASSERT_TRUE(imperfections.has_value()) << role;
    EXPECT_EQ(imperfections->full_well, 1000.0) << role;
    EXPECT_EQ(imperfections->read_noise, 3.0) << role;
  }
  for (const std::string role : {"depth", "corners"}) EXPECT_FALSE(rig.find(role)->imperfections.has_value()) << role;
  EXPECT_EQ(rig.find("own")->imperfections->read_noise, 7.0);
  EXPECT_EQ(rig.find("own")->imperfections->full_well, 0.0);
  EXPECT_EQ(rig.find("clean")->imperfections->read_noise, 0.0);
}

/// Imperfections of the first camera of a scenario as it is flown.
ImperfectionsConfig flown_sensor(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return load_scenario(file, overrides).rig.cameras.at(0).imperfections.value();
}

TEST(RigFile, EveryPaperAndTheLeaderboardFlyBySunAndCanFlyInDullLight) {
  const std::filesystem::path worlds = kConfigs / "leaderboard/worlds";
  for (const std::string name : {"andert2007_tree_320.yaml", "garratt2009_city_22.yaml", "perez2018_route_light.yaml",
                                 "shah2009_highrise_forward.yaml", "zingg2010_bend.yaml"}) {
    EXPECT_EQ(flown_sensor(kConfigs / name, {}).full_well, 8000.0) << name;
    const ImperfectionsConfig dull = flown_sensor(kConfigs / name, {"rig.sensor.use=sensors/dull.yaml"});
    EXPECT_EQ(dull.full_well, 3000.0) << name;
    EXPECT_EQ(dull.vignetting, 0.2) << name;
    EXPECT_EQ(flown_sensor(kConfigs / name, {"rig.sensor.use=sensors/ideal.yaml"}).shutter_s, 0.0) << name;
  }
  const std::vector<std::string> garratt = {
      "vehicle.use=../../vehicles/electric_helicopter_8kg.yaml", "rig.use=../../rigs/garratt2009_200.yaml",
      "avoidance.use=../modules/flow_balance.yaml", "rig.sensor.use=../../sensors/dull.yaml"};
  EXPECT_EQ(flown_sensor(worlds / "city.yaml", garratt).full_well, 3000.0);
}

TEST(RigFile, AResolvedScenarioListsTheSensorWithTheCameras) {
  Folder folder;
  const Scenario scenario = load_scenario(kConfigs / "perez2018_route_light.yaml");
  Folder::write("resolved.yaml", to_yaml(scenario));
  const Scenario again = load_scenario("resolved.yaml");
  EXPECT_EQ(again.rig.cameras.at(0).imperfections.value().full_well, 8000.0);
  EXPECT_EQ(to_yaml(again), to_yaml(scenario));
}

}  // namespace
}  // namespace hedgehop::sim
