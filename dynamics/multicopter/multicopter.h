#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <vector>

#include "dynamics/actuators.h"
#include "dynamics/hull.h"
#include "dynamics/rigid_body.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::multicopter {

/// One arm with its rotor at the end.
struct ArmConfig {
  enum class Turns { counter_clockwise, clockwise };
  double azimuth_rad = 0.0;
  double length_m = 0.17;
  Turns turns = Turns::clockwise;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ArmConfig> auto& c) {
  v("azimuth", c.azimuth_rad,
    {.unit = "deg",
     .at_least = -360.0,
     .at_most = 360.0,
     .meaning = "direction of the arm, from forward to the right"});
  v("length", c.length_m,
    {.unit = "m", .above = 0.0, .at_most = 5.0, .meaning = "distance from the mass center to the rotor axis"});
  v("turns", c.turns, {.choices = {"counter_clockwise", "clockwise"}, .meaning = "sense of rotation seen from above"});
}

/// Parameters that all rotors of a multicopter share. Defaults: the Hummingbird, [FurrerBurriAchtelikSiegwart2016]
/// table of parameters in the simulator's model file.
struct LiftRotorConfig {
  double thrust_ns2 = 8.54858e-6;
  double torque_m = 0.016;
  double drag_ns2pm = 8.06428e-5;
  double rolling_nms2pm = 1e-6;
  double axial_damping_ns2pm = 0.0;
  double translational_lift_ns2pm2 = 0.0;
  double time_constant_up_s = 0.0125, time_constant_down_s = 0.025;
  double highest_radps = 838.0;
  double inertia_kgm2 = 7.67e-6;
  double radius_m = 0.1;
  double tilt_in_rad = 0.0;
  double height_m = 0.01;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LiftRotorConfig> auto& c) {
  v("thrust", c.thrust_ns2, {.unit = "N s2", .above = 0.0, .meaning = "k: thrust per squared speed (rad/s)"});
  v("torque", c.torque_m, {.unit = "m", .at_least = 0.0, .meaning = "drag torque per thrust"});
  v("drag", c.drag_ns2pm,
    {.unit = "N s2/m",
     .at_least = 0.0,
     .meaning = "lambda: force against motion in the disc's plane, per its speed and "
                "the rotor's (rad/s)"});
  v("rolling", c.rolling_nms2pm,
    {.unit = "N s2",
     .at_least = 0.0,
     .meaning = "mu: rolling moment along motion in the disc's plane, per its speed and "
                "the rotor's"});
  v("axial_damping", c.axial_damping_ns2pm,
    {.unit = "N s2/m",
     .at_least = 0.0,
     .meaning = "force against motion along the axis, per its speed and the rotor's"});
  v("translational_lift", c.translational_lift_ns2pm2,
    {.unit = "N s2/m2", .at_least = 0.0, .meaning = "thrust per squared speed in the disc's plane"});
  v("time_constant_up", c.time_constant_up_s,
    {.unit = "s", .above = 0.0, .at_most = 1.0, .meaning = "time constant of the motor for rising speed"});
  v("time_constant_down", c.time_constant_down_s,
    {.unit = "s", .above = 0.0, .at_most = 1.0, .meaning = "time constant of the motor for falling speed"});
  v("highest_speed", c.highest_radps, {.unit = "rad/s", .above = 0.0, .meaning = "maximum rotor speed"});
  v("inertia", c.inertia_kgm2,
    {.unit = "kg m2", .at_least = 0.0, .meaning = "moment of inertia of rotor and motor about the axis"});
  v("radius", c.radius_m, {.unit = "m", .above = 0.0, .meaning = "blade tip radius"});
  v("tilt_in", c.tilt_in_rad,
    {.unit = "deg", .at_least = -30.0, .at_most = 30.0, .meaning = "tilt of the rotor axes towards the center"});
  v("height", c.height_m, {.unit = "m", .meaning = "height of the rotors above the mass center"});
}

struct MulticopterHullConfig {
  Eigen::Vector3d body_size_m{0.15, 0.15, 0.1};
  double disc_thickness_m = 0.02;
  double frame_thickness_m = 0.03;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MulticopterHullConfig> auto& c) {
  v("body_size", c.body_size_m,
    {.unit = "m", .above = 0.0, .meaning = "box about the mass center: length, width, height"});
  v("disc_thickness", c.disc_thickness_m, {.unit = "m", .above = 0.0, .meaning = "thickness of the rotor discs"});
  v("frame_thickness", c.frame_thickness_m,
    {.unit = "m", .above = 0.0, .meaning = "thickness of the disc that contains all arms, directly below the rotors"});
}

/// A multicopter of any number of arms, each with one rotor. Defaults: the Hummingbird, as LiftRotorConfig.
struct MulticopterConfig {
  static constexpr std::string_view kName = "multicopter";
  static constexpr std::string_view kMeaning = "fixed-pitch rotors on arms, controlled by their speeds";
  static constexpr int kMaxArms = 16;

  MassConfig mass{0.716, {0.007, 0.007, 0.012}, 0.0};
  std::vector<ArmConfig> arms{{0.0, 0.17, ArmConfig::Turns::clockwise},
                              {1.5707963267948966, 0.17, ArmConfig::Turns::counter_clockwise},
                              {3.141592653589793, 0.17, ArmConfig::Turns::clockwise},
                              {-1.5707963267948966, 0.17, ArmConfig::Turns::counter_clockwise}};
  LiftRotorConfig rotor;
  Eigen::Vector3d body_drag_ns2pm2 = Eigen::Vector3d::Zero();
  MulticopterHullConfig hull;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MulticopterConfig> auto& c) {
  v("mass", c.mass, {.meaning = "mass and inertia"});
  v("arms", c.arms, {.meaning = "3 to 16 arms, each with a rotor"});
  v("rotor", c.rotor, {.meaning = "parameters that all rotors and motors share"});
  v("body_drag", c.body_drag_ns2pm2,
    {.unit = "N s2/m2", .at_least = 0.0, .meaning = "force per speed and component, along forward, right and down"});
  v("hull", c.hull, {.meaning = "dimensions of the hull that rotors and arms do not give"});
}
/// Returns the rotor discs, one disc that contains the arms, and the box of the body. Throws std::invalid_argument if a
/// part has no size.
std::vector<HullPart> hull(const MulticopterConfig& config);

/// One number per rotor, on the stack.
using PerRotor = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, MulticopterConfig::kMaxArms, 1>;
using WrenchOfRotors = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, MulticopterConfig::kMaxArms>;
using RotorsOfWrench = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::ColMajor, MulticopterConfig::kMaxArms, 4>;

/// Derived parameters of a multicopter; constant in flight.
struct MulticopterModel {
  struct Rotor {
    Eigen::Vector3d p_BR = Eigen::Vector3d::Zero();   ///< of the hub, m
    Eigen::Vector3d n_B = -Eigen::Vector3d::UnitZ();  ///< direction of the thrust, unit
    double clockwise = 1.0;                           ///< seen from above; -1 counter-clockwise
  };
  MassProperties mass;
  std::vector<Rotor> rotors;
  LiftRotorConfig rotor;
  Eigen::Vector3d body_drag_ns2pm2 = Eigen::Vector3d::Zero();
  WrenchOfRotors wrench_of_thrusts;  ///< Controls (thrust along -z, torques) from the rotor thrusts, at rest
  RotorsOfWrench thrusts_of_wrench;  ///< its least-squares right inverse
};
/// Throws std::invalid_argument if a value is invalid or the arms cannot control all four motions.
MulticopterModel make_model(const MulticopterConfig& config);

/// All loads except gravity about the mass center, including the gyroscopic torque of the rotors.
struct MulticopterLoads {
  Eigen::Vector3d f_B = Eigen::Vector3d::Zero();  ///< N
  Eigen::Vector3d t_B = Eigen::Vector3d::Zero();  ///< N m
};
/// @param speeds_radps    of the rotors, >= 0. @param wind_W  velocity of the air in W, m/s.
/// @param spin_ups_radps2  rates of change of the speeds.
/// Sources: [FurrerBurriAchtelikSiegwart2016] sec. on rotor forces (thrust, drag torque, rotor drag, rolling moment);
/// [FolkPaulosKumar2023] sec. on aerodynamics (body drag, axial damping, translational lift).
MulticopterLoads multicopter_loads(const MulticopterModel& model, const RigidBodyState& body,
                                   const PerRotor& speeds_radps, const PerRotor& spin_ups_radps2,
                                   const Eigen::Vector3d& wind_W);

/// Returns the rotor speeds, within [0, highest], for thrust and torques. If the rotors saturate, it reduces yaw torque
/// first, then raises or reduces thrust, then reduces roll and pitch torque.
PerRotor allocate(const MulticopterModel& model, const Controls& command);
/// Returns thrust and torques of the rotors at rest in still air.
Controls wrench(const MulticopterModel& model, const PerRotor& speeds_radps);
/// Returns the maximum torque about each axis from the rotor speeds of the hover, N m; [kHeave] is the maximum thrust,
/// N.
Controls authority(const MulticopterModel& model);

}  // namespace hedgehop::dynamics::multicopter
