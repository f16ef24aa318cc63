#include "dynamics/multicopter/multicopter.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "dynamics/plausible_units.h"
#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::dynamics::multicopter {
namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

Eigen::Vector3d outward(double azimuth_rad) { return {std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0}; }

double highest_thrust_n(const LiftRotorConfig& rotor) {
  return rotor.thrust_ns2 * rotor.highest_radps * rotor.highest_radps;
}

/// Returns the maximum s in [0, 1] for which base + s * extra is within [0, highest]. @param base  within this range.
double max_share(const PerRotor& base, const PerRotor& extra, double highest) {
  double share = 1.0;
  for (Eigen::Index i = 0; i < base.size(); ++i) {
    if (extra[i] > 0.0) share = std::min(share, (highest - base[i]) / extra[i]);
    if (extra[i] < 0.0) share = std::min(share, base[i] / -extra[i]);
  }
  return std::max(share, 0.0);
}

}  // namespace

std::vector<HullPart> hull(const MulticopterConfig& config) {
  const MulticopterHullConfig& h = config.hull;
  const double half_disc = 0.5 * h.disc_thickness_m, half_frame = 0.5 * h.frame_thickness_m;
  std::vector<HullPart> parts;
  double longest_m = 0.0;
  for (const ArmConfig& arm : config.arms) {
    const Eigen::Vector3d hub = arm.length_m * outward(arm.azimuth_rad) - Eigen::Vector3d(0, 0, config.rotor.height_m);
    parts.push_back({HullPart::Shape::cylinder, hub, {config.rotor.radius_m, config.rotor.radius_m, half_disc}});
    longest_m = std::max(longest_m, arm.length_m);
  }
  const Eigen::Vector3d frame_center{0.0, 0.0, -config.rotor.height_m + half_disc + half_frame};
  parts.push_back({HullPart::Shape::cylinder, frame_center, {longest_m, longest_m, half_frame}});
  parts.push_back({HullPart::Shape::box, Eigen::Vector3d::Zero(), 0.5 * h.body_size_m});
  for (const HullPart& part : parts) {
    require(part.center_B_m.allFinite() && part.half_extents_m.allFinite() && (part.half_extents_m.array() > 0.0).all(),
            "every part of the hull must have a size");
  }
  return parts;
}

MulticopterModel make_model(const MulticopterConfig& c) {
  fields::require_bounds(c);
  fields::require(c.arms.size() >= 3 && c.arms.size() <= MulticopterConfig::kMaxArms, "arms",
                  "a multicopter has 3 to 16");
  MulticopterModel model;
  model.mass = make_mass_properties(c.mass.mass_kg, c.mass.inertia_kgm2, c.mass.inertia_xz_kgm2);
  model.rotor = c.rotor;
  model.body_drag_ns2pm2 = c.body_drag_ns2pm2;
  const auto count = static_cast<Eigen::Index>(c.arms.size());
  model.wrench_of_thrusts.resize(4, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const ArmConfig& arm = c.arms[static_cast<size_t>(i)];
    const Eigen::Vector3d out_B = outward(arm.azimuth_rad);
    MulticopterModel::Rotor rotor;
    rotor.p_BR = arm.length_m * out_B - Eigen::Vector3d(0.0, 0.0, c.rotor.height_m);
    rotor.n_B = -std::sin(c.rotor.tilt_in_rad) * out_B - std::cos(c.rotor.tilt_in_rad) * Eigen::Vector3d::UnitZ();
    rotor.clockwise = arm.turns == ArmConfig::Turns::clockwise ? 1.0 : -1.0;
    const Eigen::Vector3d torque_B = rotor.p_BR.cross(rotor.n_B) + rotor.clockwise * c.rotor.torque_m * rotor.n_B;
    model.wrench_of_thrusts.col(i) << -rotor.n_B.z(), torque_B;
    model.rotors.push_back(rotor);
  }
  const Eigen::Matrix4d gram = model.wrench_of_thrusts * model.wrench_of_thrusts.transpose();
  const Eigen::Vector4d scale = gram.diagonal().cwiseSqrt().cwiseMax(1e-12).cwiseInverse();
  const Eigen::Matrix4d balanced = scale.asDiagonal() * gram * scale.asDiagonal();
  fields::require(gram.diagonal().minCoeff() > 0.0 && std::abs(balanced.determinant()) > 1e-9, "arms",
                  "thrust, roll, pitch and yaw cannot be controlled independently; spread the arms and let neighbors "
                  "turn in opposite directions" +
                      azimuth_unit_advice(c.arms));
  model.thrusts_of_wrench = model.wrench_of_thrusts.transpose() * gram.inverse();

  const PerRotor hover_n = model.thrusts_of_wrench.col(0) * (c.mass.mass_kg * kGravityMps2);
  fields::require(
      hover_n.minCoeff() > 0.0, "arms",
      "the vehicle cannot be balanced in a hover, one rotor would need negative thrust" + azimuth_unit_advice(c.arms));
  require(hover_n.maxCoeff() < highest_thrust_n(c.rotor),
          "the rotors cannot lift the vehicle: a hover requires " + std::to_string(hover_n.maxCoeff()) +
              " N from one rotor, whose maximum is " + std::to_string(highest_thrust_n(c.rotor)) + " N" +
              lift_unit_advice(c));
  return model;
}

MulticopterLoads multicopter_loads(const MulticopterModel& model, const RigidBodyState& body,
                                   const PerRotor& speeds_radps, const PerRotor& spin_ups_radps2,
                                   const Eigen::Vector3d& wind_W) {
  const LiftRotorConfig& c = model.rotor;
  const Eigen::Vector3d v_air_B = body.v_WB_B - body.q_WB.normalized().conjugate() * wind_W;
  const Eigen::Vector3d& w_B = body.w_WB_B;
  MulticopterLoads loads;
  loads.f_B = -v_air_B.norm() * model.body_drag_ns2pm2.cwiseProduct(v_air_B);
  Eigen::Vector3d h_B = Eigen::Vector3d::Zero(), h_rate_B = Eigen::Vector3d::Zero();  // angular momentum of the rotors
  for (size_t i = 0; i < model.rotors.size(); ++i) {
    const MulticopterModel::Rotor& rotor = model.rotors[i];
    const double speed = speeds_radps[static_cast<Eigen::Index>(i)];
    const Eigen::Vector3d v_B = v_air_B + w_B.cross(rotor.p_BR);
    const double axial_mps = v_B.dot(rotor.n_B);
    const Eigen::Vector3d edgewise_B = v_B - axial_mps * rotor.n_B;
    const double thrust_n = c.thrust_ns2 * speed * speed;
    const double lift_n = thrust_n - c.axial_damping_ns2pm * speed * axial_mps +
                          c.translational_lift_ns2pm2 * edgewise_B.squaredNorm() * (speed > 0.0 ? 1.0 : 0.0);
    const Eigen::Vector3d f_B = lift_n * rotor.n_B - c.drag_ns2pm * speed * edgewise_B;
    loads.f_B += f_B;
    loads.t_B += rotor.p_BR.cross(f_B) + rotor.clockwise * c.torque_m * thrust_n * rotor.n_B -
                 c.rolling_nms2pm * speed * edgewise_B;
    const Eigen::Vector3d spin_B = -rotor.clockwise * c.inertia_kgm2 * rotor.n_B;
    h_B += speed * spin_B;
    h_rate_B += spin_ups_radps2[static_cast<Eigen::Index>(i)] * spin_B;
  }
  loads.t_B -= w_B.cross(h_B) + h_rate_B;
  return loads;
}

PerRotor allocate(const MulticopterModel& model, const Controls& command) {
  const double highest = highest_thrust_n(model.rotor);
  PerRotor tilting = model.thrusts_of_wrench.middleCols<2>(kRoll) * command.segment<2>(kRoll);
  const double spread = tilting.maxCoeff() - tilting.minCoeff();
  if (spread > highest) tilting *= highest / spread;
  PerRotor thrusts = tilting + model.thrusts_of_wrench.col(kHeave) * command[kHeave];
  const double too_low = std::max(0.0, -thrusts.minCoeff());
  thrusts.array() += too_low;
  const double too_high = std::max(0.0, thrusts.maxCoeff() - highest);
  thrusts.array() -= too_high;
  thrusts = thrusts.cwiseMax(0.0).cwiseMin(highest);
  const PerRotor turning = model.thrusts_of_wrench.col(kYaw) * command[kYaw];
  thrusts += max_share(thrusts, turning, highest) * turning;
  return (thrusts.cwiseMax(0.0) / model.rotor.thrust_ns2).cwiseSqrt();
}

Controls wrench(const MulticopterModel& model, const PerRotor& speeds_radps) {
  return model.wrench_of_thrusts * (model.rotor.thrust_ns2 * speeds_radps.cwiseAbs2());
}

Controls authority(const MulticopterModel& model) {
  const double highest = highest_thrust_n(model.rotor);
  const PerRotor hover_n = model.thrusts_of_wrench.col(kHeave) * (model.mass.mass_kg * kGravityMps2);
  Controls limit;
  limit[kHeave] = model.wrench_of_thrusts.row(kHeave).sum() * highest;
  for (const Eigen::Index axis : {kRoll, kPitch, kYaw}) {
    const PerRotor per_nm = model.thrusts_of_wrench.col(axis);
    double limit_nm = 1e9;
    for (Eigen::Index i = 0; i < per_nm.size(); ++i) {
      const double share = std::abs(per_nm[i]);
      if (share > 0.0) limit_nm = std::min(limit_nm, std::min(hover_n[i], highest - hover_n[i]) / share);
    }
    limit[axis] = limit_nm;
  }
  return limit;
}

}  // namespace hedgehop::dynamics::multicopter
