#include "dynamics/helicopter/trim.h"

#include "dynamics/helicopter/trim_solver.h"

namespace hedgehop::dynamics::helicopter {

std::optional<Trim> trim(const HelicopterModel& model, const Eigen::Vector3d& v_air_W, double heading_rad) {
  return solver::find_trim(model, v_air_W, heading_rad);
}

LinearModel linearize(const HelicopterModel& model, const Trim& trim) { return solver::linear_model(model, trim); }

}  // namespace hedgehop::dynamics::helicopter
