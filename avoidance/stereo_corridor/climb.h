#pragma once

#include <Eigen/Core>

/// Flight along a ray that rises or falls, with a limited climb rate; an addition of the modified law. The paper's
/// aircraft flies along every ray in its view.
namespace hedgehop::avoidance::stereo_corridor {

/// Limits of a vehicle that follows a ray. All values > 0.
struct ClimbLimits {
  double rate_mps = 1.0;           ///< maximum vertical speed, up and down
  double acceleration_mps2 = 2.0;  ///< maximum horizontal deceleration
};

/// Returns the tangent of the elevation of a direction in W, any length above 0; positive up.
double slope_of(const Eigen::Vector3d& direction_W);

/// Returns the maximum horizontal speed at which the vehicle can follow a ray, m/s; +infinity for a level ray.
/// @param slope  slope_of() the ray.
double climbing_speed_mps(double slope, const ClimbLimits& limits);

/// Returns how far the vehicle gets below a rising ray, or above a falling one, before it follows it in parallel, m.
/// It neither climbs nor decelerates for a reaction time. Then it climbs at its maximum rate c and decelerates with a
/// from its speed v to climbing_speed_mps(), v_c:
///   |slope| (v t_reaction + (v - v_c)^2 / 2a) , without the second term if v <= v_c.
/// @param speed_mps  present horizontal speed, >= 0.
double lag_behind_ray_m(double slope, double speed_mps, const ClimbLimits& limits);

/// Returns the altitude to command now so that the vehicle flies along a ray, m. @param altitude_m  present altitude.
/// @param speed_mps  commanded horizontal speed.
double altitude_along_ray_m(double altitude_m, double slope, double speed_mps);

}  // namespace hedgehop::avoidance::stereo_corridor
