#include "dynamics/air/atmosphere.h"

#include <cmath>

namespace hedgehop::dynamics::air {
namespace {

// [ISA1976] tables 2 and 4.
constexpr double kEarthRadiusM = 6356766.0;
constexpr double kSeaLevelK = 288.15, kSeaLevelPa = 101325.0;
constexpr double kLapseKpm = 0.0065;          // of temperature with geopotential altitude
constexpr double kMolarMass = 0.0289644;      // kg/mol
constexpr double kGasConstant = 8.31432;      // J/(mol K)
constexpr double kStandardGravity = 9.80665;  // m/s2
constexpr double kExponent = kStandardGravity * kMolarMass / (kGasConstant * kLapseKpm);  // 5.25588

}  // namespace

StandardAir standard_air(double altitude_m) {
  const double geopotential_m = kEarthRadiusM * altitude_m / (kEarthRadiusM + altitude_m);
  StandardAir air;
  air.temperature_k = kSeaLevelK - kLapseKpm * geopotential_m;
  air.pressure_pa = kSeaLevelPa * std::pow(air.temperature_k / kSeaLevelK, kExponent);
  air.density_kgpm3 = air.pressure_pa * kMolarMass / (kGasConstant * air.temperature_k);
  return air;
}

double pressure_altitude_m(double pressure_pa) {
  const double geopotential_m = kSeaLevelK / kLapseKpm * (1.0 - std::pow(pressure_pa / kSeaLevelPa, 1.0 / kExponent));
  return kEarthRadiusM * geopotential_m / (kEarthRadiusM - geopotential_m);
}

}  // namespace hedgehop::dynamics::air
