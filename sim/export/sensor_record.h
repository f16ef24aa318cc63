#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/sensors/imu.h"
#include "sim/scenario/calibration.h"

namespace hedgehop::sim {

// The conversion to the frames of other programs. E: east, north, up, with the origin of W. F: the IMU's
// (sim/scenario/calibration.h). Camera frames are unchanged: right, down, forward.

/// Start of a flight in the time stamps of data sets, ns since 1970: their readers need 19 digits.
inline constexpr int64_t kStartTimeNs = 1'600'000'000'000'000'000;

/// Rotation from W to E.
inline Eigen::Matrix3d R_EW() {
  Eigen::Matrix3d R;
  R << 0, 1, 0,  //
      1, 0, 0,   //
      0, 0, -1;
  return R;
}

/// Returns the pose in E of the F frame that belongs to a frame along B's axes. Both have the same origin.
inline Eigen::Isometry3d X_EF(const Eigen::Isometry3d& X_WB) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = R_EW() * X_WB.linear() * R_FB().transpose();
  X.translation() = R_EW() * X_WB.translation();
  return X;
}

/// A camera whose images are exported.
struct RecordedCamera {
  std::string role;
  int width_px = 0, height_px = 0;
  double rate_hz = 0.0;
  Intrinsics lens;
  Eigen::Isometry3d X_FC = Eigen::Isometry3d::Identity();       ///< calibrated pose
  Eigen::Isometry3d X_FC_true = Eigen::Isometry3d::Identity();  ///< true pose
  std::vector<int64_t> t_ns;                                    ///< of the images
};

struct RecordedReading {
  int64_t t_ns = 0;
  Eigen::Vector3d w_F, f_F;  ///< rad/s; specific force, m/s^2: (0, 0, g) at rest
};

/// The true state of the IMU.
struct RecordedState {
  int64_t t_ns = 0;
  Eigen::Isometry3d X_EF = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_EF_E;              ///< m/s
  Eigen::Vector3d w_bias_F, f_bias_F;  ///< of the readings, without noise and misalignment
};

/// The sensor readings of a flight.
struct SensorRecord {
  std::vector<RecordedCamera> cameras;
  dynamics::sensors::ImuConfig imu_config;
  std::vector<RecordedReading> imu;
  std::vector<RecordedState> states;  ///< at each reading and each image, in the order of time
};

/// A file of a data set. `name` is relative to the folder of the set.
struct DataFile {
  std::filesystem::path name;
  std::string text;
};

/// Returns the state at an instant. Throws std::out_of_range if the record has no state there.
const RecordedState& state_at(const SensorRecord& record, int64_t t_ns);

}  // namespace hedgehop::sim
