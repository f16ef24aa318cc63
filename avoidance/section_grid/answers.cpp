#include "avoidance/section_grid/answers.h"

#include <stdexcept>

namespace hedgehop::avoidance::section_grid {

Eigen::Vector3d direction_B(Answer answer, const Eigen::Vector3d& ray_B, double side, bool recedes) {
  const double back = recedes ? 1.0 : 0.0;
  switch (answer) {
    case Answer::waypoint:
      return ray_B.normalized();
    case Answer::heading:
      return Eigen::Vector3d(ray_B.x(), ray_B.y(), 0.0).normalized();
    case Answer::sideways:
      return Eigen::Vector3d(-back, side, 0.0).normalized();
    case Answer::climb:
      return {0.0, 0.0, -1.0};
    case Answer::combined:
      return Eigen::Vector3d(-back, side, -1.0).normalized();
  }
  throw std::logic_error("unknown answer");
}

bool faces_path(Answer answer) { return answer == Answer::waypoint || answer == Answer::heading; }

}  // namespace hedgehop::avoidance::section_grid
