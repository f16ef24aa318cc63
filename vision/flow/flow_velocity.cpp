#include "vision/flow/flow_velocity.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/fields/order_statistics.h"
#include "vision/flow/flow_measures.h"

namespace hedgehop::vision::flow {
namespace {

// Equations of one flow vector: rows * v_WB_B = flow, both scaled by range / focal length to m/s across the ray.
struct Equation {
  Eigen::Matrix<double, 2, 3> rows;
  Eigen::Vector2d flow_mps;
  double residual_mps = 0.0, weight = 1.0;
};

std::vector<Equation> equations(const FlowField& field, const camera::PinholeCamera& camera,
                                const Eigen::Isometry3d& X_BC, const FlowMotion& motion,
                                const FlowVelocityConfig& config) {
  const Eigen::Matrix3d R_CB = X_BC.linear().transpose();
  const Eigen::Vector3d w_C = R_CB * motion.w_WB_B;
  const Eigen::Vector3d down_C = R_CB * (motion.q_WB.conjugate() * Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d p_BC_W = motion.q_WB * X_BC.translation();
  const double camera_height_m = motion.height_above_ground_m - p_BC_W.z();
  const Eigen::Vector3d v_lever_C = R_CB * motion.w_WB_B.cross(X_BC.translation());
  const double min_cosine = std::cos(config.max_view_angle_rad);

  std::vector<Equation> all;
  if (!(camera_height_m > 0.0)) return all;
  for (const FlowVector& vector : field.vectors) {
    if (!vector.valid) continue;
    const Eigen::Vector3d ray_C = camera.ray_at_unit_depth(vector.center_px);
    const double down = ray_C.dot(down_C);
    if (down < min_cosine * ray_C.norm()) continue;
    const double depth_m = camera_height_m / down;
    const Eigen::Vector2d flow_px = vector.flow_px - rotation_flow_px(camera, vector.center_px, w_C, motion.dt_s);
    const Eigen::Matrix<double, 2, 3> per_velocity = image_jacobian(camera, vector.center_px, depth_m).leftCols<3>();
    // The velocity of C is that of B plus the contribution of the lever arm, known from the gyros.
    const Eigen::Vector2d rate_pxps = flow_px / motion.dt_s - per_velocity * v_lever_C;
    const double scale = depth_m / camera.focal_x_px;
    all.push_back({scale * per_velocity * R_CB, scale * rate_pxps});
  }
  return all;
}

// Returns the median over all vectors of the horizontal velocity that one vector gives, assuming zero vertical
// velocity.
Eigen::Vector3d median_velocity(const std::vector<Equation>& all, const FlowMotion& motion) {
  const Eigen::Matrix3d R_WB = motion.q_WB.toRotationMatrix();
  std::vector<double> north, east;
  for (const Equation& e : all) {
    const Eigen::Matrix2d level = e.rows * R_WB.transpose().leftCols<2>();
    if (std::abs(level.determinant()) < 1e-3) continue;
    const Eigen::Vector2d v_W = level.inverse() * e.flow_mps;
    north.push_back(v_W.x());
    east.push_back(v_W.y());
  }
  if (north.empty()) return Eigen::Vector3d::Zero();
  return R_WB.transpose() * Eigen::Vector3d{upper_median(north), upper_median(east), 0.0};
}

// Sets the weights to Tukey's biweight of the residuals. Returns their robust standard deviation per component.
double reweigh(std::vector<Equation>& all, const Eigen::Vector3d& v_B) {
  constexpr double kBiweight = 4.685;         // 95 % efficiency for Gaussian errors
  constexpr double kRayleighMedian = 1.1774;  // median length of a Gaussian pair, in standard deviations
  constexpr double kMinScaleMps = 1e-6;
  std::vector<double> lengths;
  for (Equation& e : all) {
    e.residual_mps = (e.rows * v_B - e.flow_mps).norm();
    lengths.push_back(e.residual_mps);
  }
  const double sigma = std::max(upper_median(lengths) / kRayleighMedian, kMinScaleMps);
  for (Equation& e : all) {
    const double t = e.residual_mps / (kBiweight * sigma);
    e.weight = t < 1.0 ? (1.0 - t * t) * (1.0 - t * t) : 0.0;
  }
  return sigma;
}

}  // namespace

std::optional<FlowVelocity> flow_velocity(const FlowField& field, const camera::PinholeCamera& camera,
                                          const Eigen::Isometry3d& X_BC, const FlowMotion& motion,
                                          const FlowVelocityConfig& config) {
  if (!(motion.dt_s > 0.0) || !(motion.height_above_ground_m >= config.min_height_m)) return std::nullopt;
  std::vector<Equation> all = equations(field, camera, X_BC, motion, config);
  const auto enough = static_cast<size_t>(config.min_vectors);
  if (all.size() < enough) return std::nullopt;

  constexpr int kPasses = 10;
  Eigen::Vector3d v_B = median_velocity(all, motion);
  double sigma_mps = reweigh(all, v_B);
  Eigen::Matrix3d information;
  for (int pass = 0; pass < kPasses; ++pass) {
    information.setZero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Equation& e : all) {
      information += e.weight * e.rows.transpose() * e.rows;
      right += e.weight * e.rows.transpose() * e.flow_mps;
    }
    const Eigen::LDLT<Eigen::Matrix3d> solver(information);
    // Vectors that are all in one corner cannot distinguish lateral from vertical motion.
    if (!(solver.rcond() > 1e-4)) return std::nullopt;
    v_B = solver.solve(right);
    sigma_mps = reweigh(all, v_B);
  }
  const auto agreeing = std::count_if(all.begin(), all.end(), [](const Equation& e) { return e.weight > 0.0; });
  if (static_cast<size_t>(agreeing) < enough) return std::nullopt;

  const Eigen::Vector3d variance = information.inverse().diagonal() * sigma_mps * sigma_mps;
  FlowVelocity velocity;
  velocity.v_WB_B_xy_meas = v_B.head<2>();
  velocity.sigma_mps = std::hypot(config.sigma_floor_mps, std::sqrt(variance.head<2>().maxCoeff()));
  velocity.agreeing = static_cast<int>(agreeing);
  if (!velocity.v_WB_B_xy_meas.allFinite() || !std::isfinite(velocity.sigma_mps)) return std::nullopt;
  return velocity;
}

}  // namespace hedgehop::vision::flow
