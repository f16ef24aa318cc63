#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/sensors/imu.h"
#include "sim/scenario/calibration.h"

namespace hedgehop::sim {

/// A camera whose images are exported.
struct RecordedCamera {
  std::string role;
  int width_px = 0, height_px = 0;
  double rate_hz = 0.0;
  Intrinsics lens;
  Eigen::Isometry3d X_FC = Eigen::Isometry3d::Identity();       ///< as calibrated; from F, whose origin is the IMU
  Eigen::Isometry3d X_FC_true = Eigen::Isometry3d::Identity();  ///< where its images are taken from
  std::vector<int64_t> t_ns;                                    ///< of its images
};

struct RecordedReading {
  int64_t t_ns = 0;
  Eigen::Vector3d w_F, f_F;  ///< rad/s; specific force, m/s^2: at rest (0, 0, g)
};

/// Truth at the IMU.
struct RecordedState {
  int64_t t_ns = 0;
  Eigen::Isometry3d X_EF = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_EF_E;              ///< m/s
  Eigen::Vector3d w_bias_F, f_bias_F;  ///< of the readings; noise and misalignment come on top
};

/// Readings of a flight's sensors, in the frames of conventions.h.
struct SensorRecord {
  std::vector<RecordedCamera> cameras;
  dynamics::sensors::ImuConfig imu_config;
  std::vector<RecordedReading> imu;
  std::vector<RecordedState> states;  ///< at every reading and every image, by time
};

/// A file of a data set, its name relative to the set's folder.
struct DataFile {
  std::filesystem::path name;
  std::string text;
};

/// The state of an instant. Throws std::out_of_range unless the record has it.
const RecordedState& state_at(const SensorRecord& record, int64_t t_ns);

}  // namespace hedgehop::sim
