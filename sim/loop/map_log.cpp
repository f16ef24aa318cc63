#include "sim/loop/map_log.h"

#include <optional>
#include <utility>

namespace hedgehop::sim {

void MapLog::add(double t_s, avoidance::Map map) {
  constexpr double kBetweenS = 2.0;
  const size_t places = map.path_NE.size(), before = paths_.empty() ? 1 : paths_.back().places_NE.size();
  const bool is_detour = places > 1;
  if (places != before || (is_detour && t_s >= paths_.back().t_s + kBetweenS)) paths_.push_back({t_s, map.path_NE});
  last_ = std::move(map);
}

MapRecord MapLog::record() const {
  MapRecord record{.course_NE = last_.course_NE, .paths = paths_};
  for (const avoidance::MapPoint& point : last_.points) {
    record.points.push_back({point.p_W, point.covariance_W, std::nullopt});
  }
  return record;
}

}  // namespace hedgehop::sim
