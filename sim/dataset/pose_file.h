#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

namespace hedgehop::sim {

/// A pose in W at a time of the flight.
struct TimedPose {
  double t_s = 0.0;
  Eigen::Isometry3d pose_W = Eigen::Isometry3d::Identity();  ///< of the body or of a camera
};

/// How the poses of a file are to be understood.
struct PoseReading {
  bool of_camera = false;  ///< poses of a camera (right, down, forward) instead of the body
  Eigen::Vector3d p_BI_m =
      Eigen::Vector3d::Zero();  ///< position of the IMU, to which other programs' poses of the body refer
  Eigen::Isometry3d first_pose_W = Eigen::Isometry3d::Identity();  ///< of the first pose, for a file of relative poses
};

/// Reads a trajectory. The format follows from the content:
/// - Hedgehop's trajectory.csv: columns t_s, north_m, east_m, down_m, roll_rad, pitch_rad, yaw_rad, of the body;
/// - a table with the columns t (or time, timestamp), x, y, z, qx, qy, qz, qw: east, north, up. Its times are in s, or
///   in ns if the first one is a whole number of at least 1e12, as the time stamps of ROS are;
/// - EuRoC, state_groundtruth_estimate0/data.csv: ns, p, q (w x y z), ...;
/// - TUM: t x y z qx qy qz qw, t in s;
/// - KITTI: 12 numbers of a 3 x 4 matrix relative to the first camera, ten per second.
/// Poses of the body in other programs' formats are those of the IMU: forward, left, up. Times of Hedgehop's own data
/// sets are those of the flight; other times count from the first. Throws InputError with file, line and the valid
/// formats, also for a time beyond 4e9 s.
std::vector<TimedPose> parse_poses(const std::string& text, const std::string& file, const PoseReading& reading);

}  // namespace hedgehop::sim
