#pragma once

#include <string>
#include <vector>

#include "dynamics/helicopter/helicopter.h"
#include "dynamics/multicopter/multicopter.h"

/// Recognizes values of a vehicle in another unit than that of their key, such as a rotor speed in rpm.
namespace hedgehop::dynamics {

/// Throw fields::InvalidField if the blade tips would be faster than sound, if the inertia is that of a much larger
/// body, if a rotor's inertia is more than that of the vehicle's mass at the blade tips, or if a chord or a hub's place
/// is far beyond the rotor's radius. The message gives the value in the likely unit. Other values, also invalid ones,
/// are accepted.
void require_plausible_units(const helicopter::HelicopterConfig& config);
void require_plausible_units(const multicopter::MulticopterConfig& config);

/// Returns "; a mass of 8200 g is 8.2 kg" if a vehicle of this mass is too heavy for its rotors by a factor of 30 or
/// more but could fly with a thousandth of it; else "".
std::string mass_unit_advice(double mass_kg, double max_lift_n);

/// As above for rotors that are too weak, or "; a thrust of 1.41e-07 N per rpm2 is 1.286e-05 N s2" if they could lift
/// the vehicle with that; else "".
std::string lift_unit_advice(const multicopter::MulticopterConfig& config);

/// Returns "; 0.785 rad is 45 deg" if all azimuths, in deg, look like radians; else "".
std::string azimuth_unit_advice(const std::vector<multicopter::ArmConfig>& arms);

/// Returns "; did you mean `speed: 91.1`?" if a main rotor cannot lift the vehicle at its speed of 91.1 rpm but could
/// at 91.1 rad/s; else "".
std::string rotor_speed_advice(const helicopter::MainRotor& rotor, double weight_n);

/// Returns "; 0.314 rad is 18 deg" if both stops, in deg, look like radians; else "".
std::string stop_unit_advice(double lowest_rad, double highest_rad);

}  // namespace hedgehop::dynamics
