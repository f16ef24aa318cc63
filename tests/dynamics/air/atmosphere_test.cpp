#include "dynamics/air/atmosphere.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "tests/dynamics/recorded_check.h"

namespace hedgehop::dynamics::air {
namespace {

constexpr double kPrinted = 5e-5;  // the tables print five figures

// Check AS4.
TEST(Atmosphere, AS4_PressureAndDensityAreTheStandards) {
  constexpr double kRelative = 1e-5;
  const std::array<double, 3> altitudes_m{100.0, 500.0, 1000.0}, pressures_pa{100129.46, 95461.29, 89876.29},
      densities{1.21328, 1.16727, 1.11166};
  for (size_t i = 0; i < altitudes_m.size(); ++i) {
    const StandardAir air = standard_air(altitudes_m[i]);
    const std::string at = " at " + std::to_string(static_cast<int>(altitudes_m[i])) + " m";
    expect_recorded_relative("pressure" + at + ", Pa", air.pressure_pa, pressures_pa[i], kRelative);
    expect_recorded_relative("density" + at + ", kg/m3", air.density_kgpm3, densities[i], kRelative);
  }
}

// [ISA1976] table 1, geometric altitudes.
TEST(Atmosphere, AS4_AgreesWithTheStandardsTableUpToTheTropopause) {
  struct Row {
    double altitude_m, temperature_k, pressure_pa, density_kgpm3;
  };
  for (const Row& row : {Row{0.0, 288.150, 101325.0, 1.2250}, Row{1000.0, 281.651, 89876.0, 1.1117},
                         Row{5000.0, 255.676, 54048.0, 0.73643}, Row{10000.0, 223.252, 26500.0, 0.41351}}) {
    const StandardAir air = standard_air(row.altitude_m);
    EXPECT_NEAR(air.temperature_k, row.temperature_k, 6e-4);
    EXPECT_NEAR(air.pressure_pa, row.pressure_pa, kPrinted * row.pressure_pa);
    EXPECT_NEAR(air.density_kgpm3, row.density_kgpm3, kPrinted * row.density_kgpm3);
  }
}

TEST(Atmosphere, AS4_PressureAltitudeInvertsTheModelToAMillimeter) {
  for (double altitude_m = -500.0; altitude_m <= 11000.0; altitude_m += 12.5) {
    EXPECT_NEAR(pressure_altitude_m(standard_air(altitude_m).pressure_pa), altitude_m, 1e-3);
  }
}

TEST(Atmosphere, AS4_PressureIsHydrostatic) {
  // Hydrostatics: dp/dz = -g rho, g falling with the square of the distance from the Earth's center.
  for (const double altitude_m : {0.0, 300.0, 3000.0}) {
    const double slope =
        (standard_air(altitude_m + 1.0).pressure_pa - standard_air(altitude_m - 1.0).pressure_pa) / 2.0;
    const double gravity = 9.80665 * std::pow(6356766.0 / (6356766.0 + altitude_m), 2);
    EXPECT_NEAR(slope / (gravity * standard_air(altitude_m).density_kgpm3), -1.0, 1e-6) << altitude_m;
  }
}

}  // namespace
}  // namespace hedgehop::dynamics::air
