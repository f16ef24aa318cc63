#include "avoidance/flow_balance/visited_floor.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::flow_balance {

void VisitedFloor::visit(const Eigen::Vector2d& p_NE) { cover(p_NE, visited_); }

int VisitedFloor::unvisited(const Eigen::Vector2d& from_NE, const Eigen::Vector2d& direction_NE,
                            double length_m) const {
  const double step_m = 0.5 * reach_m_;
  Squares covered;
  for (double along_m = 0.0; along_m <= length_m; along_m += step_m) cover(from_NE + along_m * direction_NE, covered);
  return static_cast<int>(
      std::ranges::count_if(covered, [this](const auto& square) { return !visited_.contains(square); }));
}

/// Adds the squares whose centers are within reach of a position.
void VisitedFloor::cover(const Eigen::Vector2d& p_NE, Squares& squares) const {
  const auto first = [this](double m) { return static_cast<int>(std::ceil((m - reach_m_) / cell_m_ - 0.5)); };
  const auto last = [this](double m) { return static_cast<int>(std::floor((m + reach_m_) / cell_m_ - 0.5)); };
  for (int north = first(p_NE.x()); north <= last(p_NE.x()); ++north) {
    for (int east = first(p_NE.y()); east <= last(p_NE.y()); ++east) {
      const Eigen::Vector2d center_NE = cell_m_ * Eigen::Vector2d(north + 0.5, east + 0.5);
      if ((p_NE - center_NE).norm() <= reach_m_) squares.emplace(north, east);
    }
  }
}

}  // namespace hedgehop::avoidance::flow_balance
