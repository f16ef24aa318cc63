#include "scenes/scene.h"

#include <stdexcept>

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

size_t solid_count(const Scene& scene) {
  size_t count = scene.solids.size();
  for (const Mover& mover : scene.movers) count += mover.solids.size();
  return count;
}

const Solid& solid_at(const Scene& scene, size_t index) {
  if (index < scene.solids.size()) return scene.solids[index];
  index -= scene.solids.size();
  for (const Mover& mover : scene.movers) {
    if (index < mover.solids.size()) return mover.solids[index];
    index -= mover.solids.size();
  }
  throw std::out_of_range("the scene has fewer solids");
}

}  // namespace hedgehop::scenes
