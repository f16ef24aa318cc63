#include "dynamics/helicopter/surfaces.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::dynamics::helicopter {
namespace {

/// Returns the normal force on a surface: lift at small angles plus cross-flow drag, limited by dynamic pressure times
/// area.
/// @param along, across  air speed along the chord (>= 0) and normal to the surface, m/s.
double normal_force_n(double half_density, double area_m2, double lift_slope_prad, double along, double across) {
  const double force = -half_density * area_m2 * (lift_slope_prad * along + std::abs(across)) * across;
  const double limit = half_density * area_m2 * (along * along + across * across);
  return std::clamp(force, -limit, limit);
}

}  // namespace

Loads fuselage_loads(const SurfacesConfig& surfaces, double density_kgpm3, const Eigen::Vector3d& v_air_B) {
  const double pressure_per_mps = 0.5 * density_kgpm3 * v_air_B.norm();
  return {-pressure_per_mps * surfaces.fuselage_drag_areas_m2.cwiseProduct(v_air_B), Eigen::Vector3d::Zero()};
}

Loads fin_loads(const SurfacesConfig& surfaces, double density_kgpm3, double tail_arm_m, double tail_height_m,
                const Eigen::Vector3d& v_air_B, const Eigen::Vector3d& w_WB_B) {
  const double v_vf = v_air_B.y() - tail_arm_m * w_WB_B.z() + tail_height_m * w_WB_B.x();
  const double w_tr = v_air_B.z() + tail_arm_m * w_WB_B.y();
  const double Y = normal_force_n(0.5 * density_kgpm3, surfaces.fin_area_m2, surfaces.fin_lift_slope_prad,
                                  Eigen::Vector2d(v_air_B.x(), w_tr).norm(), v_vf);
  return {{0.0, Y, 0.0}, {Y * tail_height_m, 0.0, -Y * tail_arm_m}};
}

Loads stabilizer_loads(const SurfacesConfig& surfaces, double density_kgpm3, double induced_mps,
                       const Eigen::Vector3d& v_air_B, const Eigen::Vector3d& w_WB_B) {
  const double w_ht = v_air_B.z() + surfaces.stabilizer_arm_m * w_WB_B.y() - surfaces.stabilizer_wake * induced_mps;
  const double Z = normal_force_n(0.5 * density_kgpm3, surfaces.stabilizer_area_m2, surfaces.stabilizer_lift_slope_prad,
                                  std::abs(v_air_B.x()), w_ht);
  return {{0.0, 0.0, Z}, {0.0, Z * surfaces.stabilizer_arm_m, 0.0}};
}

}  // namespace hedgehop::dynamics::helicopter
