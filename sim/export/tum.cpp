#include "sim/export/formats.h"

#include <fmt/format.h>

#include <array>

#include "sim/config/numbers.h"

namespace hedgehop::sim {
namespace {

/// Returns a time of the flight as a time stamp in seconds.
std::string seconds(int64_t t_ns) {
  const int64_t stamp_ns = kStartTimeNs + t_ns;
  return fmt::format("{}.{:09}", stamp_ns / 1'000'000'000, stamp_ns % 1'000'000'000);
}

std::string image_list(const char* title, const std::vector<int64_t>& t_ns, std::filesystem::path (*file)(int64_t)) {
  std::string text = fmt::format("# {}\n# of a simulated flight\n# timestamp filename\n", title);
  for (const int64_t t : t_ns) text += fmt::format("{} {}\n", seconds(t), file(t).string());
  return text;
}

std::string truth(const SensorRecord& record) {
  std::string text = "# ground truth trajectory\n# of a simulated flight\n# timestamp tx ty tz qx qy qz qw\n";
  for (const RecordedState& state : record.states) {
    const Eigen::Isometry3d X_EC = state.X_EF * record.cameras.at(0).X_FC_true;
    const Eigen::Vector3d p = X_EC.translation();
    const Eigen::Quaterniond q(X_EC.linear());
    text +=
        fmt::format("{} {} {} {} {} {} {} {}\n", seconds(state.t_ns), p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

std::string readings(const char* title, const char* columns, const SensorRecord& record,
                     Eigen::Vector3d RecordedReading::*member) {
  std::string text = fmt::format("# {}\n# of a simulated flight\n# timestamp {}\n", title, columns);
  for (const RecordedReading& reading : record.imu) {
    const Eigen::Vector3d& v = reading.*member;
    text += fmt::format("{} {} {} {}\n", seconds(reading.t_ns), v.x(), v.y(), v.z());
  }
  return text;
}

std::string calibration(const RecordedCamera& camera) {
  const Intrinsics& lens = camera.lens;
  const std::array<double, 9> matrix = {
      lens.focal_x_px, 0, lens.center_u_px, 0, lens.focal_y_px, lens.center_v_px, 0, 0, 1};
  std::string pose;
  for (int row = 0; row < 4; ++row) {
    const Eigen::RowVector4d r = camera.X_FC.matrix().row(row);
    pose += fmt::format("{}{}", row == 0 ? "" : ",\n          ", yaml_1_1_list({r.data(), 4}));
  }
  return fmt::format(
      "%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\ndepth_per_meter: {:.1f}\n"
      "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [{}]\n"
      "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: {}\n   dt: d\n   data: [{}]\n"
      "imu_from_camera: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [{}]\n",
      camera.width_px, camera.height_px, kTumDepthPerMeter, yaml_1_1_list(matrix), lens.distortion.size(),
      yaml_1_1_list(lens.distortion), pose);
}

}  // namespace

std::filesystem::path tum_image(int64_t t_ns) { return std::filesystem::path("rgb") / (seconds(t_ns) + ".png"); }
std::filesystem::path tum_depth(int64_t t_ns) { return std::filesystem::path("depth") / (seconds(t_ns) + ".png"); }

std::vector<DataFile> tum_files(const SensorRecord& record) {
  const RecordedCamera& camera = record.cameras.at(0);
  return {{"rgb.txt", image_list("color images", camera.t_ns, tum_image)},
          {"depth.txt", image_list("depth maps", camera.t_ns, tum_depth)},
          {"groundtruth.txt", truth(record)},
          {"accelerometer.txt", readings("accelerometer data", "ax ay az", record, &RecordedReading::f_F)},
          {"gyroscope.txt", readings("gyroscope data", "wx wy wz", record, &RecordedReading::w_F)},
          {"calibration.yaml", calibration(camera)}};
}

}  // namespace hedgehop::sim
