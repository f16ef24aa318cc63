#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "sim/evidence/batch_record.h"

namespace hedgehop::sim {
namespace {

using testing::HasSubstr;

TEST(Summary, StatesGroupsWithoutFlightsOrObstaclesInWords) {
  FlightRecord failed{.order = {.id = "a/seed1", .group = "a"}, .status = FlightRecord::Status::failed, .cause = "x"};
  FlightRecord alone{.order = {.id = "b/seed1", .group = "b"}, .status = FlightRecord::Status::flown};
  alone.result.emplace();
  alone.result->flight.closest_obstacle.distance_m = std::numeric_limits<double>::infinity();
  alone.result->flight.flight_time_s = 2.4;
  const std::string text = summary_text({.records = {failed, alone}});
  EXPECT_THAT(text, HasSubstr("| 0 | - | - | - |\n"));
  EXPECT_THAT(text, HasSubstr("| 0 | no obstacle | no obstacle | 2 |\n"));
}

}  // namespace
}  // namespace hedgehop::sim
