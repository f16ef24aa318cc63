#pragma once

#include <Eigen/Core>

#include "sim/collision/convex_body.h"

namespace hedgehop::sim {

struct Separation {
  double distance_m = 0.0;                                ///< < 0: depth of the overlap
  Eigen::Vector3d on_first_W = Eigen::Vector3d::Zero();   ///< the first body's point nearest to the second, m
  Eigen::Vector3d on_second_W = Eigen::Vector3d::Zero();  ///< and the second's nearest to the first
};

/// Returns the distance of two bodies, certified to 1e-7 m. Closer bodies are in contact: the result is then 0 or the
/// depth of their overlap as Bullet computes it, to about 1e-4 m. With a sphere, distance and depth are closed forms.
Separation separate(const PlacedBody& first, const PlacedBody& second);

}  // namespace hedgehop::sim
