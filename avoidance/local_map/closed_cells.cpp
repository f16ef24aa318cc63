#include "avoidance/local_map/closed_cells.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::local_map {

void ClosedCells::close_cell(const Eigen::Vector3d& p_W, double until_s) {
  const Eigen::Vector3i at = (p_W / cell_m_).array().floor().cast<int>();
  const Cell cell = {at.x(), at.y(), at.z()};
  if (until_s_.size() >= kMost && !until_s_.contains(cell)) return;
  double& kept_s = until_s_[cell];
  kept_s = std::max(kept_s, until_s);
}

void ClosedCells::close(const Eigen::Vector3d& p_W, double radius_m, double t_s) {
  const int reach = static_cast<int>(std::ceil(radius_m / cell_m_));
  for (int row = -reach; row <= reach; ++row) {
    for (int col = -reach; col <= reach; ++col) {
      const Eigen::Vector3d off_W(row * cell_m_, col * cell_m_, 0.0);
      if (off_W.norm() < radius_m) close_cell(p_W + off_W, t_s + kUnknownS);
    }
  }
}

void ClosedCells::update(double t_s) {
  std::erase_if(until_s_, [&](const auto& cell) { return cell.second < t_s; });
}

}  // namespace hedgehop::avoidance::local_map
