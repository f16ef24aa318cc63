#include "sim/simulation/map_judge.h"

#include <utility>
#include <variant>

#include "scenes/worlds/highrise.h"
#include "sim/verdict/corner_sight.h"

namespace hedgehop::sim {

MapJudge::MapJudge(const Scenario& scenario) {
  if (const auto* highrise = std::get_if<scenes::worlds::HighriseConfig>(&scenario.scene)) {
    corners_W_ = scenes::worlds::highrise_corners(*highrise);
  }
}

void MapJudge::on_map(const MapInstant& now) {
  if (corners_W_.empty()) return;
  if (!score_) score_.emplace(corners_W_, now.p_WB_start_true);
  std::vector<Eigen::Vector3d> points_W;
  for (const avoidance::ChartPoint& point : now.chart.points) points_W.push_back(point.p_W);
  score_->add(now.t_s, points_W,
              corners_in_sight(corners_W_, now.camera.model, now.X_WB_true * now.camera.X_BC,
                               now.sees_through_walls ? nullptr : &now.world, now.t_s));
}

void MapJudge::conclude(Flight& flight) const {
  if (!score_) return;
  for (MetricValue& metric : score_->metrics()) flight.result.metrics.push_back(std::move(metric));
  score_->complete(flight.map);
}

}  // namespace hedgehop::sim
