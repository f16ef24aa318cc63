#include "sim/sweep/sweep.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

namespace hedgehop::sim {
namespace {

TEST(FlightTable, MetricsOfWallTimeAreAmongTheTimesByKindNotByName) {
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

TEST(FlightTable, StoresColumnsThatDifferOnlyInCase) {
  Table table;
  for (const char* name : {"AA", "aa", "Aa", "b"}) table.columns.push_back({.name = name});
  table.rows = {{int64_t{1}, int64_t{2}, int64_t{3}, int64_t{4}}};
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "case.sqlite";
  write_sqlite(file, table);
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  sqlite3_stmt* statement = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(database, "SELECT AA, aa_2, Aa_3, b FROM flights", -1, &statement, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  ASSERT_EQ(sqlite3_step(statement), SQLITE_ROW);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(sqlite3_column_int(statement, i), i + 1);
  sqlite3_finalize(statement);
  sqlite3_close(database);
}

}  // namespace
}  // namespace hedgehop::sim
