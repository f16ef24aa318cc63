#pragma once

/// The standard atmosphere up to the tropopause.
namespace hedgehop::dynamics::air {

/// State of the air at one altitude.
struct StandardAir {
  double pressure_pa = 0.0, temperature_k = 0.0, density_kgpm3 = 0.0;
};

/// Returns the standard air at an altitude. @param altitude_m  geometric, above sea level, -5000..11000.
/// Source: [ISA1976] eqs. (18), (23), (33a), (42): a lapse of 6.5 K/km from 288.15 K and 101325 Pa at sea level.
StandardAir standard_air(double altitude_m);

/// Returns the geometric altitude of a pressure in the standard atmosphere, m: the inverse of standard_air().
/// @param pressure_pa  > 0.
double pressure_altitude_m(double pressure_pa);

}  // namespace hedgehop::dynamics::air
