#include "sim/export/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "sim/config/input_error.h"
#include "sim/config/numbers.h"
#include "sim/config/outline_texts.h"
#include "sim/record/table.h"

namespace hedgehop::sim {
namespace {

const std::filesystem::path kRoot = "mav0";

std::filesystem::path camera_folder(size_t camera) { return kRoot / fmt::format("cam{}", camera); }

std::string pose(const Eigen::Isometry3d& X) {
  std::string text = "T_BS:\n  cols: 4\n  rows: 4\n  data: [";
  for (int row = 0; row < 4; ++row) {
    const Eigen::RowVector4d r = X.matrix().row(row);
    text += fmt::format("{}{}", row == 0 ? "" : ",\n         ", yaml_1_1_list({r.data(), 4}));
  }
  return text + "]\n";
}

/// A lens as sensor.yaml names it. Unified and double-sphere lenses have the names and the order of Kalibr.
struct SensorLens {
  std::string_view camera_model, distortion_model;
  std::vector<double> intrinsics, distortion;
};

SensorLens sensor_lens(const std::string& role, const Intrinsics& lens) {
  SensorLens sensor{"pinhole",
                    "radial-tangential",
                    {lens.focal_x_px, lens.focal_y_px, lens.center_u_px, lens.center_v_px},
                    lens.distortion};
  switch (lens.model) {
    case Intrinsics::Model::pinhole:
      if (std::any_of(lens.distortion.begin() + 4, lens.distortion.end(), [](double k) { return k != 0.0; })) {
        throw InputError(fmt::format("camera '{}': the EuRoC format does not support k3 to k6", role));
      }
      sensor.distortion.resize(4);
      break;
    case Intrinsics::Model::fisheye:
      sensor.distortion_model = "equidistant";
      break;
    case Intrinsics::Model::unified:
      sensor.camera_model = "omni";
      sensor.intrinsics.insert(sensor.intrinsics.begin(), lens.xi);
      break;
    case Intrinsics::Model::double_sphere:
      sensor.camera_model = "ds";
      sensor.distortion_model = "none";
      sensor.intrinsics.insert(sensor.intrinsics.begin(), {lens.xi, lens.alpha});
      break;
  }
  return sensor;
}

std::string camera_sensor(const RecordedCamera& camera) {
  const SensorLens lens = sensor_lens(camera.role, camera.lens);
  return fmt::format(
      "sensor_type: camera\ncomment: {}\n{}rate_hz: {}\nresolution: [{}, {}]\ncamera_model: {}\n"
      "intrinsics: [{}]\ndistortion_model: {}\ndistortion_coefficients: [{}]\n",
      yaml_quoted(camera.role), pose(camera.X_FC), camera.rate_hz, camera.width_px, camera.height_px, lens.camera_model,
      yaml_1_1_list(lens.intrinsics), lens.distortion_model, yaml_1_1_list(lens.distortion));
}

std::string camera_data(const RecordedCamera& camera) {
  std::string text = "#timestamp [ns],filename\n";
  for (const int64_t t_ns : camera.t_ns) text += fmt::format("{0},{0}.png\n", kStartTimeNs + t_ns);
  return text;
}

std::string imu_sensor(const dynamics::sensors::ImuConfig& imu) {
  return fmt::format(
      "sensor_type: imu\ncomment: of the flight computer\n{}rate_hz: {}\ngyroscope_noise_density: {}\n"
      "gyroscope_random_walk: {}\naccelerometer_noise_density: {}\naccelerometer_random_walk: {}\n",
      pose(Eigen::Isometry3d::Identity()), imu.rate_hz, yaml_1_1_number(imu.gyro_noise_density),
      yaml_1_1_number(imu.gyro_bias_walk), yaml_1_1_number(imu.accelerometer_noise_density),
      yaml_1_1_number(imu.accelerometer_bias_walk));
}

std::string imu_data(const SensorRecord& record) {
  fmt::memory_buffer out;
  out.append(
      std::string_view("#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
                       "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n"));
  for (const RecordedReading& reading : record.imu) {
    CsvLine(out).add(fmt::to_string(kStartTimeNs + reading.t_ns)).add(reading.w_F).add(reading.f_F);
  }
  return fmt::to_string(out);
}

std::string truth_data(const SensorRecord& record) {
  fmt::memory_buffer out;
  out.append(std::string_view(
      "#timestamp,p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z [],"
      "v_RS_R_x [m s^-1],v_RS_R_y [m s^-1],v_RS_R_z [m s^-1],b_w_RS_S_x [rad s^-1],b_w_RS_S_y [rad s^-1],"
      "b_w_RS_S_z [rad s^-1],b_a_RS_S_x [m s^-2],b_a_RS_S_y [m s^-2],b_a_RS_S_z [m s^-2]\n"));
  for (const RecordedState& state : record.states) {
    const Eigen::Quaterniond q(state.X_EF.linear());
    CsvLine(out)
        .add(fmt::to_string(kStartTimeNs + state.t_ns))
        .add(Eigen::Vector3d(state.X_EF.translation()))
        .add(q.w())
        .add(Eigen::Vector3d(q.vec()))
        .add(state.v_EF_E)
        .add(state.w_bias_F)
        .add(state.f_bias_F);
  }
  return fmt::to_string(out);
}

}  // namespace

std::filesystem::path euroc_image(size_t camera, int64_t t_ns) {
  return camera_folder(camera) / "data" / fmt::format("{}.png", kStartTimeNs + t_ns);
}

std::vector<DataFile> euroc_files(const SensorRecord& record) {
  std::vector<DataFile> files{{kRoot / "body.yaml", "comment: forward, left, up; origin at the IMU\n"}};
  for (size_t i = 0; i < record.cameras.size(); ++i) {
    files.push_back({camera_folder(i) / "sensor.yaml", camera_sensor(record.cameras[i])});
    files.push_back({camera_folder(i) / "data.csv", camera_data(record.cameras[i])});
  }
  files.push_back({kRoot / "imu0/sensor.yaml", imu_sensor(record.imu_config)});
  files.push_back({kRoot / "imu0/data.csv", imu_data(record)});
  const std::filesystem::path truth = kRoot / "state_groundtruth_estimate0";
  files.push_back({truth / "sensor.yaml", "sensor_type: groundtruth\ncomment: truth of the simulator\n" +
                                              pose(Eigen::Isometry3d::Identity())});
  files.push_back({truth / "data.csv", truth_data(record)});
  return files;
}

}  // namespace hedgehop::sim
