#pragma once

/// The standard atmosphere up to the tropopause.
namespace hedgehop::dynamics::air {

/// Air at rest at one altitude.
struct StandardAir {
  double pressure_pa = 0.0, temperature_k = 0.0, density_kgpm3 = 0.0;
};

/// @param altitude_m  geometric, above sea level, -5000..11000.
/// Source: [ISA1976] eqs. (18), (23), (33a), (42): a lapse of 6.5 K/km from 288.15 K and 101325 Pa at sea level.
StandardAir standard_air(double altitude_m);

/// The altitude at which the standard atmosphere has this pressure: the inverse of standard_air(), m.
/// @param pressure_pa  > 0.
double pressure_altitude_m(double pressure_pa);

}  // namespace hedgehop::dynamics::air
