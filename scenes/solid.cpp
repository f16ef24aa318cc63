#include "scenes/solid.h"

namespace hedgehop::scenes {

Eigen::AlignedBox3d bounds_W(const Solid& solid) {
  if (solid.shape == Solid::Shape::hull || solid.shape == Solid::Shape::surface) {
    Eigen::AlignedBox3d box_W;
    for (const Eigen::Vector3d& p_S : solid.polyhedron.corners) box_W.extend(solid.X_WS * p_S);
    return box_W;
  }
  const Eigen::Vector3d reach = solid.shape == Solid::Shape::sphere
                                    ? solid.half_extents_m
                                    : Eigen::Vector3d(solid.X_WS.linear().cwiseAbs() * solid.half_extents_m);
  return {solid.X_WS.translation() - reach, solid.X_WS.translation() + reach};
}

}  // namespace hedgehop::scenes
