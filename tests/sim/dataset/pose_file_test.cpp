// Trajectories of other programs: equal motions in every format.
#include "sim/dataset/pose_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/libm/random.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A motion of the body in W: north, east, down; roll, pitch, yaw.
struct Motion {
  double t_s;
  Eigen::Vector3d p_W, rpy_rad;
};

std::vector<Motion> some_motion() {
  std::mt19937_64 random(41);
  std::vector<Motion> motion;
  for (int i = 0; i < 20; ++i) {
    const auto some = [&](double most) {
      return Eigen::Vector3d(uniform(random, -most, most), uniform(random, -most, most), uniform(random, -most, most));
    };
    motion.push_back({0.1 * i, some(50.0), some(1.2)});
  }
  return motion;
}

/// The rotation matrix from B to W by its elementary turns, written out.
Eigen::Matrix3d R_WB_of(const Eigen::Vector3d& rpy) {
  const double cr = std::cos(rpy.x()), sr = std::sin(rpy.x()), cp = std::cos(rpy.y()), sp = std::sin(rpy.y()),
               cy = std::cos(rpy.z()), sy = std::sin(rpy.z());
  Eigen::Matrix3d R;
  R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
      -sp, cp * sr, cp * cr;
  return R;
}

const Eigen::Vector3d kImuM(0.1, -0.2, 0.05);

/// The pose of the IMU in east, north, up with the axes forward, left, up.
std::pair<Eigen::Vector3d, Eigen::Quaterniond> exported(const Motion& m) {
  const Eigen::Matrix3d R_WB = R_WB_of(m.rpy_rad);
  const Eigen::Vector3d p_W = m.p_W + R_WB * kImuM;
  Eigen::Matrix3d to_E, flu;
  to_E << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  flu = Eigen::Vector3d(1, -1, -1).asDiagonal();
  return {to_E * p_W, Eigen::Quaterniond(Eigen::Matrix3d(to_E * R_WB * flu))};
}

void expect_motion(const std::vector<TimedPose>& poses, double t_error_s = 1e-12) {
  const std::vector<Motion> motion = some_motion();
  ASSERT_EQ(poses.size(), motion.size());
  for (size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(poses[i].t_s, motion[i].t_s, t_error_s);
    EXPECT_NEAR((poses[i].pose_W.translation() - motion[i].p_W).norm(), 0.0, 1e-9);
    EXPECT_NEAR((poses[i].pose_W.linear() - R_WB_of(motion[i].rpy_rad)).norm(), 0.0, 1e-9);
  }
}

TEST(PoseFile, EveryFormatGivesTheMotionOfTheBody) {
  std::string own = "t_s,north_m,east_m,down_m,roll_rad,pitch_rad,yaw_rad,speed,unknown\n",
              euroc = "#timestamp [ns],p_RS_R_x [m]\n", tum = "# ground truth\n# timestamp tx ty tz qx qy qz qw\n",
              table = "time, qw, qx, qy, qz, x, y, z\n";
  for (const Motion& m : some_motion()) {
    own += fmt::format("{},{},{},{},{},{},{},7,\n", m.t_s, m.p_W.x(), m.p_W.y(), m.p_W.z(), m.rpy_rad.x(),
                       m.rpy_rad.y(), m.rpy_rad.z());
    const auto [p, q] = exported(m);
    const int64_t ns = std::llround(m.t_s * 1e9);
    euroc += fmt::format("{},{},{},{},{},{},{},{},0,0,0\n", 1403636579763555584 + ns, p.x(), p.y(), p.z(), q.w(), q.x(),
                         q.y(), q.z());
    tum += fmt::format("{}.{:09} {} {} {} {} {} {} {}\n", 1305031102 + ns / 1'000'000'000, ns % 1'000'000'000, p.x(),
                       p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
    table += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}\n", m.t_s, q.w(), q.x(), q.y(), q.z(), p.x(), p.y(), p.z());
  }
  const PoseReading reading{.p_BI_m = kImuM};
  expect_motion(parse_poses(own, "own", reading));
  expect_motion(parse_poses(euroc, "euroc", reading));
  expect_motion(parse_poses(tum, "tum", reading));
  expect_motion(parse_poses(table, "table", reading));
  expect_motion(parse_poses("\xef\xbb\xbf" + table, "table of Excel", reading));
  expect_motion(parse_poses("\xef\xbb\xbf" + euroc, "euroc of PowerShell", reading));
}

TEST(PoseFile, CameraPosesKeepTheCamerasAxes) {
  // A camera at (1, 2, 3) in east, north, up that looks north: right is east, down is -up.
  const Eigen::Matrix3d R_EC = (Eigen::Matrix3d() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
  const Eigen::Quaterniond q(R_EC);
  const auto poses = parse_poses(
      fmt::format("5 1 2 3 {} {} {} {}\n6 1 2 3 {} {} {} {}\n", q.x(), q.y(), q.z(), q.w(), q.x(), q.y(), q.z(), q.w()),
      "tum", {.of_camera = true});
  EXPECT_NEAR((poses[1].pose_W.translation() - Eigen::Vector3d(2, 1, -3)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((poses[1].pose_W.linear().col(2) - Eigen::Vector3d::UnitX()).norm(), 0.0, 1e-12);  // looks north
  EXPECT_NEAR((poses[1].pose_W.linear().col(1) - Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_EQ(poses[1].t_s, 1.0);
}

TEST(PoseFile, KittiIsRelativeToTheFirstPose) {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.translation() = Eigen::Vector3d(10, 20, -5);
  const auto poses = parse_poses("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0.5 0 1 0 0 0 0 1 2\n", "kitti",
                                 {.of_camera = true, .first_pose_W = X_WC});
  EXPECT_EQ(Eigen::Vector3d(poses[0].pose_W.translation()), Eigen::Vector3d(10, 20, -5));
  EXPECT_EQ(Eigen::Vector3d(poses[1].pose_W.translation()), Eigen::Vector3d(10.5, 20, -3));
  EXPECT_THAT(faults_of([] { parse_poses("1 0 0 0 0 1 0 0 0 0 1 0\n", "kitti", {}); }),
              ElementsAre(HasSubstr("--pose-of")));
}

TEST(PoseFile, TimesOfOwnDataSetsAreThoseOfTheFlight) {
  EXPECT_NEAR(parse_poses("1600000002.040000000 0 0 0 0 0 0 1\n", "tum", {})[0].t_s, 2.04, 1e-9);
  EXPECT_EQ(parse_poses("1600000003500000000,0,0,0,1,0,0,0\n", "euroc", {})[0].t_s, 3.5);
}

TEST(PoseFile, WholeTimesOfATableFrom1e12AreInNanoseconds) {
  const std::string head = "timestamp,x,y,z,qx,qy,qz,qw\n", pose = ",0,0,10,0,0,0,1\n";
  const auto poses = parse_poses(head + "1403636579763555584" + pose + "1403636579813555585" + pose, "table", {});
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].t_s, 0.0);
  EXPECT_NEAR(poses[1].t_s, 0.050000001, 1e-12);
}

TEST(PoseFile, RefusesTimesBeyond64BitsOfNanoseconds) {
  const std::string own = "t_s,north_m,east_m,down_m,roll_rad,pitch_rad,yaw_rad\n",
                    table = "t,x,y,z,qx,qy,qz,qw\n1,0,0,0,0,0,0,1\n";
  const std::string in_s = " s is out of range; valid: -4e9 to 4e9 s; state the time in s",
                    in_ns = " ns is out of range; valid: -4e9 to 4e9 s";
  for (const auto& [text, fault] :
       {std::pair{own + "1e300,0,0,0,0,0,0\n", "poses:2: the time 1e300" + in_s},
        {table + "99999999999,0,0,0,0,0,0,1\n", "poses:3: the time 99999999999" + in_s},
        {std::string("-99999999999.5 0 0 0 0 0 0 1\n"), "poses:1: the time -99999999999.5" + in_s},
        {std::string("9223372036854775807,0,0,0,1,0,0,0\n"), "poses:1: the time 9223372036854775807" + in_ns}}) {
    EXPECT_THAT(faults_of([&] { parse_poses(text, "poses", {}); }), ElementsAre(fault));
  }
}

TEST(PoseFile, RefusesOtherContentWithItsLine) {
  const auto fault = [](const std::string& text) {
    const auto faults = faults_of([&] { parse_poses(text, "poses", {}); });
    return faults.empty() ? std::string() : faults[0];
  };
  EXPECT_THAT(fault(""), HasSubstr("has no poses; valid: trajectory.csv"));
  EXPECT_THAT(fault("1 2 3\n"), HasSubstr("poses:1: 3 numbers; valid"));
  EXPECT_THAT(fault("0 0 0 0 0 0 0 1\n1 0 0 x 0 0 0 1\n"), HasSubstr("poses:2: expected a number, got 'x'"));
  EXPECT_THAT(fault("0 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n"), HasSubstr("poses:2: the times must increase"));
  EXPECT_THAT(fault("0 0 0 0 0 0 0 2\n"), HasSubstr("length 1"));
  EXPECT_THAT(fault("a,b\n1,2\n"), HasSubstr("has no column 't'"));
  EXPECT_THAT(fault("0 nan 0 0 0 0 0 1\n"), HasSubstr("expected a number"));
}

}  // namespace
}  // namespace hedgehop::sim
