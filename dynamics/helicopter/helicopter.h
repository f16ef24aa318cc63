#pragma once

#include <Eigen/Core>
#include <string_view>

#include "dynamics/helicopter/blade_angles.h"
#include "dynamics/helicopter/helicopter_hull.h"
#include "dynamics/helicopter/main_rotor.h"
#include "dynamics/helicopter/rotor_speed.h"
#include "dynamics/helicopter/servo.h"
#include "dynamics/helicopter/surfaces.h"
#include "dynamics/helicopter/tail_rotor.h"
#include "dynamics/mass.h"
#include "dynamics/rigid_body.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::helicopter {

struct ServosConfig {
  ServoConfig collective{.lowest_rad = -0.218166156499291, .highest_rad = 0.314159265358979};  // -12.5 .. 18 deg
  ServoConfig cyclic;                                                                          // both axes
  ServoConfig tail{.lowest_rad = -0.349065850398866, .highest_rad = 0.349065850398866};        // +-20 deg
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ServosConfig> auto& c) {
  v("collective", c.collective, {.meaning = "main rotor collective"});
  v("cyclic", c.cyclic, {.meaning = "lateral and longitudinal cyclic"});
  v("tail", c.tail, {.meaning = "tail rotor collective"});
}

/// A helicopter with one main rotor, a stabilizer bar and a tail rotor. Defaults: the X-Cell .60 of [Gavrilets2015]
/// table of parameters.
struct HelicopterConfig {
  static constexpr std::string_view kName = "helicopter";
  static constexpr std::string_view kMeaning = "main and tail rotor, Bell-Hiller stabilizer bar";
  double air_density_kgpm3 = 1.225;
  MassConfig mass;
  MainRotorConfig main_rotor;
  TailRotorConfig tail_rotor;
  SurfacesConfig surfaces;
  ServosConfig servos;
  RotorSpeedConfig rotor_speed;
  HelicopterHullConfig hull;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<HelicopterConfig> auto& c) {
  v("air_density", c.air_density_kgpm3,
    {.unit = "kg/m3", .above = 0.0, .at_most = 2.0, .meaning = "of the air it flies in"});
  v("mass", c.mass, {.meaning = "mass and inertia"});
  v("main_rotor", c.main_rotor, {.meaning = "main rotor and stabilizer bar"});
  v("tail_rotor", c.tail_rotor, {.meaning = "tail rotor"});
  v("surfaces", c.surfaces, {.meaning = "fuselage, vertical fin and horizontal stabilizer"});
  v("servos", c.servos, {.meaning = "servos that move the blades"});
  v("rotor_speed", c.rotor_speed, {.meaning = "what turns the rotors"});
  v("hull", c.hull, {.meaning = "shape for collisions, beside the rotors and the tail arm"});
}

/// Body and disc: what moves in a helicopter whose blade angles are given.
struct HelicopterState {
  RigidBodyState body;
  FlapState flap;
};
/// The state or its time derivative as one column: RigidBodyVector, then FlapState.
using HelicopterVector = Eigen::Matrix<double, 17, 1>;
HelicopterVector to_vector(const HelicopterState& state);
HelicopterState to_helicopter(const HelicopterVector& x);

/// A helicopter ready to compute; constant in flight.
struct HelicopterModel {
  MassProperties mass;
  MainRotor main_rotor;
  TailRotor tail_rotor;
  SurfacesConfig surfaces;
  double density_kgpm3 = 1.225;
};
/// Throws std::invalid_argument on a value that cannot be.
HelicopterModel make_model(const HelicopterConfig& config);

/// Returns the same helicopter with rotors at another speed. @param main_radps  of the main rotor; no
/// slower than kSlowestRotor.
HelicopterModel at_speed(HelicopterModel model, double main_radps);

/// All loads but gravity, about the mass center, and what the rotors do.
struct HelicopterLoads {
  Eigen::Vector3d f_B = Eigen::Vector3d::Zero();  ///< N
  Eigen::Vector3d t_B = Eigen::Vector3d::Zero();  ///< N m
  MainRotorLoads main_rotor;
  TailRotorLoads tail_rotor;
};
/// @param blades  where the blades stand. @param wind_W  velocity of the air in W, m/s.
HelicopterLoads helicopter_loads(const HelicopterModel& model, const HelicopterState& state, const BladeAngles& blades,
                                 const Eigen::Vector3d& wind_W);

/// Returns the time derivative of the state under loads that are known.
HelicopterVector derivative(const HelicopterModel& model, const HelicopterState& state, const HelicopterLoads& loads);

/// Returns the time derivative of the state, a pure function of the arguments. Parameters as helicopter_loads().
HelicopterVector derivative(const HelicopterModel& model, const HelicopterState& state, const BladeAngles& blades,
                            const Eigen::Vector3d& wind_W);

}  // namespace hedgehop::dynamics::helicopter
