#include "sim/scenario/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "sim/config/numbers.h"
#include "sim/config/outline_texts.h"

namespace hedgehop::sim {
namespace {

std::string list(const std::vector<double>& numbers) { return fmt::format("[{}]", yaml_1_1_list(numbers)); }

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

/// Returns the matrix that a calibration file stated.
Eigen::Isometry3d as_stated(const std::vector<double>& numbers) {
  Eigen::Isometry3d X;
  X.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  return X;
}

std::string_view opencv_model(const std::string& role, Intrinsics::Model model) {
  switch (model) {
    case Intrinsics::Model::pinhole:
      return "pinhole";
    case Intrinsics::Model::fisheye:
      return "fisheye";
    case Intrinsics::Model::unified:
      return "omnidir";
    case Intrinsics::Model::double_sphere:
      break;
  }
  throw std::invalid_argument(fmt::format("camera '{}' has a double-sphere lens, which OpenCV lacks", role));
}

struct KalibrLens {
  std::string_view camera_model, distortion_model;
  std::vector<double> intrinsics, distortion;
};

KalibrLens kalibr_lens(const std::string& role, const Intrinsics& lens) {
  KalibrLens kalibr{
      "pinhole", "radtan", {lens.focal_x_px, lens.focal_y_px, lens.center_u_px, lens.center_v_px}, lens.distortion};
  switch (lens.model) {
    case Intrinsics::Model::pinhole: {
      const bool more =
          std::any_of(lens.distortion.begin() + 4, lens.distortion.end(), [](double k) { return k != 0.0; });
      if (more)
        throw std::invalid_argument(fmt::format("camera '{}' has k3 or more, which Kalibr's radtan lacks", role));
      kalibr.distortion.resize(4);
      break;
    }
    case Intrinsics::Model::fisheye:
      kalibr.distortion_model = "equidistant";
      break;
    case Intrinsics::Model::unified:
      kalibr.camera_model = "omni";
      kalibr.intrinsics.insert(kalibr.intrinsics.begin(), lens.xi);
      break;
    case Intrinsics::Model::double_sphere:
      kalibr.camera_model = "ds";
      kalibr.distortion_model = "none";
      kalibr.intrinsics.insert(kalibr.intrinsics.begin(), {lens.xi, lens.alpha});
      break;
  }
  return kalibr;
}

/// Returns the topic of a camera's images, quoted only if its role is no word.
std::string topic_text(const std::string& role) {
  const std::string topic = fmt::format("/{}/image_raw", role);
  return yaml_quoted(role) == role ? topic : yaml_quoted(topic);
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
  using Model = Intrinsics::Model;
  const auto of = [](Model model, const auto& lens) {
    return Intrinsics{model, lens.focal_x_px, lens.focal_y_px, lens.center_u_px, lens.center_v_px, {}};
  };
  if (const auto* lens = std::get_if<vision::camera::PinholeLens>(&camera.lens)) {
    Intrinsics pinhole = of(Model::pinhole, *lens);
    pinhole.distortion = {lens->k1, lens->k2, lens->p1, lens->p2, lens->k3};
    if (lens->is_rational()) pinhole.distortion.insert(pinhole.distortion.end(), {lens->k4, lens->k5, lens->k6});
    return pinhole;
  }
  if (const auto* lens = std::get_if<vision::camera::FisheyeLens>(&camera.lens)) {
    Intrinsics fisheye = of(Model::fisheye, *lens);
    fisheye.distortion = {lens->k1, lens->k2, lens->k3, lens->k4};
    return fisheye;
  }
  if (const auto* lens = std::get_if<vision::camera::UnifiedLens>(&camera.lens)) {
    Intrinsics unified = of(Model::unified, lens->plane);
    unified.distortion = {lens->plane.k1, lens->plane.k2, lens->plane.p1, lens->plane.p2};
    unified.xi = lens->xi;
    return unified;
  }
  if (const auto* lens = std::get_if<vision::camera::DoubleSphereLens>(&camera.lens)) {
    Intrinsics double_sphere = of(Model::double_sphere, *lens);
    double_sphere.xi = lens->xi;
    double_sphere.alpha = lens->alpha;
    return double_sphere;
  }
  throw std::invalid_argument(
      fmt::format("camera '{}' has an OCamCalib lens, which the format does not support; its "
                  "calibration is '{}' itself",
                  config.role, config.calibration.string()));
}

Eigen::Isometry3d X_FB(const dynamics::sensors::ImuConfig& imu) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = R_FB();
  X.translation() = R_FB() * -imu.p_BI_m;
  return X;
}

Eigen::Isometry3d X_FC(const dynamics::sensors::ImuConfig& imu, const Eigen::Isometry3d& X_BC) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = R_FB() * X_BC.linear();
  X.translation() = R_FB() * (X_BC.translation() - imu.p_BI_m);
  return X;
}

Eigen::Isometry3d X_FC(const dynamics::sensors::ImuConfig& imu, const CameraConfig& camera) {
  if (!camera.imu_from_camera.empty()) return as_stated(camera.imu_from_camera);
  return X_FC(imu, camera.X_BC());
}

std::string opencv_calibration(std::span<const CameraConfig> cameras, const dynamics::sensors::ImuConfig& imu) {
  std::string text = "%YAML:1.0\n---\n";
  for (const CameraConfig& config : cameras) {
    require_key(config.role);
    const vision::camera::Camera camera = config.model();
    const Intrinsics lens = intrinsics(config, camera);
    const std::string_view model = opencv_model(config.role, lens.model);
    const std::vector<double> matrix = {
        lens.focal_x_px, 0, lens.center_u_px, 0, lens.focal_y_px, lens.center_v_px, 0, 0, 1};
    text += fmt::format("{}:\n   image_width: {}\n   image_height: {}\n   camera_model: {}\n", config.role,
                        camera.width_px, camera.height_px, model);
    if (lens.model == Intrinsics::Model::unified) text += fmt::format("   xi: {}\n", yaml_1_1_number(lens.xi));
    text += opencv_matrix("camera_matrix", 3, matrix);
    text += opencv_matrix("distortion_coefficients", 1, lens.distortion);
    text += opencv_matrix("imu_from_camera", 4, row_by_row(X_FC(imu, config).matrix()));
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
    const KalibrLens lens = kalibr_lens(config.role, intrinsics(config, camera));
    text +=
        fmt::format("cam{}:\n  camera_model: {}\n  intrinsics: {}\n  distortion_model: {}\n  distortion_coeffs: {}\n",
                    i, lens.camera_model, list(lens.intrinsics), lens.distortion_model, list(lens.distortion));
    text += fmt::format("  resolution: [{}, {}]\n  rostopic: {}\n", camera.width_px, camera.height_px,
                        topic_text(config.role));
    text += kalibr_pose(
        "T_cam_imu", config.camera_from_imu.empty() ? X_FC(imu, config).inverse() : as_stated(config.camera_from_imu));
    if (i > 0) text += kalibr_pose("T_cn_cnm1", config.X_BC().inverse() * cameras[i - 1].X_BC());
  }
  return text;
}

}  // namespace hedgehop::sim
