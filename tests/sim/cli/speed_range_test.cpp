#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/cli/vehicle_commands.h"
#include "sim/config/input_error.h"

namespace hedgehop::sim::cli {
namespace {

using testing::ElementsAre;

TEST(SpeedRange, IsOneSpeedOrEvenSteps) {
  EXPECT_THAT(speed_range("3.5"), ElementsAre(3.5));
  EXPECT_THAT(speed_range("-4:4:2"), ElementsAre(-4.0, -2.0, 0.0, 2.0, 4.0));
  EXPECT_THAT(speed_range("0:5:2"), ElementsAre(0.0, 2.0, 4.0));
  EXPECT_THAT(speed_range("2:2:1"), ElementsAre(2.0));
}

TEST(SpeedRange, ContainsItsLastSpeedDespiteRounding) {
  for (const char* text : {"0:1:0.1", "0:0.3:0.1", "1:1.7:0.1"}) {
    const std::vector<double> speeds = speed_range(text);
    const std::string all(text);
    EXPECT_NEAR(speeds.back(), std::stod(all.substr(all.find(':') + 1)), 1e-9) << text;
  }
}

TEST(SpeedRange, RejectsOtherTexts) {
  for (const char* text :
       {"", "fast", "1:2", "1:2:0", "1:2:-1", "3:2:1", "1:2:3:4", "1:2:x", "nan", "0:inf:1", "2m", "0:1e9:1e-9"}) {
    EXPECT_THROW(speed_range(text), InputError) << text;
  }
}

TEST(SpeedRange, StatesTheMaximumNumberOfSpeeds) {
  EXPECT_EQ(speed_range("0:10:0.001").size(), 10001U);
  EXPECT_THAT(
      [] { speed_range("0:20:0.001"); },
      testing::ThrowsMessage<InputError>("--speed 0:20:0.001: 20001 speeds; valid: at most 10001; use a larger STEP"));
}

}  // namespace
}  // namespace hedgehop::sim::cli
