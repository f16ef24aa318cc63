#include "sim/scenario/rig.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"
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

using fields::require;

/// Sets principal point and focal lengths. @param fov_focal_px  focal length for the field of view.
template <class Lens>
void place(const CameraConfig& c, double fov_focal_px, Lens& lens) {
  require(c.focal_x_px || !c.focal_y_px, "focal_y", "needs focal_x too");
  lens.focal_x_px = c.focal_x_px.value_or(fov_focal_px);
  lens.focal_y_px = c.focal_y_px.value_or(lens.focal_x_px);
  lens.center_u_px = c.center_u_px.value_or(0.5 * (c.width_px - 1));
  lens.center_v_px = c.center_v_px.value_or(0.5 * (c.height_px - 1));
}

/// Returns the focal length, px, at which the field of view covers the width. @param lens  with focal length 1 px.
template <class Lens>
double fov_focal_px(const CameraConfig& c, const Lens& lens) {
  const double half_rad = 0.5 * c.fov_rad;
  const auto edge = lens.project({std::sin(half_rad), 0.0, std::cos(half_rad)});
  require(edge && edge->x() > 0.0, "fov", "the distortion folds the image back before its edge");
  return 0.5 * c.width_px / edge->x();
}

/// Sets the coefficients in OpenCV's order.
void distort(const std::vector<double>& k, vision::camera::PinholeLens& lens) {
  using Lens = vision::camera::PinholeLens;
  constexpr double Lens::*kMembers[] = {&Lens::k1, &Lens::k2, &Lens::p1, &Lens::p2,
                                        &Lens::k3, &Lens::k4, &Lens::k5, &Lens::k6};
  for (size_t i = 0; i < std::min(k.size(), std::size(kMembers)); ++i) lens.*kMembers[i] = k[i];
}

vision::camera::Camera pinhole(const CameraConfig& c) {
  const size_t count = c.distortion.size();
  require(
      count == 0 || count == 4 || count == 5 || count == 8, "distortion",
      fmt::format("a pinhole takes k1 k2 p1 p2, with k3, or with k3 k4 k5 k6, got {} numbers; thin prism and tilted "
                  "lenses are not implemented",
                  count));
  require(!c.view_limit_rad, "view_limit", "is for a fisheye");
  require(c.focal_x_px || c.fov_rad < std::numbers::pi, "fov", "a pinhole shows less than 180 deg");
  vision::camera::PinholeLens lens{1.0, 1.0};
  distort(c.distortion, lens);
  double focal_px = 0.0;
  if (!c.focal_x_px) {
    const auto edge = lens.project({std::tan(0.5 * c.fov_rad), 0.0, 1.0});
    require(edge && edge->x() > 0.0, "fov", "the distortion folds the image back before its edge");
    focal_px = 0.5 * c.width_px / edge->x();
  }
  place(c, focal_px, lens);
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

vision::camera::Camera unified(const CameraConfig& c) {
  const size_t count = c.distortion.size();
  require(count == 0 || count == 4, "distortion",
          fmt::format("a unified lens takes k1 k2 p1 p2, got {} numbers", count));
  require(!c.view_limit_rad, "view_limit", "is for a fisheye");
  require(c.xi && *c.xi >= 0.0, "xi", "model: unified needs it, at least 0");
  vision::camera::UnifiedLens lens{.plane = {1.0, 1.0}, .xi = *c.xi};
  distort(c.distortion, lens.plane);
  place(c, c.focal_x_px ? 0.0 : fov_focal_px(c, lens), lens.plane);
  return {c.width_px, c.height_px, lens};
}

vision::camera::Camera double_sphere(const CameraConfig& c) {
  require(c.distortion.empty(), "distortion", "a double-sphere lens has none");
  require(!c.view_limit_rad, "view_limit", "is for a fisheye");
  require(c.xi.has_value(), "xi", "model: double_sphere needs it");
  require(c.alpha.has_value(), "alpha", "model: double_sphere needs it");
  vision::camera::DoubleSphereLens lens{.focal_x_px = 1.0, .focal_y_px = 1.0, .xi = *c.xi, .alpha = *c.alpha};
  place(c, c.focal_x_px ? 0.0 : fov_focal_px(c, lens), lens);
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

vision::camera::Camera CameraConfig::model() const {
  fields::require_bounds(*this);
  require(std::has_single_bit(static_cast<unsigned>(samples)), "samples",
          fmt::format("must be 1, 2, 4 or 8, got {}", samples));
  require(model_kind == Model::ocam || calibration.empty(), "calibration", "has not been applied by mount_rig()");
  require(!xi || model_kind == Model::unified || model_kind == Model::double_sphere, "xi",
          "is for model: unified or double_sphere");
  require(!alpha || model_kind == Model::double_sphere, "alpha", "is for model: double_sphere");
  const auto build = [this] {
    switch (model_kind) {
      case Model::pinhole:
        return pinhole(*this);
      case Model::fisheye:
        return fisheye(*this);
      case Model::ocam:
        return ocam(*this);
      case Model::unified:
        return unified(*this);
      case Model::double_sphere:
        return double_sphere(*this);
    }
    throw std::logic_error("a lens without a model");
  };
  const vision::camera::Camera camera = build();
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
