// Altitude of the navigation filter: height sensor, barometer, and changes of the surface below.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dynamics/control/navigation.h"
#include "tests/dynamics/control/closed_loop.h"

namespace hedgehop::dynamics::control {
namespace {

TEST(Navigation, RoofBelowIsNotInterpretedAsClimb) {
  Loop loop;
  loop.surface_m = [](const Eigen::Vector3d& p) { return p.x() > 6.0 && p.x() < 18.0 ? 6.0 : 0.0; };
  const auto across = [](double) { return VelocitySetpoint{{2.0, 0.0}, 10.0, 0.0}; };
  for (const std::vector<Sample>& flight : flights(loop, 5, 14.0, across)) {
    ASSERT_GT(flight.back().body.p_WB.x(), 22.0);
    int wrong_height = 0;
    for (const Sample& s : flight) {
      EXPECT_NEAR(s.estimate.p_WB_est.z(), s.body.p_WB.z(), 0.4) << s.t_s;
      if (s.t_s > kSettledS) {
        EXPECT_NEAR(s.body.p_WB.z(), -10.0, 0.5) << s.t_s;
      }
      const double height_m = -s.body.p_WB.z() - loop.surface_m(s.body.p_WB);
      if (std::abs(s.estimate.height_above_ground_m - height_m) > 0.4) ++wrong_height;
    }
    EXPECT_LE(wrong_height, 12);  // samples of 10 ms: at two edges, and drop-outs there
  }
}

/// RMS ratio of altitude errors to their sigmas, and the maximum error, m.
struct AltitudeErrors {
  double rms_ratio = 0.0, max_m = 0.0, within_3_sigma = 0.0;
};
AltitudeErrors altitude_errors(const std::vector<std::vector<Sample>>& flights) {
  AltitudeErrors e;
  double samples = 0.0;
  for (const std::vector<Sample>& flight : flights) {
    for (const Sample& s : flight) {
      const double error_m = s.estimate.p_WB_est.z() - s.body.p_WB.z(), sigma_m = s.estimate.sigma_p_W_m.z();
      e.rms_ratio += std::pow(error_m / sigma_m, 2);
      e.within_3_sigma += std::abs(error_m) <= 3.0 * sigma_m ? 1.0 : 0.0;
      e.max_m = std::max(e.max_m, std::abs(error_m));
      samples += 1.0;
    }
  }
  e.rms_ratio = std::sqrt(e.rms_ratio / samples);
  e.within_3_sigma /= samples;
  return e;
}

/// Flies at 10 m with a height sensor of 5 m range, without reception.
AltitudeErrors beyond_the_height_sensor(bool barometer) {
  Loop loop;
  loop.avionics.height_sensor.ranger.max_m = 5.0;
  loop.avionics.gps.enabled = false;
  loop.avionics.barometer.enabled = barometer;
  return altitude_errors(flights(loop, 12, 40.0, square));
}

TEST(Navigation, TheBarometerHoldsAltitudeBeyondTheHeightSensor) {
  const AltitudeErrors with = beyond_the_height_sensor(true), without = beyond_the_height_sensor(false);
  RecordProperty("max_m", std::to_string(with.max_m));
  RecordProperty("max_without_m", std::to_string(without.max_m));
  RecordProperty("rms_ratio", std::to_string(with.rms_ratio));
  // In 40 s, the wandering error changes by sigma sqrt(2 t / tau), 0.37 m, and the surveyed start has an error of 0.1
  // m. Twelve flights stay within three sigmas.
  EXPECT_LT(with.max_m, 3.0 * std::hypot(0.37, 0.1));
  EXPECT_GT(without.max_m, 2.0 * with.max_m);
  EXPECT_GT(with.within_3_sigma, 0.98);
  EXPECT_GT(with.rms_ratio, 0.5);  // the sigmas are not too large
  EXPECT_LT(with.rms_ratio, 1.4);
}

TEST(Navigation, HeightSensorCalibratesTheBarometer) {
  // A barometer with a large error does not change the altitude from the height sensor.
  Loop loop;
  loop.avionics.barometer.enabled = true;
  loop.avionics.barometer.wander_pa = 120.0;  // 10 m
  const AltitudeErrors e = altitude_errors(flights(loop, 4, 20.0, square));
  EXPECT_LT(e.max_m, 0.4);
  EXPECT_GT(e.within_3_sigma, 0.98);
}

TEST(Navigation, SigmaOfAltitudeIncludesTheHeightSensorsOffset) {
  // An offset of 0.3 m remains in the altitude; repeated readings must not reduce the sigma below it.
  Loop loop;
  loop.avionics.height_sensor.ranger.offset_m = 0.3;
  const AltitudeErrors e = altitude_errors(flights(loop, 12, 10.0, square));
  EXPECT_GT(e.max_m, 0.3);
  EXPECT_GT(e.within_3_sigma, 0.98);
  EXPECT_GT(e.rms_ratio, 0.5);
  EXPECT_LT(e.rms_ratio, 1.4);
}

TEST(Navigation, HeightEqualsAltitudeAboveTheGround) {
  for (const Sample& s : fly({}, 10.0, square)) {
    EXPECT_NEAR(s.estimate.height_above_ground_m, -s.estimate.p_WB_est.z(), 1e-12);
  }
}

}  // namespace
}  // namespace hedgehop::dynamics::control
