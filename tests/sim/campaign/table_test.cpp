#include "sim/campaign/table.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hedgehop::sim {
namespace {

TEST(FlightTable, MetricsOfWallTimeStandAmongTheTimes) {
  FlightRecord record{.status = FlightRecord::Status::flown};
  record.result = {{"outcome", "reached"},
                   {"metrics", {{"landmarks", 8.0}, {"filter_ms_total", 12.5}}},
                   {"checks", nlohmann::ordered_json::array()}};
  const Table table = flight_table({record});
  const auto column = [&](const char* name) { return std::ranges::find(table.columns, name); };
  EXPECT_NE(column("metric.landmarks"), table.columns.end());
  EXPECT_EQ(column("metric.filter_ms_total"), table.columns.end());
  const auto time = column("time.filter_ms_total");
  ASSERT_NE(time, table.columns.end());
  EXPECT_EQ(std::get<double>(table.rows[0][static_cast<size_t>(time - table.columns.begin())]), 12.5);
}

}  // namespace
}  // namespace hedgehop::sim
