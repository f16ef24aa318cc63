#include "scenes/scene.h"

#include <algorithm>
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

double reach_m(const Mover& mover) {
  double reach_m = 0.0;
  for (const Solid& solid : mover.solids) {
    const Eigen::AlignedBox3d box_M = bounds_W(solid);
    reach_m = std::max(reach_m, box_M.min().cwiseAbs().cwiseMax(box_M.max().cwiseAbs()).norm());
  }
  return reach_m;
}

std::vector<Instance> instances(const Scene& scene) {
  std::vector<Instance> all;
  for (const Mesh& mesh : scene.meshes) all.insert(all.end(), mesh.instances.begin(), mesh.instances.end());
  for (const Mover& mover : scene.movers) all.push_back({mover.name, mover.mesh.instances.front().kind});
  return all;
}

int first_mover_label(const Scene& scene) {
  size_t label = 1;
  for (const Mesh& mesh : scene.meshes) label += mesh.instances.size();
  return static_cast<int>(label);
}

}  // namespace hedgehop::scenes
