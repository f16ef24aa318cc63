#include "sim/loop/module_pilot.h"

#include <gmock/gmock.h>

namespace hedgehop::sim {
namespace {

using dynamics::AvionicsConfig;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const avoidance::Needs kImages{{{.role = "front", .channel = avoidance::CameraNeed::Channel::grey},
                                {.role = "down", .channel = avoidance::CameraNeed::Channel::color}}};

AvionicsConfig with_everything_on() {
  AvionicsConfig config;
  config.barometer.enabled = config.range_finder.ranger.enabled = true;
  return config;
}

TEST(TruthUsed, OfImagesAndOrdinarySensorsIsNone) { EXPECT_THAT(truth_used(kImages, with_everything_on()), IsEmpty()); }

TEST(TruthUsed, ListsDepthAndProjectedCorners) {
  const avoidance::Needs needs{{{.role = "left", .channel = avoidance::CameraNeed::Channel::depth},
                                {.role = "front", .channel = avoidance::CameraNeed::Channel::corners},
                                {.role = "down", .channel = avoidance::CameraNeed::Channel::grey}}};
  EXPECT_THAT(truth_used(needs, {}), ElementsAre("camera 'left': depth", "camera 'front': projected corners"));
}

TEST(TruthUsed, ListsEverySensorWhoseErrorsAreAllZero) {
  AvionicsConfig config = with_everything_on();
  config.imu.gyro_noise_density = config.imu.gyro_bias_walk = config.imu.gyro_offset_radps = 0.0;
  config.imu.accelerometer_noise_density = config.imu.accelerometer_bias_walk = 0.0;
  config.imu.accelerometer_offset_mps2 = config.imu.misalignment_rad = 0.0;
  config.gps.noise_m = config.gps.wander_horizontal_m = config.gps.wander_vertical_m = 0.0;
  config.gps.velocity_noise_mps = 0.0;
  config.magnetometer.noise_rad = config.magnetometer.offset_rad = 0.0;
  config.barometer.noise_pa = config.barometer.wander_pa = 0.0;
  for (auto* ranger : {&config.height_sensor.ranger, &config.range_finder.ranger}) {
    ranger->noise_m = ranger->noise_per_range = ranger->offset_m = 0.0;
  }
  EXPECT_THAT(truth_used(kImages, config),
              ElementsAre("sensor 'imu': exact", "sensor 'gps': exact", "sensor 'height_sensor': exact",
                          "sensor 'magnetometer': exact", "sensor 'barometer': exact", "sensor 'range_finder': exact"));
  config.gps.enabled = config.height_sensor.ranger.enabled = config.magnetometer.enabled = false;
  config.barometer.enabled = config.range_finder.ranger.enabled = false;
  EXPECT_THAT(truth_used(kImages, config), ElementsAre("sensor 'imu': exact"));
}

TEST(TruthUsed, OneErrorMakesAnInstrumentReal) {
  AvionicsConfig config;
  config.imu.gyro_noise_density = config.imu.gyro_bias_walk = config.imu.gyro_offset_radps = 0.0;
  EXPECT_THAT(truth_used(kImages, config), IsEmpty());  // misaligned
  config.imu.misalignment_rad = 0.0;
  EXPECT_THAT(truth_used(kImages, config), ElementsAre("sensor 'imu': exact gyros"));
  config.gps.velocity_noise_mps = 0.0;
  EXPECT_THAT(truth_used(kImages, config), ElementsAre("sensor 'imu': exact gyros", "sensor 'gps': exact velocity"));
}

}  // namespace
}  // namespace hedgehop::sim
