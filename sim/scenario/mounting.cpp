#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "sim/config/include.h"
#include "sim/config/input_error.h"
#include "sim/fields/invalid_field.h"
#include "sim/scenario/calibration.h"
#include "sim/scenario/calibration_file.h"
#include "sim/scenario/calibration_text.h"
#include "sim/scenario/rig.h"

namespace hedgehop::sim {
namespace {

using fields::require;

/// Returns the rotation nearest to a matrix that is one within the digits of a file; unchanged if it is exact.
Eigen::Matrix3d rotation(const Eigen::Matrix3d& R, std::string_view key) {
  constexpr double kRounded = 1e-12, kMaxError = 1e-3;
  const double error = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
  require(error <= kMaxError && R.determinant() > 0.0, key, "its first three columns and rows are no rotation");
  return error <= kRounded ? R : Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

/// Returns the pose of a 4 x 4 matrix, row by row.
Eigen::Isometry3d pose(const std::vector<double>& numbers, std::string_view key) {
  require(numbers.size() == 16, key, fmt::format("must have 16 numbers, got {}", numbers.size()));
  const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  require(matrix.row(3) == Eigen::RowVector4d(0, 0, 0, 1), key, "its last row must be 0 0 0 1");
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = rotation(matrix.topLeftCorner<3, 3>(), key);
  X.translation() = matrix.topRightCorner<3, 1>();
  return X;
}

void clear_matrices(CameraConfig& c) {
  for (std::vector<double>* matrix : {&c.body_from_camera, &c.imu_from_camera, &c.camera_from_imu}) matrix->clear();
}

std::vector<double> row_by_row(const Eigen::Isometry3d& X) {
  std::vector<double> numbers;
  for (const auto& row : X.matrix().rowwise()) numbers.insert(numbers.end(), row.begin(), row.end());
  return numbers;
}

bool has_matrix(const CameraConfig& c) {
  return !c.body_from_camera.empty() || !c.imu_from_camera.empty() || !c.camera_from_imu.empty() ||
         !c.camera_from_previous.empty();
}

/// Return the first key of the position or of the angles that is not 0, or "".
std::string_view position_key(const CameraConfig& c) {
  return c.forward_m != 0.0 ? "forward" : c.right_m != 0.0 ? "right" : c.down_m != 0.0 ? "down" : "";
}
std::string_view angle_key(const CameraConfig& c) {
  return c.yaw_rad != 0.0 ? "yaw" : c.pitch_rad != 0.0 ? "pitch" : c.roll_rad != 0.0 ? "roll" : "";
}

/// Whether position or angles are set.
bool has_mounting(const CameraConfig& c) {
  return !position_key(c).empty() || !angle_key(c).empty() || !c.quaternion.empty();
}

/// Refuses a pose that is stated twice.
void require_one_pose(const CameraConfig& c) {
  std::string_view first;
  const auto state = [&](std::string_view key, bool is_stated) {
    if (!is_stated) return;
    require(first.empty(), key,
            fmt::format("'{}' states the pose already; valid: one matrix, or a position with a quaternion or with yaw, "
                        "pitch and roll",
                        first));
    first = key;
  };
  state("body_from_camera", !c.body_from_camera.empty());
  state("imu_from_camera", !c.imu_from_camera.empty());
  state("camera_from_imu", !c.camera_from_imu.empty());
  if (!first.empty()) state(position_key(c), !position_key(c).empty());
  state("quaternion", !c.quaternion.empty());
  state(angle_key(c), !angle_key(c).empty());
}

/// Whether a camera states its size. The default counts if the optical axis of the calibration is near its middle.
bool states_size(const CameraConfig& camera, const CameraConfig& calibrated) {
  constexpr double kMaxShift = 0.1;  // of the axis, share of the size
  const CameraConfig fresh;
  const auto is_stated = [](int size_px, int default_px, double center_px) {
    return size_px != default_px || std::abs(center_px - 0.5 * size_px) <= kMaxShift * size_px;
  };
  return is_stated(camera.width_px, fresh.width_px, calibrated.center_u_px.value_or(0.0)) &&
         is_stated(camera.height_px, fresh.height_px, calibrated.center_v_px.value_or(0.0));
}

/// Gives the lens, the size and, unless the camera states its own, the pose of a calibration to a camera.
void apply(const CameraConfig& calibrated, CameraConfig& camera) {
  const CameraConfig fresh;
  require(!camera.focal_x_px && !camera.focal_y_px && !camera.center_u_px && !camera.center_v_px &&
              camera.distortion.empty() && !camera.xi && !camera.alpha && camera.fov_rad == fresh.fov_rad,
          "calibration", "defines the lens; remove the other keys of the lens");
  require(calibrated.width_px > 0 || states_size(camera, calibrated), "calibration",
          "the file has no image size; state width and height");
  require(camera.model_kind == fresh.model_kind || camera.model_kind == calibrated.model_kind, "model",
          "differs from that of the calibration");
  if (calibrated.width_px > 0) {
    const bool is_default = camera.width_px == fresh.width_px && camera.height_px == fresh.height_px;
    require(is_default || (camera.width_px == calibrated.width_px && camera.height_px == calibrated.height_px), "width",
            fmt::format("the calibration is of {} x {} pixels", calibrated.width_px, calibrated.height_px));
    camera.width_px = calibrated.width_px;
    camera.height_px = calibrated.height_px;
  }
  camera.model_kind = calibrated.model_kind;
  camera.focal_x_px = calibrated.focal_x_px;
  camera.focal_y_px = calibrated.focal_y_px;
  camera.center_u_px = calibrated.center_u_px;
  camera.center_v_px = calibrated.center_v_px;
  camera.distortion = calibrated.distortion;
  camera.xi = calibrated.xi;
  camera.alpha = calibrated.alpha;
  if (has_mounting(camera) || has_matrix(camera)) return;
  camera.body_from_camera = calibrated.body_from_camera;
  camera.imu_from_camera = calibrated.imu_from_camera;
  camera.camera_from_imu = calibrated.camera_from_imu;
  camera.camera_from_previous = calibrated.camera_from_previous;
}

std::vector<CalibratedCamera> read_calibration(const std::string& text, const std::filesystem::path& file) {
  try {
    return parse_calibration(text, file.string());
  } catch (const InputError& error) {
    throw fields::InvalidField("calibration", error.what());
  }
}

std::string text_of(const std::filesystem::path& file) {
  try {
    return read_input_file(file);
  } catch (const std::invalid_argument& error) {
    throw fields::InvalidField("calibration", fmt::format("'{}': {}", file.string(), error.what()));
  }
}

/// Returns the entry of a file for a camera.
const CalibratedCamera& entry_for(const CameraConfig& camera, const std::vector<CalibratedCamera>& entries) {
  const std::string& wanted = camera.calibration_camera.empty() ? camera.role : camera.calibration_camera;
  std::vector<std::string> names;
  for (const CalibratedCamera& entry : entries) {
    if (entry.name == wanted || entry.role == wanted) return entry;
    names.push_back(entry.name);
  }
  if (entries.size() == 1 && camera.calibration_camera.empty()) return entries.front();
  throw fields::InvalidField("calibration_camera",
                             fmt::format("the file has no camera '{}'; valid: {}", wanted, fmt::join(names, ", ")));
}

/// @param is_pair  whether the camera stands for both of a stereo pair.
void apply_own_calibration(CameraConfig& camera, bool is_pair, std::vector<std::filesystem::path>& read) {
  if (camera.calibration.empty()) return;
  const std::string text = text_of(camera.calibration);
  if (camera.model_kind == CameraConfig::Model::ocam || is_ocam_calibration(text)) {
    CameraConfig omnidirectional{.model_kind = CameraConfig::Model::ocam};
    try {
      const vision::camera::OcamCalibration calibration = vision::camera::parse_ocam_calibration(text);
      omnidirectional.width_px = calibration.width_px;
      omnidirectional.height_px = calibration.height_px;
    } catch (const std::invalid_argument& error) {
      throw fields::InvalidField("calibration", fmt::format("'{}': {}", camera.calibration.string(), error.what()));
    }
    apply(omnidirectional, camera);
    return;
  }
  const std::vector<CalibratedCamera> entries = read_calibration(text, camera.calibration);
  require(!is_pair || entries.size() == 1 || !camera.calibration_camera.empty(), "calibration",
          fmt::format("the file has {} cameras, but those of a stereo pair are equal; state it as 'rig.calibration' "
                      "instead of 'stereo', or name the one for both by 'calibration_camera' and state 'baseline'",
                      entries.size()));
  CameraConfig calibrated = entry_for(camera, entries).config;
  calibrated.camera_from_previous.clear();  // the camera before is not part of this rig
  apply(calibrated, camera);
  read.push_back(std::exchange(camera.calibration, {}));
  camera.calibration_camera.clear();
}

/// Applies the rig's file; a pose that refers to the camera before becomes one in B. @param p_BI_m  as mount_rig()'s.
void apply_rig_calibration(RigConfig& rig, const Eigen::Vector3d& p_BI_m) {
  if (rig.calibration.empty()) return;
  std::optional<size_t> before;  // the camera of the entry before
  for (const CalibratedCamera& entry : read_calibration(text_of(rig.calibration), rig.calibration)) {
    const auto is_this = [&](const CameraConfig& c) {
      return c.role == entry.role || (c.role == entry.name && !entry.name.empty());
    };
    auto camera = std::ranges::find_if(rig.cameras, is_this);
    if (camera == rig.cameras.end()) {
      camera = rig.cameras.insert(camera, CameraConfig{.role = entry.role.empty() ? "camera" : entry.role});
      if (entry.rate_hz) camera->rate_hz = *entry.rate_hz;
    }
    apply(entry.config, *camera);
    camera->p_BI_m = p_BI_m;
    const std::vector<double> X_CCp = std::exchange(camera->camera_from_previous, {});
    if (before && !X_CCp.empty()) {
      camera->body_from_camera = row_by_row(rig.cameras[*before].X_BC() * pose(X_CCp, "calibration").inverse());
    }
    before = static_cast<size_t>(camera - rig.cameras.begin());
  }
  rig.read_calibrations.push_back(std::exchange(rig.calibration, {}));
}

}  // namespace

Eigen::Isometry3d CameraConfig::X_BC() const {
  require_one_pose(*this);
  dynamics::sensors::ImuConfig imu{.p_BI_m = p_BI_m};
  const auto from_F = [&](const Eigen::Isometry3d& X_FC) { return X_FB(imu).inverse() * X_FC; };
  if (!body_from_camera.empty()) return pose(body_from_camera, "body_from_camera");
  if (!imu_from_camera.empty()) return from_F(pose(imu_from_camera, "imu_from_camera"));
  if (!camera_from_imu.empty()) return from_F(pose(camera_from_imu, "camera_from_imu").inverse());
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  X_BC.translation() = Eigen::Vector3d(forward_m, right_m, down_m);
  if (!quaternion.empty()) {
    require(quaternion.size() == 4, "quaternion", fmt::format("must have 4 numbers, got {}", quaternion.size()));
    const Eigen::Quaterniond q_BC(quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
    constexpr double kMaxError = 1e-3;
    require(std::abs(q_BC.norm() - 1.0) <= kMaxError, "quaternion", "must have length 1");
    X_BC.linear() = q_BC.normalized().toRotationMatrix();
    return X_BC;
  }
  // Columns are C's axes (right, down, forward) of a forward camera, expressed in B: a cyclic permutation.
  Eigen::Matrix3d R_forward;
  R_forward.col(0) = Eigen::Vector3d::UnitY();
  R_forward.col(1) = Eigen::Vector3d::UnitZ();
  R_forward.col(2) = Eigen::Vector3d::UnitX();

  const Eigen::Quaterniond q_mount = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                                     Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
                                     Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
  X_BC.linear() = q_mount.toRotationMatrix() * R_forward;
  return X_BC;
}

void mount_rig(RigConfig& rig, const Eigen::Vector3d& p_BI_m) {
  const auto at = [](const std::string& path, const auto& action) {
    try {
      action();
    } catch (const fields::InvalidField& error) {
      throw fields::InvalidField(path + "." + error.key(), error.message());
    }
  };
  for (size_t i = 0; i < rig.cameras.size(); ++i) {
    at(fmt::format("cameras.{}", i),
       [&] { apply_own_calibration(rig.cameras[i], /*is_pair=*/false, rig.read_calibrations); });
  }
  for (size_t i = 0; i < rig.stereo.size(); ++i) {
    at(fmt::format("stereo.{}", i), [&] {
      CameraConfig& camera = rig.stereo[i].camera;
      if (camera.role.empty()) camera.role = "left";
      camera.p_BI_m = p_BI_m;
      const bool states_matrix = has_matrix(camera);
      apply_own_calibration(camera, /*is_pair=*/true, rig.read_calibrations);
      // A calibrated pose is that of one camera, not of the pair's middle.
      if (!states_matrix) clear_matrices(camera);
      camera.X_BC();  // may throw
    });
  }
  apply_rig_calibration(rig, p_BI_m);
  for (CameraConfig& camera : rig.cameras) camera.p_BI_m = p_BI_m;
  for (const StereoConfig& pair : rig.stereo) {
    const Eigen::Isometry3d X_BC = pair.camera.X_BC();
    const Eigen::Vector3d half_B = 0.5 * pair.baseline_m * X_BC.linear().col(0);
    for (const double side : {-1.0, 1.0}) {
      CameraConfig& camera = rig.cameras.emplace_back(pair.camera);
      camera.role = (pair.role.empty() ? "" : pair.role + "_") + (side < 0.0 ? "left" : "right");
      if (has_matrix(pair.camera)) {
        clear_matrices(camera);
        camera.body_from_camera = row_by_row(Eigen::Translation3d(side * half_B) * X_BC);
        continue;
      }
      camera.forward_m += side * half_B.x();
      camera.right_m += side * half_B.y();
      camera.down_m += side * half_B.z();
    }
    rig.cameras.back().row_error_px = pair.row_error_px;
    rig.cameras.back().side_error_m = pair.baseline_error * pair.baseline_m;
  }
  rig.stereo.clear();
  for (CameraConfig& camera : rig.cameras) {
    const bool has_images =
        camera.channel == CameraConfig::Channel::grey || camera.channel == CameraConfig::Channel::color;
    if (has_images && !camera.imperfections) camera.imperfections = rig.sensor;
  }
  rig.sensor.reset();
}

}  // namespace hedgehop::sim
