#include "sim/export/ros_messages.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

void put_header(CdrWriter& out, const RosHeader& header) {
  constexpr int64_t kSecond = 1'000'000'000;
  const int64_t stamp_ns = kStartTimeNs + header.t_ns;
  out.put(static_cast<int32_t>(stamp_ns / kSecond)).put(static_cast<uint32_t>(stamp_ns % kSecond)).put(header.frame);
}

void put_vector(CdrWriter& out, const Eigen::Vector3d& v) { out.put(v.x()).put(v.y()).put(v.z()); }

void put_rotation(CdrWriter& out, const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  out.put(q.x()).put(q.y()).put(q.z()).put(q.w());
}

void put_diagonal_3x3(CdrWriter& out, const Eigen::Vector3d& variances) {
  const Eigen::Matrix3d covariance = variances.asDiagonal();
  for (int i = 0; i < 9; ++i) out.put(covariance(i / 3, i % 3));
}

void put_diagonal_6x6(CdrWriter& out, const Eigen::Vector3d& first_sigmas, const Eigen::Vector3d& second_sigmas) {
  for (int row = 0; row < 6; ++row) {
    for (int col = 0; col < 6; ++col) {
      const double sigma = row < 3 ? first_sigmas[row] : second_sigmas[row - 3];
      out.put(row == col ? sigma * sigma : 0.0);
    }
  }
}

std::string_view encoding_of(const cv::Mat& image) {
  if (image.type() == CV_8UC1) return "mono8";
  if (image.type() == CV_8UC3) return "rgb8";
  if (image.type() == CV_16UC1) return "16UC1";
  throw std::invalid_argument("an image in a log must be grey, RGB or of 16 bit");
}

/// Radii of curvature of the Earth at a latitude, m [WGS84] sec. 3.4: along the meridian and across it.
struct EarthRadii {
  double meridian_m, normal_m;
};
EarthRadii earth_radii(double latitude_rad) {
  constexpr double kSemiMajorM = 6378137.0, kFlattening = 1.0 / 298.257223563;
  constexpr double kSquareEccentricity = kFlattening * (2.0 - kFlattening);
  const double s = std::sin(latitude_rad), w2 = 1.0 - kSquareEccentricity * s * s;
  return {kSemiMajorM * (1.0 - kSquareEccentricity) / (w2 * std::sqrt(w2)), kSemiMajorM / std::sqrt(w2)};
}

void put_points(CdrWriter& out, const SurfaceMesh& mesh) {
  out.put_length(mesh.indices.size());
  for (const uint32_t index : mesh.indices) put_vector(out, mesh.points_E[index].cast<double>());
  out.put_length(mesh.indices.size());
  for (const uint32_t index : mesh.indices) {
    const Eigen::Vector3f& color = mesh.colors[index];
    out.put(color.x()).put(color.y()).put(color.z()).put(1.0f);
  }
}

}  // namespace

CdrWriter ros_image(const RosHeader& header, const cv::Mat& image) {
  CdrWriter out;
  put_header(out, header);
  const size_t step = image.elemSize() * static_cast<size_t>(image.cols);
  out.put(static_cast<uint32_t>(image.rows)).put(static_cast<uint32_t>(image.cols)).put(encoding_of(image));
  out.put(uint8_t{0}).put(static_cast<uint32_t>(step)).put_length(step * static_cast<size_t>(image.rows));
  for (int row = 0; row < image.rows; ++row) out.put_array(std::span(image.ptr<char>(row), step));
  return out;
}

CdrWriter ros_compressed_image(const RosHeader& header, std::string_view format, std::string_view data) {
  CdrWriter out;
  put_header(out, header);
  out.put(format).put_bytes(data);
  return out;
}

CdrWriter ros_camera_info(const RosHeader& header, const LoggedCamera& camera, const LensModel& lens) {
  CdrWriter out;
  put_header(out, header);
  out.put(static_cast<uint32_t>(camera.height_px)).put(static_cast<uint32_t>(camera.width_px)).put(lens.model);
  out.put_length(lens.D.size()).put_array<double>(lens.D).put_array<double>(lens.K).put_array<double>(lens.R);
  out.put_array<double>(lens.P);
  for (int i = 0; i < 6; ++i) out.put(uint32_t{0});  // binning; region of interest: the whole image
  out.put(false);
  return out;
}

CdrWriter ros_imu(const RosHeader& header, const RecordedReading& reading, const dynamics::sensors::ImuConfig& config) {
  const auto variance = [&](double density) { return density * density * config.rate_hz; };
  CdrWriter out;
  put_header(out, header);
  put_rotation(out, Eigen::Matrix3d::Identity());
  put_diagonal_3x3(out, {-1.0, 0.0, 0.0});  // the message has no orientation
  put_vector(out, reading.w_F);
  put_diagonal_3x3(out, Eigen::Vector3d::Constant(variance(config.gyro_noise_density)));
  put_vector(out, reading.f_F);
  put_diagonal_3x3(out, Eigen::Vector3d::Constant(variance(config.accelerometer_noise_density)));
  return out;
}

CdrWriter ros_odometry(const RosHeader& header, const std::string& child, const LoggedMotion& motion,
                       const LoggedSigmas& sigmas) {
  CdrWriter out;
  put_header(out, header);
  out.put(child);
  put_vector(out, motion.X_EF.translation());
  put_rotation(out, motion.X_EF.linear());
  put_diagonal_6x6(out, sigmas.p_E_m, sigmas.attitude_F_rad);
  put_vector(out, motion.v_EF_F);
  put_vector(out, motion.w_EF_F);
  put_diagonal_6x6(out, sigmas.v_F_mps, sigmas.w_F_radps);
  return out;
}

CdrWriter ros_fix(const RosHeader& header, const Eigen::Vector3d& p_W_m, const dynamics::sensors::GpsConfig& config) {
  constexpr uint8_t kDiagonalKnown = 2;
  const double latitude_rad = kOriginLatitudeDeg / kDegPerRad;
  const EarthRadii radii = earth_radii(latitude_rad);
  CdrWriter out;
  put_header(out, header);
  out.put(int8_t{0}).put(uint16_t{1});  // a fix, by GPS
  out.put(kOriginLatitudeDeg + p_W_m.x() / radii.meridian_m * kDegPerRad);
  out.put(kOriginLongitudeDeg + p_W_m.y() / (radii.normal_m * std::cos(latitude_rad)) * kDegPerRad);
  out.put(kOriginAltitudeM - p_W_m.z());
  const auto variance = [&](double wander_m) { return wander_m * wander_m + config.noise_m * config.noise_m; };
  const double horizontal = variance(config.wander_horizontal_m);
  put_diagonal_3x3(out, {horizontal, horizontal, variance(config.wander_vertical_m)});
  out.put(kDiagonalKnown);
  return out;
}

CdrWriter ros_laser_scan(const RosHeader& header, const LevelScan& scan, double scan_time_s, double min_m,
                         double max_m) {
  CdrWriter out;
  put_header(out, header);
  const auto steps = static_cast<double>(scan.ranges_m.size() - 1);
  for (const double value : {scan.angle_min_rad, scan.angle_min_rad + steps * scan.angle_increment_rad,
                             scan.angle_increment_rad, 0.0, scan_time_s, min_m, max_m}) {
    out.put(static_cast<float>(value));
  }
  out.put_length(scan.ranges_m.size()).put_array<float>(scan.ranges_m).put_length(0);
  return out;
}

CdrWriter ros_transforms(std::span<const RosTransform> transforms) {
  CdrWriter out;
  out.put_length(transforms.size());
  for (const RosTransform& transform : transforms) {
    put_header(out, transform.header);
    out.put(transform.child);
    put_vector(out, transform.X.translation());
    put_rotation(out, transform.X.linear());
  }
  return out;
}

void RosMarkers::add(const RosHeader& header, const SurfaceMesh& mesh, bool frame_locked) {
  markers_.push_back({header, mesh, frame_locked});
}

CdrWriter RosMarkers::message() const {
  constexpr int32_t kTriangleList = 11, kAdd = 0;
  CdrWriter out;
  out.put_length(markers_.size());
  int32_t number = 0;
  for (const auto& [header, mesh, frame_locked] : markers_) {
    put_header(out, header);
    out.put(mesh.id).put(number++).put(kTriangleList).put(kAdd);
    put_vector(out, Eigen::Vector3d::Zero());
    put_rotation(out, Eigen::Matrix3d::Identity());
    put_vector(out, Eigen::Vector3d::Ones());
    for (const float channel : {0.5f, 0.5f, 0.5f, 1.0f}) out.put(channel);
    out.put(int32_t{0}).put(uint32_t{0}).put(frame_locked);  // without a lifetime
    put_points(out, mesh);
    out.put("");  // no texture
    put_header(out, {-kStartTimeNs, ""});
    out.put("").put_length(0).put_length(0);
    out.put("").put("").put("").put_length(0).put(false);  // no text, no mesh file
  }
  return out;
}

}  // namespace hedgehop::sim
