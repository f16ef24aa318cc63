#include "sim/export/formats.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/config/input_error.h"
#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

const std::filesystem::path kSequence = "sequences/00";

/// Returns a matrix of KITTI: three rows of four numbers.
std::string row_by_row(const Eigen::Matrix<double, 3, 4>& matrix) {
  std::string text;
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 4; ++col) text += fmt::format("{}{}", text.empty() ? "" : " ", matrix(row, col));
  }
  return text;
}

/// Returns the projection from the frame of the first camera to homogeneous pixels.
Eigen::Matrix<double, 3, 4> projection(const RecordedCamera& camera, const RecordedCamera& first) {
  Eigen::Matrix3d K;
  K << camera.lens.focal_x_px, 0, camera.lens.center_u_px,  //
      0, camera.lens.focal_y_px, camera.lens.center_v_px,   //
      0, 0, 1;
  return K * (camera.X_FC.inverse() * first.X_FC).matrix().topRows<3>();
}

void check(const SensorRecord& record) {
  for (const RecordedCamera& camera : record.cameras) {
    const bool distorted = std::ranges::any_of(camera.lens.distortion, [](double k) { return k != 0.0; });
    if (camera.lens.model != Intrinsics::Model::pinhole || distorted) {
      throw InputError(
          fmt::format("camera '{}': the KITTI format supports undistorted pinholes only; state fov, or focal_x, "
                      "focal_y, center_u and center_v, without distortion and calibration",
                      camera.role));
    }
    if (camera.rate_hz != record.cameras.front().rate_hz) {
      throw InputError(
          fmt::format("camera '{}' has {} images per second, '{}' has {}; the KITTI format requires one rate: select "
                      "cameras with --camera",
                      camera.role, camera.rate_hz, record.cameras.front().role, record.cameras.front().rate_hz));
    }
  }
}

}  // namespace

std::filesystem::path kitti_image(size_t camera, size_t number) {
  return kSequence / fmt::format("image_{}", camera) / fmt::format("{:06}.png", number);
}

std::vector<DataFile> kitti_files(const SensorRecord& record) {
  check(record);
  const RecordedCamera& first = record.cameras.at(0);
  std::string calib, times, poses, imu;
  // Readers expect the two grey and two color cameras of KITTI; fewer cameras repeat.
  constexpr size_t kCameras = 4;
  for (size_t i = 0; i < std::max(kCameras, record.cameras.size()); ++i) {
    calib += fmt::format("P{}: {}\n", i, row_by_row(projection(record.cameras[i % record.cameras.size()], first)));
  }
  const std::string imu_to_camera = row_by_row(first.X_FC.inverse().matrix().topRows<3>());
  calib += fmt::format("Tr: {0}\nTr_imu_to_cam0: {0}\n", imu_to_camera);
  for (const int64_t t_ns : first.t_ns) {
    const Eigen::Isometry3d X_EC = state_at(record, t_ns).X_EF * first.X_FC_true;
    const Eigen::Isometry3d X_EC_first = state_at(record, first.t_ns.front()).X_EF * first.X_FC_true;
    times += fmt::format("{:.9f}\n", seconds(t_ns));
    poses += row_by_row((X_EC_first.inverse() * X_EC).matrix().topRows<3>()) + "\n";
  }
  for (const RecordedReading& r : record.imu) {
    imu += fmt::format("{:.9f} {} {} {} {} {} {}\n", seconds(r.t_ns), r.w_F.x(), r.w_F.y(), r.w_F.z(), r.f_F.x(),
                       r.f_F.y(), r.f_F.z());
  }
  return {{kSequence / "calib.txt", calib},
          {kSequence / "times.txt", times},
          {kSequence / "imu.txt", imu},
          {"poses/00.txt", poses}};
}

}  // namespace hedgehop::sim
