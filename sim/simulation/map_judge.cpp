#include "sim/simulation/map_judge.h"

#include <utility>
#include <vector>

#include "sim/verdict/map_score.h"

namespace hedgehop::sim {

void MapJudge::on_map(const MapInstant& now) {
  const std::vector<Eigen::Vector3d>& corners_W = now.scene.corners_W;
  if (corners_W.empty()) return;
  if (!score_) score_.emplace(corners_W, now.p_WB_start_true, MapScore::tolerance_m(now.scene.shortest_edge_m));
  std::vector<Eigen::Vector3d> points_W;
  for (const avoidance::MapPoint& point : now.map.points) points_W.push_back(point.p_W);
  score_->add(now.t_s, points_W,
              corners_in_sight(corners_W, now.camera.model, now.X_WB_true * now.camera.X_BC,
                               now.sees_through_walls ? nullptr : &now.world, now.t_s));
}

void MapJudge::conclude(Flight& flight) const {
  if (!score_) return;
  for (MetricValue& metric : score_->metrics()) flight.result.metrics.push_back(std::move(metric));
  score_->complete(flight.map);
}

}  // namespace hedgehop::sim
