#include "dynamics/hull.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hedgehop::dynamics {

double radius_m(const std::vector<HullPart>& hull) {
  double radius = 0.0;
  for (const HullPart& part : hull) {
    const Eigen::Vector2d center = part.center_B_m.head<2>();
    const double reach = part.shape == HullPart::Shape::cylinder
                             ? center.norm() + part.half_extents_m.x()
                             : (center.cwiseAbs() + part.half_extents_m.head<2>()).norm();
    radius = std::max(radius, reach);
  }
  return radius;
}

}  // namespace hedgehop::dynamics
