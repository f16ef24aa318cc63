#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/hull.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::helicopter {

struct HelicopterConfig;
/// Returns rotor disc, fuselage, tail boom and tail rotor of a helicopter, in this order.
std::vector<HullPart> hull(const HelicopterConfig& config);

/// The part of a helicopter's shape that no other parameter gives.
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
  v("fuselage_size", c.fuselage_size_m, {.unit = "m", .above = 0.0, .meaning = "length, width and height of that box"});
  v("boom_thickness", c.boom_thickness_m, {.unit = "m", .above = 0.0, .meaning = "width and height of the tail boom"});
  v("disc_thickness", c.disc_thickness_m,
    {.unit = "m", .above = 0.0, .meaning = "thickness of both rotor discs, blade and flapping"});
}

}  // namespace hedgehop::dynamics::helicopter
