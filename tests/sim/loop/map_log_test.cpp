#include "sim/loop/map_log.h"

#include <gtest/gtest.h>

namespace hedgehop::sim {
namespace {

using Eigen::Vector2d;

avoidance::Map planning(size_t places) {
  avoidance::Map map;
  map.course_NE = {Vector2d(0, 0), Vector2d(100, 0)};
  for (size_t i = 0; i < places; ++i) map.path_NE.emplace_back(10.0 * static_cast<double>(i), 5.0);
  return map;
}

TEST(MapLog, OfAModuleWithoutAMapIsEmpty) {
  MapLog log;
  for (int i = 0; i < 20; ++i) log.add(i, {});
  EXPECT_TRUE(log.record().empty());
}

// A decision every 0.5 s: straight on, a detour of 2 places from 2 s on, one of 3 from 7 s on, straight again from 8 s.
TEST(MapLog, KeepsDetoursEveryTwoSecondsAndWhenTheirTurnsChange) {
  MapLog log;
  for (int i = 0; i < 20; ++i) {
    const double t_s = 0.5 * i;
    log.add(t_s, planning(t_s < 2.0 ? 1 : t_s < 7.0 ? 2 : t_s < 8.0 ? 3 : 1));
  }
  const MapRecord record = log.record();
  std::vector<std::pair<double, size_t>> kept;
  for (const PlannedPath& path : record.paths) kept.emplace_back(path.t_s, path.places_NE.size());
  EXPECT_EQ(kept, (std::vector<std::pair<double, size_t>>{{2.0, 2}, {4.0, 2}, {6.0, 2}, {7.0, 3}, {8.0, 1}}));
  EXPECT_EQ(record.course_NE.size(), 2U);
}

}  // namespace
}  // namespace hedgehop::sim
