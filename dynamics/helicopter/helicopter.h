#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "dynamics/helicopter/blade_servos.h"
#include "dynamics/helicopter/main_rotor.h"
#include "dynamics/helicopter/rotor_speed.h"
#include "dynamics/helicopter/surfaces.h"
#include "dynamics/helicopter/tail_rotor.h"
#include "dynamics/hull.h"
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

/// Dimensions of the hull that no other parameter gives.
struct HelicopterHullConfig {
  Eigen::Vector3d fuselage_center_B_m{0.10, 0.0, 0.05};  ///< of the box around canopy and skids
  Eigen::Vector3d fuselage_size_m{0.60, 0.25, 0.42};
  double boom_thickness_m = 0.06;
  double disc_thickness_m = 0.04;  ///< of both rotors: blades and their flapping
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<HelicopterHullConfig> auto& c) {
  v("fuselage_center", c.fuselage_center_B_m,
    {.unit = "m", .meaning = "center of the box around canopy and skids: forward, right, down of the mass center"});
  v("fuselage_size", c.fuselage_size_m,
    {.unit = "m", .above = 0.0, .meaning = "length, width and height of the box around canopy and skids"});
  v("boom_thickness", c.boom_thickness_m, {.unit = "m", .above = 0.0, .meaning = "width and height of the tail boom"});
  v("disc_thickness", c.disc_thickness_m,
    {.unit = "m", .above = 0.0, .meaning = "thickness of both rotor discs, including flapping"});
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
  v("air_density", c.air_density_kgpm3, {.unit = "kg/m3", .above = 0.0, .at_most = 2.0, .meaning = "air density"});
  v("mass", c.mass, {.meaning = "mass and inertia"});
  v("main_rotor", c.main_rotor, {.meaning = "main rotor and stabilizer bar"});
  v("tail_rotor", c.tail_rotor, {.meaning = "tail rotor"});
  v("surfaces", c.surfaces, {.meaning = "fuselage, vertical fin and horizontal stabilizer"});
  v("servos", c.servos, {.meaning = "servos of the blade angles"});
  v("rotor_speed", c.rotor_speed, {.meaning = "engine model"});
  v("hull", c.hull, {.meaning = "dimensions of the hull that rotors and tail arm do not give"});
}

/// Returns rotor disc, fuselage, tail boom and tail rotor of a helicopter, in this order.
std::vector<HullPart> hull(const HelicopterConfig& config);

/// State of rigid body and rotor disc; the blade angles are inputs.
struct HelicopterState {
  RigidBodyState body;
  FlapState flap;
};
/// The state or its time derivative as one column: RigidBodyVector, then FlapState.
using HelicopterVector = Eigen::Matrix<double, 17, 1>;
HelicopterVector to_vector(const HelicopterState& state);
HelicopterState to_helicopter(const HelicopterVector& x);

/// Derived parameters of a helicopter; constant in flight.
struct HelicopterModel {
  MassProperties mass;
  MainRotor main_rotor;
  TailRotor tail_rotor;
  SurfacesConfig surfaces;
  double density_kgpm3 = 1.225;
};
/// Throws std::invalid_argument if a value is invalid.
HelicopterModel make_model(const HelicopterConfig& config);

/// Returns the same helicopter at another rotor speed. @param main_radps  of the main rotor; at least kMinRotorSpeed of
/// the set speed is used.
HelicopterModel at_speed(HelicopterModel model, double main_radps);

/// All loads except gravity, about the mass center, and those of each rotor.
struct HelicopterLoads {
  Eigen::Vector3d f_B = Eigen::Vector3d::Zero();  ///< N
  Eigen::Vector3d t_B = Eigen::Vector3d::Zero();  ///< N m
  MainRotorLoads main_rotor;
  TailRotorLoads tail_rotor;
};
/// @param blades  present blade angles. @param wind_W  velocity of the air in W, m/s.
HelicopterLoads helicopter_loads(const HelicopterModel& model, const HelicopterState& state, const BladeAngles& blades,
                                 const Eigen::Vector3d& wind_W);

/// Returns the time derivative of the state under given loads.
HelicopterVector derivative(const HelicopterModel& model, const HelicopterState& state, const HelicopterLoads& loads);

/// Returns the time derivative of the state, a pure function of the arguments. Parameters as helicopter_loads().
HelicopterVector derivative(const HelicopterModel& model, const HelicopterState& state, const BladeAngles& blades,
                            const Eigen::Vector3d& wind_W);

}  // namespace hedgehop::dynamics::helicopter
