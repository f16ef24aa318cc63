#include "sim/collision/convex_body.h"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <algorithm>
#include <cmath>

namespace hedgehop::sim {

static_assert(sizeof(btScalar) == sizeof(double), "Bullet's double-precision libraries are needed");

namespace {

constexpr double kExactM = 1e-7;       // tolerance of a distance
constexpr int kMaxProjections = 2000;  // the worst of a million random pairs needs tens

Eigen::Vector3d to_eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// Returns the width of the slab normal to the unit vector n between the bodies, the second one ahead: a lower bound of
// their distance; < 0 if there is none.
double slab_m(const PlacedBody& first, const PlacedBody& second, const Eigen::Vector3d& n) {
  return -second.extent(-n) - first.extent(n);
}

// Returns the maximum slab width among those normal to `n` and to the bodies' faces.
double max_slab_m(const PlacedBody& first, const PlacedBody& second, const Eigen::Vector3d& n) {
  double max_m = slab_m(first, second, n);
  for (const PlacedBody* body : {&first, &second}) {
    for (const Eigen::Vector3d& n_S : body->body->normals_S) {
      const Eigen::Vector3d n_W = body->X_WS.linear() * n_S;
      max_m = std::max({max_m, slab_m(first, second, n_W), slab_m(first, second, -n_W)});
    }
  }
  return max_m;
}

Eigen::Vector3d direction(const Separation& apart) { return (apart.on_second_W - apart.on_first_W).normalized(); }

bool is_certified(const PlacedBody& first, const PlacedBody& second, const Separation& apart) {
  return apart.distance_m == 0.0 || apart.distance_m - slab_m(first, second, direction(apart)) <= kExactM;
}

// Alternating projections from a point `a` of the first body, with momentum that restarts when the distance grows. They
// converge to the nearest points, or to a common one. The result is certified unless it is nearer than kExactM.
Separation separate_by_projections(const PlacedBody& first, const PlacedBody& second, const Eigen::Vector3d& a) {
  Separation best{0.0, a, second.nearest(a)};
  Eigen::Vector3d previous_a = a;
  double momentum = 1.0;
  for (int i = 0; i < kMaxProjections; ++i) {
    best.distance_m = (best.on_second_W - best.on_first_W).norm();
    if (best.distance_m <= kExactM || is_certified(first, second, best)) break;
    double next_momentum = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum * momentum));
    const Eigen::Vector3d step = best.on_first_W - previous_a;
    const Eigen::Vector3d ahead = best.on_first_W + (momentum - 1.0) / next_momentum * step;
    const Eigen::Vector3d next_a = first.nearest(second.nearest(ahead));
    if ((ahead - next_a).dot(next_a - best.on_first_W) > 0.0) next_momentum = 1.0;
    previous_a = best.on_first_W;
    best.on_first_W = next_a;
    best.on_second_W = second.nearest(next_a);
    momentum = next_momentum;
  }
  return best;
}

// The point of a body nearest to a sphere is the one nearest to its center. If the center is inside the body, the depth
// of the center gives the depth of the overlap.
Separation separate_from_sphere(const PlacedBody& body, const PlacedBody& sphere) {
  const Eigen::Vector3d center_W = sphere.X_WS.translation(), on_body_W = body.nearest(center_W);
  const double radius_m = sphere.body->half_extents_m.x(), apart_m = (center_W - on_body_W).norm();
  if (apart_m == 0.0) return {-radius_m - body.body->depth_m(body.X_SW * center_W), center_W, center_W};
  return {apart_m - radius_m, on_body_W, center_W + radius_m / apart_m * (on_body_W - center_W)};
}

}  // namespace

Separation separate(const PlacedBody& first, const PlacedBody& second) {
  if (second.body->shape == ConvexBody::Shape::sphere) return separate_from_sphere(first, second);
  if (first.body->shape == ConvexBody::Shape::sphere) {
    const Separation swapped = separate_from_sphere(second, first);
    return {swapped.distance_m, swapped.on_second_W, swapped.on_first_W};
  }
  const btConvexShape* a = first.body->bullet.get();
  const btConvexShape* b = second.body->bullet.get();
  const btVector3 guess = second.bullet_X_WS.getOrigin() - first.bullet_X_WS.getOrigin();
  btGjkEpaSolver2::sResults found;
  Eigen::Vector3d start_W = first.X_WS.translation();
  if (btGjkEpaSolver2::Distance(a, first.bullet_X_WS, b, second.bullet_X_WS, guess, found)) {
    const Separation apart{found.distance, to_eigen(found.witnesses[0]), to_eigen(found.witnesses[1])};
    if (apart.distance_m > kExactM && is_certified(first, second, apart)) return apart;
    start_W = first.nearest(apart.on_first_W);
  }

  // Bullet's search ends too early for about one pair in a thousand, with errors up to meters. Results that it cannot
  // certify are computed by a second method.
  Separation apart = separate_by_projections(first, second, start_W);
  if (apart.distance_m > kExactM && is_certified(first, second, apart)) return apart;

  // If a face and an edge are parallel to about 1e-6 rad, the projections do not converge. The slab between the bodies
  // is then normal to the face.
  if (apart.distance_m > kExactM) {
    const double max_m = max_slab_m(first, second, direction(apart));
    if (max_m > kExactM) {
      apart.distance_m = std::min(apart.distance_m, max_m);
      return apart;
    }
  }

  // The bodies overlap or are too close to decide: compute the depth. Without a result they are in contact.
  constexpr bool kUseMargins = false;
  if (btGjkEpaSolver2::Penetration(a, first.bullet_X_WS, b, second.bullet_X_WS, guess, found, kUseMargins)) {
    return {std::min(found.distance, 0.0), to_eigen(found.witnesses[0]), to_eigen(found.witnesses[1])};
  }
  return {0.0, apart.on_first_W, apart.on_second_W};
}

}  // namespace hedgehop::sim
