#include "sim/collision/separation.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <algorithm>
#include <cmath>

namespace hedgehop::sim {

static_assert(sizeof(btScalar) == sizeof(double), "Bullet's double-precision libraries are needed");

namespace {

constexpr double kExact_m = 1e-7;      // what a distance may be off
constexpr int kMaxProjections = 2000;  // tens are enough for the worst of a million random pairs

btVector3 to_bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d to_eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const Eigen::Isometry3d& X) {
  const Eigen::Matrix3d R = X.linear();
  const btMatrix3x3 basis(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2));
  return btTransform(basis, to_bullet(X.translation()));
}

// Bullet shapes carry a margin that rounds them; without it they are the exact bodies.
std::unique_ptr<const btConvexShape> bullet_shape(ConvexBody::Shape shape, const Eigen::Vector3d& half_extents_m) {
  std::unique_ptr<btConvexShape> made;
  if (shape == ConvexBody::Shape::cylinder) {
    made = std::make_unique<btCylinderShapeZ>(to_bullet(half_extents_m));
  } else {
    made = std::make_unique<btBoxShape>(to_bullet(half_extents_m));
  }
  made->setMargin(0.0);
  return made;
}

// Width of the slab square to the unit vector n that fits between the bodies, the second one ahead: a lower bound of
// their distance, < 0 when none fits.
double slab_m(const PlacedBody& first, const PlacedBody& second, const Eigen::Vector3d& n) {
  return -second.reach(-n) - first.reach(n);
}

// The widest slab among those square to `n` and to the bodies' own axes.
double widest_slab_m(const PlacedBody& first, const PlacedBody& second, const Eigen::Vector3d& n) {
  double widest_m = slab_m(first, second, n);
  for (const PlacedBody* body : {&first, &second}) {
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d face_W = body->X_WS.linear().col(axis);
      widest_m = std::max({widest_m, slab_m(first, second, face_W), slab_m(first, second, -face_W)});
    }
  }
  return widest_m;
}

Eigen::Vector3d direction(const Separation& apart) { return (apart.on_second_W - apart.on_first_W).normalized(); }

bool is_proved(const PlacedBody& first, const PlacedBody& second, const Separation& apart) {
  return apart.distance_m == 0.0 || apart.distance_m - slab_m(first, second, direction(apart)) <= kExact_m;
}

// From a point `a` of the first body, projections to the one body and back, with momentum that restarts when it points
// uphill, lead to the nearest points, or to a common one. The result is proved unless it is nearer than kExact_m.
Separation separate_by_projections(const PlacedBody& first, const PlacedBody& second, const Eigen::Vector3d& a) {
  Separation best{0.0, a, second.nearest(a)};
  Eigen::Vector3d previous_a = a;
  double momentum = 1.0;
  for (int i = 0; i < kMaxProjections; ++i) {
    best.distance_m = (best.on_second_W - best.on_first_W).norm();
    if (best.distance_m <= kExact_m || is_proved(first, second, best)) break;
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

}  // namespace

ConvexBody::ConvexBody(Shape shape_, const Eigen::Vector3d& half_extents)
    : shape(shape_), half_extents_m(half_extents), bullet(bullet_shape(shape_, half_extents)) {
  const double across_m = shape == Shape::cylinder ? half_extents_m.x() : half_extents_m.head<2>().norm();
  bounding_radius_m = std::hypot(across_m, half_extents_m.z());
}

Eigen::Vector3d ConvexBody::nearest(const Eigen::Vector3d& p_S) const {
  if (shape == Shape::box) return p_S.cwiseMax(-half_extents_m).cwiseMin(half_extents_m);
  Eigen::Vector3d q = p_S;
  const double radius_m = half_extents_m.x(), off_axis_m = std::hypot(p_S.x(), p_S.y());
  if (off_axis_m > radius_m) q.head<2>() *= radius_m / off_axis_m;
  q.z() = std::clamp(p_S.z(), -half_extents_m.z(), half_extents_m.z());
  return q;
}

Eigen::Vector3d ConvexBody::farthest(const Eigen::Vector3d& direction_S) const {
  Eigen::Vector3d q = half_extents_m;
  for (int axis = 0; axis < 3; ++axis) q[axis] = std::copysign(q[axis], direction_S[axis]);
  const double off_axis = std::hypot(direction_S.x(), direction_S.y());
  if (shape == Shape::cylinder && off_axis > 0.0) q.head<2>() = half_extents_m.x() / off_axis * direction_S.head<2>();
  return q;
}

PlacedBody::PlacedBody(const ConvexBody& body_, const Eigen::Isometry3d& X)
    : body(&body_), X_WS(X), X_SW(X.inverse()), bullet_X_WS(to_bullet(X)) {}

double PlacedBody::reach(const Eigen::Vector3d& direction_W) const {
  return direction_W.dot(X_WS * body->farthest(X_SW.linear() * direction_W));
}

Separation separate(const PlacedBody& first, const PlacedBody& second) {
  const btConvexShape* a = first.body->bullet.get();
  const btConvexShape* b = second.body->bullet.get();
  const btVector3 guess = second.bullet_X_WS.getOrigin() - first.bullet_X_WS.getOrigin();
  btGjkEpaSolver2::sResults found;
  Eigen::Vector3d start_W = first.X_WS.translation();
  if (btGjkEpaSolver2::Distance(a, first.bullet_X_WS, b, second.bullet_X_WS, guess, found)) {
    const Separation apart{found.distance, to_eigen(found.witnesses[0]), to_eigen(found.witnesses[1])};
    if (apart.distance_m > kExact_m && is_proved(first, second, apart)) return apart;
    start_W = first.nearest(apart.on_first_W);
  }

  // Bullet's search stops early at about one pair in a thousand, off by up to metres: what it cannot prove is measured
  // a second way.
  Separation apart = separate_by_projections(first, second, start_W);
  if (apart.distance_m > kExact_m && is_proved(first, second, apart)) return apart;

  // Where a face is parallel to an edge but for some 1e-6 rad, the nearest points slide on and on; the slab between the
  // bodies is then square to the face.
  if (apart.distance_m > kExact_m) {
    const double widest_m = widest_slab_m(first, second, direction(apart));
    if (widest_m > kExact_m) {
      apart.distance_m = std::min(apart.distance_m, widest_m);
      return apart;
    }
  }

  // Overlapping, or too near to tell: ask for the depth. No answer means that they just touch.
  constexpr bool kUseMargins = false;
  if (btGjkEpaSolver2::Penetration(a, first.bullet_X_WS, b, second.bullet_X_WS, guess, found, kUseMargins)) {
    return {std::min(found.distance, 0.0), to_eigen(found.witnesses[0]), to_eigen(found.witnesses[1])};
  }
  return {0.0, apart.on_first_W, apart.on_second_W};
}

}  // namespace hedgehop::sim
