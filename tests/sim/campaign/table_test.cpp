#include "sim/campaign/table.h"

#include <gtest/gtest.h>

namespace hedgehop::sim {
namespace {

TEST(FlightTable, MetricsOfWallTimeStandAmongTheTimesByTheirKindNotTheirName) {
  FlightRecord record{.status = FlightRecord::Status::flown};
  record.result = {{"outcome", "reached"},
                   {"metrics", {{"landmarks", 8.0}, {"filter_total", 12.5}, {"delay_ms", 40.0}}},
                   {"metric_units", {{"landmarks", ""}, {"filter_total", "ms"}, {"delay_ms", "ms"}}},
                   {"metric_kinds", {{"landmarks", "module"}, {"filter_total", "wall_time"}, {"delay_ms", "judged"}}},
                   {"checks", nlohmann::ordered_json::array()}};
  const Table table = flight_table({record});
  const auto column = [&](const char* name) { return column_index(table, name); };
  ASSERT_LT(column("metric.landmarks"), table.columns.size());
  ASSERT_LT(column("metric.delay_ms"), table.columns.size());
  EXPECT_EQ(column("metric.filter_total"), table.columns.size());
  ASSERT_LT(column("time.filter_total"), table.columns.size());
  EXPECT_EQ(std::get<double>(table.rows[0][column("time.filter_total")]), 12.5);
  EXPECT_EQ(table.columns[column("time.filter_total")].unit, "ms");
  EXPECT_EQ(table.columns[column("time.filter_total")].kind, FigureKind::wall_time);
  EXPECT_EQ(table.columns[column("metric.landmarks")].kind, FigureKind::module);
  EXPECT_EQ(table.columns[column("metric.delay_ms")].kind, FigureKind::judged);
}

}  // namespace
}  // namespace hedgehop::sim
