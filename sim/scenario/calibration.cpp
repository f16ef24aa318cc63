#include "sim/scenario/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "sim/config/numbers.h"

namespace hedgehop::sim {
namespace {

std::string list(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(number_text(number + 0.0, false));  // no -0
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

template <class Matrix>
std::vector<double> row_by_row(const Matrix& matrix) {
  std::vector<double> numbers;
  for (const auto& row : matrix.rowwise()) numbers.insert(numbers.end(), row.begin(), row.end());
  return numbers;
}

std::string opencv_matrix(std::string_view name, int rows, const std::vector<double>& numbers) {
  return fmt::format("   {}: !!opencv-matrix\n      rows: {}\n      cols: {}\n      dt: d\n      data: {}\n", name,
                     rows, numbers.size() / static_cast<size_t>(rows), list(numbers));
}

/// OpenCV's reader needs list items that are indented further than their key.
std::string kalibr_pose(std::string_view name, const Eigen::Isometry3d& X) {
  std::string text = fmt::format("  {}:\n", name);
  for (const auto& row : X.matrix().rowwise()) text += fmt::format("    - {}\n", list({row.begin(), row.end()}));
  return text;
}

/// OpenCV's reader takes keys literally, without quotes.
void require_key(const std::string& role) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (!role.empty() && std::isalpha(static_cast<unsigned char>(role[0])) && std::ranges::all_of(role, plain)) return;
  throw std::invalid_argument(
      fmt::format("camera '{}': OpenCV's files need names of letters, digits and underscores", role));
}

}  // namespace

Intrinsics intrinsics(const CameraConfig& config, const vision::camera::Camera& camera) {
  if (const auto* lens = std::get_if<vision::camera::PinholeLens>(&camera.lens)) {
    return {false,
            lens->focal_x_px,
            lens->focal_y_px,
            lens->center_u_px,
            lens->center_v_px,
            {lens->k1, lens->k2, lens->p1, lens->p2, lens->k3}};
  }
  if (const auto* lens = std::get_if<vision::camera::FisheyeLens>(&camera.lens)) {
    return {true,
            lens->focal_x_px,
            lens->focal_y_px,
            lens->center_u_px,
            lens->center_v_px,
            {lens->k1, lens->k2, lens->k3, lens->k4}};
  }
  throw std::invalid_argument(
      fmt::format("camera '{}' has an OCamCalib lens, which the format has no words for; its "
                  "calibration is '{}' itself",
                  config.role, config.calibration.string()));
}

Eigen::Isometry3d X_FC(const dynamics::sensors::ImuConfig& imu, const Eigen::Isometry3d& X_BC) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = R_FB() * X_BC.linear();
  X.translation() = R_FB() * (X_BC.translation() - imu.p_BI_m);
  return X;
}

std::string opencv_calibration(std::span<const CameraConfig> cameras, const dynamics::sensors::ImuConfig& imu) {
  std::string text = "%YAML:1.0\n---\n";
  for (const CameraConfig& config : cameras) {
    require_key(config.role);
    const vision::camera::Camera camera = config.model();
    const Intrinsics lens = intrinsics(config, camera);
    const std::vector<double> matrix = {
        lens.focal_x_px, 0, lens.center_u_px, 0, lens.focal_y_px, lens.center_v_px, 0, 0, 1};
    text += fmt::format("{}:\n   image_width: {}\n   image_height: {}\n   camera_model: {}\n", config.role,
                        camera.width_px, camera.height_px, lens.fisheye ? "fisheye" : "pinhole");
    text += opencv_matrix("camera_matrix", 3, matrix);
    text += opencv_matrix("distortion_coefficients", 1, lens.distortion);
    text += opencv_matrix("imu_from_camera", 4, row_by_row(X_FC(imu, config.X_BC()).matrix()));
    text += opencv_matrix("body_from_camera", 4, row_by_row(config.X_BC().matrix()));
  }
  return text;
}

std::string kalibr_calibration(std::span<const CameraConfig> cameras, const dynamics::sensors::ImuConfig& imu,
                               bool opencv_header) {
  std::string text = opencv_header ? "%YAML:1.0\n---\n" : "";
  for (size_t i = 0; i < cameras.size(); ++i) {
    const CameraConfig& config = cameras[i];
    const vision::camera::Camera camera = config.model();
    Intrinsics lens = intrinsics(config, camera);
    if (!lens.fisheye) {
      if (lens.distortion.back() != 0.0) {
        throw std::invalid_argument(fmt::format("camera '{}' has k3, which Kalibr's radtan has not", config.role));
      }
      lens.distortion.pop_back();
    }
    text += fmt::format("cam{}:\n  camera_model: pinhole\n", i);
    text +=
        fmt::format("  intrinsics: {}\n", list({lens.focal_x_px, lens.focal_y_px, lens.center_u_px, lens.center_v_px}));
    text += fmt::format("  distortion_model: {}\n  distortion_coeffs: {}\n", lens.fisheye ? "equidistant" : "radtan",
                        list(lens.distortion));
    text += fmt::format("  resolution: [{}, {}]\n  rostopic: /{}/image_raw\n", camera.width_px, camera.height_px,
                        config.role);
    text += kalibr_pose("T_cam_imu", X_FC(imu, config.X_BC()).inverse());
    if (i > 0) text += kalibr_pose("T_cn_cnm1", config.X_BC().inverse() * cameras[i - 1].X_BC());
  }
  return text;
}

}  // namespace hedgehop::sim
