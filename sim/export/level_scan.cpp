#include "sim/export/level_scan.h"

#include <cmath>
#include <limits>

namespace hedgehop::sim {
namespace {

constexpr double kMinHorizontal = 0.5;  // sine of 30 degrees

}  // namespace

std::optional<LevelScan> level_scan(const cv::Mat& depth_m, const vision::camera::PinholeCamera& lens,
                                    const Eigen::Isometry3d& X_EC, double max_m) {
  const Eigen::Vector3d axis_E = X_EC.linear().col(2), up_E = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d level_E(axis_E.x(), axis_E.y(), 0.0);
  if (level_E.norm() < kMinHorizontal) return std::nullopt;
  LevelScan scan;
  scan.X_ECl.linear().col(0) = level_E.normalized();
  scan.X_ECl.linear().col(1) = up_E.cross(level_E.normalized());
  scan.X_ECl.linear().col(2) = up_E;
  scan.X_ECl.translation() = X_EC.translation();

  const double left_px = lens.center_u_px, right_px = depth_m.cols - 1 - lens.center_u_px;
  scan.angle_min_rad = -std::atan(right_px / lens.focal_x_px);
  scan.angle_increment_rad = (std::atan(left_px / lens.focal_x_px) - scan.angle_min_rad) / (depth_m.cols - 1);
  const Eigen::Matrix3d R_CCl = X_EC.linear().transpose() * scan.X_ECl.linear();
  for (int i = 0; i < depth_m.cols; ++i) {
    const double angle_rad = scan.angle_min_rad + i * scan.angle_increment_rad;
    const Eigen::Vector3d ray_C = R_CCl * Eigen::Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    float range_m = std::numeric_limits<float>::quiet_NaN();
    const double u = lens.center_u_px + lens.focal_x_px * ray_C.x() / ray_C.z();
    const double v = lens.center_v_px + lens.focal_y_px * ray_C.y() / ray_C.z();
    const bool inside = ray_C.z() > 0.0 && u > -0.5 && u < depth_m.cols - 0.5 && v > -0.5 && v < depth_m.rows - 0.5;
    if (inside) {
      const float z_m = depth_m.at<float>(static_cast<int>(std::lround(v)), static_cast<int>(std::lround(u)));
      range_m = z_m / static_cast<float>(ray_C.z());
      if (range_m > max_m) range_m = std::numeric_limits<float>::infinity();
    }
    scan.ranges_m.push_back(range_m);
  }
  return scan;
}

}  // namespace hedgehop::sim
