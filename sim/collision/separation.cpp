#include "sim/collision/separation.h"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <algorithm>
#include <cmath>

namespace hedgehop::sim {

static_assert(sizeof(btScalar) == sizeof(double), "Bullet's double-precision libraries are needed");

namespace {

constexpr double kExactM = 1e-7;       // what a distance may be off
constexpr int kMaxProjections = 2000;  // tens are enough for the worst of a million random pairs

Eigen::Vector3d to_eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// Width of the slab square to the unit vector n that fits between the bodies, the second one ahead: a lower bound of
// their distance, < 0 when none fits.
double slab_m(const PlacedBody& first, const PlacedBody& second, const Eigen::Vector3d& n) {
  return -second.reach(-n) - first.reach(n);
}

// The widest slab among those square to `n` and to the bodies' own faces.
double widest_slab_m(const PlacedBody& first, const PlacedBody& second, const Eigen::Vector3d& n) {
  double widest_m = slab_m(first, second, n);
  for (const PlacedBody* body : {&first, &second}) {
    for (const Eigen::Vector3d& n_S : body->body->normals_S) {
      const Eigen::Vector3d n_W = body->X_WS.linear() * n_S;
      widest_m = std::max({widest_m, slab_m(first, second, n_W), slab_m(first, second, -n_W)});
    }
  }
  return widest_m;
}

Eigen::Vector3d direction(const Separation& apart) { return (apart.on_second_W - apart.on_first_W).normalized(); }

bool is_proved(const PlacedBody& first, const PlacedBody& second, const Separation& apart) {
  return apart.distance_m == 0.0 || apart.distance_m - slab_m(first, second, direction(apart)) <= kExactM;
}

// From a point `a` of the first body, projections to the one body and back, with momentum that restarts when it points
// uphill, lead to the nearest points, or to a common one. The result is proved unless it is nearer than kExactM.
Separation separate_by_projections(const PlacedBody& first, const PlacedBody& second, const Eigen::Vector3d& a) {
  Separation best{0.0, a, second.nearest(a)};
  Eigen::Vector3d previous_a = a;
  double momentum = 1.0;
  for (int i = 0; i < kMaxProjections; ++i) {
    best.distance_m = (best.on_second_W - best.on_first_W).norm();
    if (best.distance_m <= kExactM || is_proved(first, second, best)) break;
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

// The nearest point of a body to a sphere is the one to its center; inside, the way out is as long as the center is
// deep.
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
    if (apart.distance_m > kExactM && is_proved(first, second, apart)) return apart;
    start_W = first.nearest(apart.on_first_W);
  }

  // Bullet's search stops early at about one pair in a thousand, off by up to meters: what it cannot prove is measured
  // a second way.
  Separation apart = separate_by_projections(first, second, start_W);
  if (apart.distance_m > kExactM && is_proved(first, second, apart)) return apart;

  // Where a face is parallel to an edge but for some 1e-6 rad, the nearest points slide on and on; the slab between the
  // bodies is then square to the face.
  if (apart.distance_m > kExactM) {
    const double widest_m = widest_slab_m(first, second, direction(apart));
    if (widest_m > kExactM) {
      apart.distance_m = std::min(apart.distance_m, widest_m);
      return apart;
    }
  }

  // Overlapping, or too close to decide: compute the depth. No result means that they are just in contact.
  constexpr bool kUseMargins = false;
  if (btGjkEpaSolver2::Penetration(a, first.bullet_X_WS, b, second.bullet_X_WS, guess, found, kUseMargins)) {
    return {std::min(found.distance, 0.0), to_eigen(found.witnesses[0]), to_eigen(found.witnesses[1])};
  }
  return {0.0, apart.on_first_W, apart.on_second_W};
}

}  // namespace hedgehop::sim
