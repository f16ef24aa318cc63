#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "sim/fields/invalid_field.h"
#include "sim/scenario/calibration_file.h"
#include "sim/scenario/calibration_text.h"
#include "sim/scenario/camera_pose.h"
#include "sim/scenario/rig.h"

namespace hedgehop::sim {
namespace {

using fields::require;

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

/// Refuses a focal length or a principal point that are not in pixels, and a size with exchanged sides.
void require_pixels(const CameraConfig& calibrated) {
  constexpr double kMinFocal = 0.04;         // of the width
  constexpr double kFar = 0.5, kNear = 0.1;  // of the size: beyond the image; from its middle
  if (calibrated.width_px == 0 || !calibrated.focal_x_px) return;
  const double w = calibrated.width_px, h = calibrated.height_px, u = calibrated.center_u_px.value_or(0.5 * w),
               v = calibrated.center_v_px.value_or(0.5 * h);
  require(*calibrated.focal_x_px > kMinFocal * w, "calibration",
          fmt::format("a focal length of {:g} px with {:g} columns; valid: above {:g} px", *calibrated.focal_x_px, w,
                      kMinFocal * w));
  require(
      std::abs(u / w - 0.5) < 0.5 + kFar && std::abs(v / h - 0.5) < 0.5 + kFar, "calibration",
      fmt::format("the principal point ({:g}, {:g}) px is far outside the image of {:g} x {:g} pixels", u, v, w, h));
  const auto is_middle = [&](double width, double height) {
    return std::abs(u / width - 0.5) < kNear && std::abs(v / height - 0.5) < kNear;
  };
  require(
      is_middle(w, h) || !is_middle(h, w), "calibration",
      fmt::format("the principal point ({:g}, {:g}) px is the middle of {:g} x {:g} pixels, not of the stated {:g} x "
                  "{:g}",
                  u, v, h, w, w, h));
}

/// Gives the lens, the size and, unless the camera states its own, the pose of a calibration to a camera.
void apply(const CameraConfig& calibrated, CameraConfig& camera) {
  const CameraConfig fresh;
  require(!camera.focal_x_px && !camera.focal_y_px && !camera.center_u_px && !camera.center_v_px &&
              camera.distortion.empty() && !camera.xi && !camera.alpha && camera.fov_rad == fresh.fov_rad,
          "calibration", "defines the lens; remove the other keys of the lens");
  require_pixels(calibrated);
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
    std::vector<FieldError> errors;
    for (const std::string& line : error.errors()) errors.push_back({"calibration", line});
    throw InputError(std::move(errors));
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

/// Calls an action and adds the path of its config to its errors.
template <class Action>
void below(const std::string& path, const Action& action) {
  try {
    action();
  } catch (const fields::InvalidField& error) {
    throw fields::InvalidField(join_path(path, error.key()), error.message());
  } catch (const InputError& error) {
    std::vector<FieldError> errors = error.field_errors();
    for (FieldError& field : errors) field.path = join_path(path, field.path);
    throw InputError(std::move(errors));
  }
}

/// Whether images of a camera have the default size and lens.
bool has_default_lens(const CameraConfig& c) {
  const CameraConfig fresh;
  const bool has_images = c.channel == CameraConfig::Channel::grey || c.channel == CameraConfig::Channel::color;
  return has_images && !c.focal_x_px && c.distortion.empty() && c.fov_rad == fresh.fov_rad &&
         c.width_px == fresh.width_px && c.height_px == fresh.height_px && c.model_kind == fresh.model_kind;
}

/// Refuses listed cameras without a lens that no entry has, if there are entries that no listed camera has.
/// @param is_known  per listed camera: an entry has its name.
void require_entries(const RigConfig& rig, const std::vector<bool>& is_known) {
  std::vector<std::string> unlisted;
  for (size_t i = is_known.size(); i < rig.cameras.size(); ++i) unlisted.push_back(rig.cameras[i].role);
  for (size_t i = 0; i < is_known.size() && !unlisted.empty(); ++i) {
    require(is_known[i] || !has_default_lens(rig.cameras[i]), fmt::format("cameras.{}", i),
            fmt::format("'{}' has no lens and is not in the calibration; its cameras that the rig does not list: {}; "
                        "use such a name, or state 'calibration' in the camera",
                        rig.cameras[i].role, fmt::join(unlisted, ", ")));
  }
}

/// Applies the rig's file; a pose that refers to the camera before becomes one in B. @param p_BI_m  as mount_rig()'s.
void apply_rig_calibration(RigConfig& rig, const Eigen::Vector3d& p_BI_m) {
  if (rig.calibration.empty()) return;
  const size_t listed = rig.cameras.size();  // cameras whose keys the rig has; the others are of the file alone
  // Calls an action on a camera. The place of its errors is the camera's key, or `calibration` if the file states it.
  const auto with = [&](size_t i, bool is_of_rig, const auto& action) {
    try {
      action();
    } catch (const fields::InvalidField& error) {
      const bool is_of_file = error.key() == "calibration";
      if (is_of_rig && !is_of_file) {
        throw fields::InvalidField(fmt::format("cameras.{}.{}", i, error.key()), error.message());
      }
      throw fields::InvalidField("calibration", fmt::format("camera '{}': {}", rig.cameras[i].role,
                                                            is_of_file ? error.message() : error.what()));
    }
  };
  std::optional<size_t> before;  // the camera of the entry before
  std::vector<bool> is_known(listed);
  for (const CalibratedCamera& entry : read_calibration(text_of(rig.calibration), rig.calibration)) {
    const auto is_this = [&](const CameraConfig& c) {
      return c.role == entry.role || (c.role == entry.name && !entry.name.empty());
    };
    auto camera = std::ranges::find_if(rig.cameras, is_this);
    if (camera == rig.cameras.end()) {
      camera = rig.cameras.insert(camera, CameraConfig{.role = entry.role.empty() ? "camera" : entry.role});
      if (entry.rate_hz) camera->rate_hz = *entry.rate_hz;
    }
    const auto i = static_cast<size_t>(camera - rig.cameras.begin());
    if (i < listed) is_known[i] = true;
    const bool states_pose = i < listed && (has_mounting(*camera) || has_matrix(*camera));
    with(i, i < listed, [&] { apply(entry.config, *camera); });
    camera->p_BI_m = p_BI_m;
    const std::vector<double> X_CCp = std::exchange(camera->camera_from_previous, {});
    with(i, states_pose, [&] {
      if (before && !X_CCp.empty()) {
        camera->body_from_camera = numbers_of(rig.cameras[*before].X_BC() * pose_of(X_CCp, "calibration").inverse());
      }
      camera->X_BC();  // may throw
    });
    before = i;
  }
  require_entries(rig, is_known);
  rig.read_calibrations.push_back(std::exchange(rig.calibration, {}));
}

}  // namespace

void mount_rig(RigConfig& rig, const Eigen::Vector3d& p_BI_m) {
  for (size_t i = 0; i < rig.cameras.size(); ++i) {
    below(fmt::format("cameras.{}", i),
          [&] { apply_own_calibration(rig.cameras[i], /*is_pair=*/false, rig.read_calibrations); });
  }
  for (size_t i = 0; i < rig.stereo.size(); ++i) {
    below(fmt::format("stereo.{}", i), [&] {
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
        camera.body_from_camera = numbers_of(Eigen::Translation3d(side * half_B) * X_BC);
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
