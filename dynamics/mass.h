#pragma once

#include <Eigen/Core>

#include "sim/fields/field.h"

namespace hedgehop::dynamics {

struct MassConfig {
  double mass_kg = 8.2;
  Eigen::Vector3d inertia_kgm2{0.18, 0.34, 0.28};
  double inertia_xz_kgm2 = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MassConfig> auto& c) {
  v("mass", c.mass_kg, {.unit = "kg", .above = 0.0, .meaning = "ready to fly"});
  v("inertia", c.inertia_kgm2,
    {.unit = "kg m2", .above = 0.0, .meaning = "roll, pitch and yaw, about the mass center"});
  v("inertia_xz", c.inertia_xz_kgm2, {.unit = "kg m2", .meaning = "product of inertia I_xz"});
}

}  // namespace hedgehop::dynamics
