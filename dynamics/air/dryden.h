#pragma once

#include <Eigen/Core>

/// Dryden turbulence as shaping filters of white noise, stepped exactly.
namespace hedgehop::dynamics::air {

/// Lengths and intensities of turbulence below 1000 ft: u along the mean wind, v across it, w down.
struct DrydenScales {
  double length_uv_m = 0.0, length_w_m = 0.0;
  double sigma_uv_mps = 0.0, sigma_w_mps = 0.0;
};
/// @param height_m  above ground; below 10 ft counts as 10 ft, above 1000 ft as 1000 ft. @param w20_mps  >= 0.
/// Source: [MIL8785C] sec. 3.7.3, low altitude.
DrydenScales dryden_scales(double height_m, double w20_mps);

/// Shaping filter of the u gusts, H = sqrt(2L/V) / (1 + s L/V) scaled to unit variance, over one step:
/// z' = decay z + noise eta, output z.
struct FirstOrderStep {
  double decay = 1.0, noise = 0.0;
};
/// @param path  V dt / L, >= 0: the distance flown in one step over the length of the turbulence.
FirstOrderStep first_order_step(double path);

/// Shaping filter of the v and w gusts, H = sqrt(L/V) (1 + sqrt(3) s L/V) / (1 + s L/V)^2 scaled to unit variance, over
/// one step: z' = decay z + noise eta, eta two unit normals. Each state has unit stationary variance, their correlation
/// is 1/sqrt(2), for any step; V and L may therefore change during a flight.
struct SecondOrderStep {
  Eigen::Matrix2d decay = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d noise = Eigen::Matrix2d::Zero();  ///< lower triangular
};
SecondOrderStep second_order_step(double path);
/// The output of the second-order filter is this row times z.
Eigen::RowVector2d second_order_output();

}  // namespace hedgehop::dynamics::air
