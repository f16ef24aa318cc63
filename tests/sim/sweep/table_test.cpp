#include "sim/sweep/sweep.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

TEST(FlightTable, MetricsOfWallTimeAreAmongTheTimesByKindNotByName) {
  FlightRecord record{.status = FlightRecord::Status::flown};
  record.result.emplace();
  record.result->flight.outcome = Outcome::reached;
  record.result->flight.metrics = {{"landmarks", 8.0, "", FigureKind::module},
                                   {"filter_total", 12.5, "ms", FigureKind::wall_time},
                                   {"delay_ms", 40.0, "ms", FigureKind::judged}};
  const Table table = flight_table({record});
  ASSERT_TRUE(table.has("metric.landmarks"));
  ASSERT_TRUE(table.has("metric.delay_ms"));
  EXPECT_FALSE(table.has("metric.filter_total"));
  ASSERT_TRUE(table.has("time.filter_total"));
  EXPECT_EQ(table.numbers("time.filter_total"), std::vector<double>{12.5});
  EXPECT_EQ(table.column("time.filter_total").unit, "ms");
  EXPECT_EQ(table.column("time.filter_total").kind, FigureKind::wall_time);
  EXPECT_EQ(table.column("metric.landmarks").kind, FigureKind::module);
  EXPECT_EQ(table.column("metric.delay_ms").kind, FigureKind::judged);
}

TEST(FlightTable, StoresColumnsThatDifferOnlyInCase) {
  Table table;
  double number = 0.0;
  for (const char* name : {"AA", "aa", "Aa", "b"})
    table.add({.name = name, .values = std::vector{++number}, .whole = true});
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "case.sqlite";
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
