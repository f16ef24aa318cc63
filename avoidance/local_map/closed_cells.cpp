#include "avoidance/local_map/closed_cells.h"

#include <algorithm>

namespace hedgehop::avoidance::local_map {

void ClosedCells::close(const Eigen::Vector2d& p_W, double radius_m, double t_s) {
  if (places_.size() == kMost) places_.erase(places_.begin());
  places_.push_back({p_W, radius_m, t_s});
}

void ClosedCells::update(double t_s) {
  std::erase_if(places_, [&](const Place& place) { return t_s - place.t_s > keep_s_; });
}

}  // namespace hedgehop::avoidance::local_map
