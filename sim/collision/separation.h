#pragma once

#include <Eigen/Core>

#include "sim/collision/convex_body.h"

namespace hedgehop::sim {

struct Separation {
  double distance_m = 0.0;                                ///< < 0: depth of the overlap
  Eigen::Vector3d on_first_W = Eigen::Vector3d::Zero();   ///< the first body's point nearest to the second, m
  Eigen::Vector3d on_second_W = Eigen::Vector3d::Zero();  ///< and the second's nearest to the first
};

/// Returns the distance of two bodies, to 1e-7 m, by a certificate. Nearer than that they touch: then the result is 0
/// or, as Bullet tells it, the depth of their overlap, good to about 1e-4 m. With a sphere, distance and depth are
/// closed forms.
Separation separate(const PlacedBody& first, const PlacedBody& second);

}  // namespace hedgehop::sim
