#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::sim {

/// The visible surface of one object of a scene, for viewers: triangles with one color per corner.
struct SurfaceMesh {
  std::string id;                         ///< unique in the scene: "building 3", "balloon"
  scenes::SemanticClass kind = {};        ///< of the object
  std::vector<Eigen::Vector3f> points_E;  ///< m; of a mover from its foot
  std::vector<Eigen::Vector3f> colors;    ///< of the points, red green blue, 0..1: mean of the texture in the light
  std::vector<uint32_t> indices;          ///< three per triangle, counter-clockwise seen from outside
};

/// Passes each object of the scene that has triangles, one at a time, in the order of scenes::instances(), without the
/// movers. Scenes of many triangles have the detail of distant chunks.
void for_each_object(const scenes::Scene& scene, const std::function<void(const SurfaceMesh&)>& use);

/// Passes each mover of the scene, in order.
void for_each_mover(const scenes::Scene& scene, const std::function<void(const SurfaceMesh&)>& use);

/// Returns the frame of a mover, which translates along E's axes: "mover/<number>", from 0.
std::string mover_frame(size_t mover);

}  // namespace hedgehop::sim
