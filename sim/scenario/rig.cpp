#include "sim/scenario/rig.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "sim/config/include.h"
#include "sim/config/input_error.h"
#include "sim/fields/bounds.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

std::string_view words(CameraConfig::Channel channel) {
  switch (channel) {
    case CameraConfig::Channel::grey:
      return "grey images";
    case CameraConfig::Channel::color:
      return "color images";
    case CameraConfig::Channel::depth:
      return "depth images";
    case CameraConfig::Channel::corners:
      return "corners";
  }
  return "?";
}

void require(bool holds, std::string_view key, const std::string& message) {
  if (!holds) throw fields::InvalidField(std::string(key), message);
}

/// Sets principal point and focal lengths. @param fov_focal_px  focal length for the field of view.
template <class Lens>
void place(const CameraConfig& c, double fov_focal_px, Lens& lens) {
  require(c.focal_x_px || !c.focal_y_px, "focal_y", "needs focal_x too");
  lens.focal_x_px = c.focal_x_px.value_or(fov_focal_px);
  lens.focal_y_px = c.focal_y_px.value_or(lens.focal_x_px);
  lens.center_u_px = c.center_u_px.value_or(0.5 * (c.width_px - 1));
  lens.center_v_px = c.center_v_px.value_or(0.5 * (c.height_px - 1));
}

vision::camera::Camera pinhole(const CameraConfig& c) {
  const size_t count = c.distortion.size();
  require(count == 0 || count == 4 || count == 5, "distortion",
          fmt::format("a pinhole takes k1 k2 p1 p2 or k1 k2 p1 p2 k3, got {} numbers", count));
  require(!c.view_limit_rad, "view_limit", "is for a fisheye");
  require(c.focal_x_px || c.fov_rad < std::numbers::pi, "fov", "a pinhole shows less than 180 deg");
  vision::camera::PinholeLens lens{1.0, 1.0};
  if (count > 0) {
    lens.k1 = c.distortion[0];
    lens.k2 = c.distortion[1];
    lens.p1 = c.distortion[2];
    lens.p2 = c.distortion[3];
    if (count == 5) lens.k3 = c.distortion[4];
  }
  double fov_focal_px = 0.0;
  if (!c.focal_x_px) {
    const auto edge = lens.project({std::tan(0.5 * c.fov_rad), 0.0, 1.0});
    require(edge && edge->x() > 0.0, "fov", "the distortion folds the image back before its edge");
    fov_focal_px = 0.5 * c.width_px / edge->x();
  }
  place(c, fov_focal_px, lens);
  return {c.width_px, c.height_px, lens};
}

vision::camera::Camera fisheye(const CameraConfig& c) {
  const size_t count = c.distortion.size();
  require(count == 0 || count == 4, "distortion", fmt::format("a fisheye takes k1 k2 k3 k4, got {} numbers", count));
  vision::camera::FisheyeLens lens;
  if (count > 0) {
    lens.k1 = c.distortion[0];
    lens.k2 = c.distortion[1];
    lens.k3 = c.distortion[2];
    lens.k4 = c.distortion[3];
  }
  lens.limit_rad = c.view_limit_rad.value_or(lens.growth_limit_rad());
  place(c, c.focal_x_px ? 0.0 : vision::camera::fisheye_focal_px(lens, c.width_px, c.fov_rad), lens);
  return {c.width_px, c.height_px, lens};
}

vision::camera::Camera ocam(const CameraConfig& c) {
  require(!c.calibration.empty(), "calibration", "model: ocam needs the file");
  require(
      !c.focal_x_px && !c.focal_y_px && !c.center_u_px && !c.center_v_px && !c.view_limit_rad && c.distortion.empty(),
      "calibration", "defines the lens; remove the other keys of the lens");
  try {
    const vision::camera::Camera camera(vision::camera::parse_ocam_calibration(read_input_file(c.calibration)));
    if (camera.width_px != c.width_px || camera.height_px != c.height_px) {
      throw std::invalid_argument(fmt::format("width and height must be {} and {}", camera.width_px, camera.height_px));
    }
    return camera;
  } catch (const std::invalid_argument& error) {
    throw fields::InvalidField("calibration", fmt::format("'{}': {}", c.calibration.string(), error.what()));
  }
}

}  // namespace

Eigen::Isometry3d CameraConfig::X_BC() const {
  // Columns are C's axes (right, down, forward) of a forward camera, expressed in B: a cyclic permutation.
  Eigen::Matrix3d R_forward;
  R_forward.col(0) = Eigen::Vector3d::UnitY();
  R_forward.col(1) = Eigen::Vector3d::UnitZ();
  R_forward.col(2) = Eigen::Vector3d::UnitX();

  const Eigen::Quaterniond q_mount = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                                     Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
                                     Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  X_BC.linear() = q_mount.toRotationMatrix() * R_forward;
  X_BC.translation() = Eigen::Vector3d(forward_m, right_m, down_m);
  return X_BC;
}

vision::camera::Camera CameraConfig::model() const {
  fields::require_bounds(*this);
  require(std::has_single_bit(static_cast<unsigned>(samples)), "samples", "valid: 1, 2, 4, 8");
  require(model_kind == Model::ocam || calibration.empty(), "calibration", "is for model: ocam");
  const vision::camera::Camera camera = model_kind == Model::ocam      ? ocam(*this)
                                        : model_kind == Model::fisheye ? fisheye(*this)
                                                                       : pinhole(*this);
  vision::camera::check(camera);
  return camera;
}

bool CameraConfig::is_undistorted_pinhole() const {
  const auto is_zero = [](double coefficient) { return coefficient == 0.0; };
  return model_kind == Model::pinhole && std::ranges::all_of(distortion, is_zero);
}

const CameraConfig* RigConfig::find(std::string_view role) const {
  for (const CameraConfig& camera : cameras) {
    if (camera.role == role) return &camera;
  }
  return nullptr;
}

std::vector<CameraConfig> RigConfig::select(const std::vector<std::string>& roles) const {
  std::vector<CameraConfig> selected;
  for (const std::string& role : roles) {
    const CameraConfig* const camera = find(role);
    if (!camera) {
      std::vector<std::string_view> valid;
      for (const CameraConfig& other : cameras) valid.push_back(other.role);
      throw InputError(fmt::format("--camera {}: not in the rig; valid: {}", role, fmt::join(valid, ", ")));
    }
    if (std::ranges::find(selected, role, &CameraConfig::role) != selected.end()) {
      throw InputError(fmt::format("--camera {}: given twice", role));
    }
    selected.push_back(*camera);
  }
  return selected;
}

std::vector<std::string> RigConfig::lacks(std::string_view role, CameraConfig::Channel channel, bool pinhole) const {
  const CameraConfig* const camera = find(role);
  if (!camera) {
    std::vector<std::string_view> roles;
    for (const CameraConfig& other : cameras) roles.push_back(other.role);
    return {fmt::format("needs a camera '{}', which the rig does not have; it has: {}", role,
                        roles.empty() ? "none" : fmt::format("{}", fmt::join(roles, ", ")))};
  }
  std::vector<std::string> faults;
  if (pinhole && !camera->is_undistorted_pinhole()) {
    faults.push_back(fmt::format("needs camera '{}' to be an undistorted pinhole", role));
  }
  if (camera->channel != channel) {
    faults.push_back(
        fmt::format("needs camera '{}' to deliver {}; it delivers {}", role, words(channel), words(camera->channel)));
  }
  return faults;
}

void mount_rig(RigConfig& rig) {
  for (const StereoConfig& pair : rig.stereo) {
    const Eigen::Vector3d half_B = 0.5 * pair.baseline_m * pair.camera.X_BC().linear().col(0);
    for (const double side : {-1.0, 1.0}) {
      CameraConfig& camera = rig.cameras.emplace_back(pair.camera);
      camera.role = (pair.role.empty() ? "" : pair.role + "_") + (side < 0.0 ? "left" : "right");
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

double pixel_angle_rad(const vision::camera::Camera& camera) {
  const Eigen::Vector3d axis_C = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d below_C = *camera.unit_ray(*camera.project(axis_C) + Eigen::Vector2d(0.0, 1.0));
  return std::atan2(axis_C.cross(below_C).norm(), axis_C.dot(below_C));
}

Eigen::Isometry3d true_X_BC(const CameraConfig& camera, const vision::camera::Camera& model, uint64_t seed) {
  if (camera.row_error_px == 0.0 && camera.side_error_m == 0.0) return camera.X_BC();
  const uint64_t bits = stream_seed(seed, "calibration." + camera.role);
  const double row_sign = (bits & 1U) != 0 ? 1.0 : -1.0, side_sign = (bits & 2U) != 0 ? 1.0 : -1.0;
  const double turn_rad = row_sign * camera.row_error_px * pixel_angle_rad(model);
  return camera.X_BC() * Eigen::Translation3d(side_sign * camera.side_error_m, 0.0, 0.0) *
         Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitX());
}

}  // namespace hedgehop::sim
