#include "sim/collision/convex_body.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include <algorithm>
#include <cmath>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

using Eigen::Vector3d;
using Shape = ConvexBody::Shape;

btTransform to_bullet_transform(const Eigen::Isometry3d& X) {
  const Eigen::Matrix3d R = X.linear();
  const btMatrix3x3 basis(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2));
  return btTransform(basis, to_bullet(X.translation()));
}

// Bullet shapes have a margin that rounds them; without it they are exact. A sphere is defined by its margin alone.
std::unique_ptr<const btConvexShape> bullet_shape(Shape shape, const Vector3d& half_extents_m) {
  if (shape == Shape::sphere) return std::make_unique<btSphereShape>(half_extents_m.x());
  std::unique_ptr<btConvexShape> made;
  if (shape == Shape::cylinder) {
    made = std::make_unique<btCylinderShapeZ>(to_bullet(half_extents_m));
  } else {
    made = std::make_unique<btBoxShape>(to_bullet(half_extents_m));
  }
  made->setMargin(0.0);
  return made;
}

std::unique_ptr<const btConvexShape> bullet_shape(const scenes::mesh::Polyhedron& polyhedron) {
  auto made = std::make_unique<btConvexHullShape>();
  for (const Vector3d& corner : polyhedron.corners) made->addPoint(to_bullet(corner), /*recalculateLocalAabb=*/false);
  made->setMargin(0.0);
  made->recalcLocalAabb();
  return made;
}

// Returns the six axis directions for boxes and cylinders.
std::vector<Vector3d> axis_normals(Shape shape) {
  std::vector<Vector3d> normals;
  for (int axis = 0; axis < 3 && shape != Shape::sphere; ++axis) {
    normals.push_back(Vector3d::Unit(axis));
    normals.push_back(-Vector3d::Unit(axis));
  }
  return normals;
}

// Returns the point of triangle abc nearest to p, by the region of the plane below p. Source: [Ericson2005] sec. 5.1.5.
Vector3d nearest_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double scale = 1.0 / (va + vb + vc);
  return a + vb * scale * ab + vc * scale * ac;
}

// The interval of a ray inside a body, in lengths of the ray.
struct RayInterval {
  double enter = 0.0, leave = kInfinity;

  double length() const { return enter <= leave ? enter : kInfinity; }
  void miss() { leave = -kInfinity; }
  // Clips to -half..half along one axis. @param at  start of the ray. @param rate  its component along the axis.
  void clip_slab(double at, double rate, double half) {
    if (rate == 0.0) {
      if (std::abs(at) > half) miss();
      return;
    }
    const double one = (-half - at) / rate, other = (half - at) / rate;
    enter = std::max(enter, std::min(one, other));
    leave = std::min(leave, std::max(one, other));
  }
  // Clips to a circle or sphere around the origin.
  template <class Vector>
  void clip_round(const Vector& at, const Vector& rate, double radius) {
    const double a = rate.squaredNorm(), b = at.dot(rate), c = at.squaredNorm() - radius * radius;
    if (a == 0.0) {
      if (c > 0.0) miss();
      return;
    }
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) return miss();
    enter = std::max(enter, (-b - std::sqrt(discriminant)) / a);
    leave = std::min(leave, (-b + std::sqrt(discriminant)) / a);
  }
  // Clips to the back of a plane. @param ahead  start of the ray in front of it. @param rate  component along its
  // normal.
  void clip_plane(double ahead, double rate) {
    if (rate == 0.0) {
      if (ahead > 0.0) miss();
    } else if (rate < 0.0) {
      enter = std::max(enter, -ahead / rate);
    } else {
      leave = std::min(leave, -ahead / rate);
    }
  }
};

// Returns the length of a ray to a single triangle, from either side.
double ray_to_triangle(const Vector3d& p, const Vector3d& ray, const Vector3d& a, const Vector3d& b,
                       const Vector3d& c) {
  const Vector3d e1 = b - a, e2 = c - a, across = ray.cross(e2);
  const double det = e1.dot(across);
  if (det == 0.0) return kInfinity;
  const Vector3d s = p - a, q = s.cross(e1);
  const double u = s.dot(across) / det, v = ray.dot(q) / det, t = e2.dot(q) / det;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 ? t : kInfinity;
}

}  // namespace

ConvexBody::ConvexBody(Shape shape_, const Eigen::Vector3d& half_extents)
    : shape(shape_),
      half_extents_m(half_extents),
      normals_S(axis_normals(shape_)),
      bullet(bullet_shape(shape_, half_extents)) {
  const double across_m = shape == Shape::cylinder ? half_extents_m.x() : half_extents_m.head<2>().norm();
  bounding_radius_m = shape == Shape::sphere ? half_extents_m.x() : std::hypot(across_m, half_extents_m.z());
}

ConvexBody::ConvexBody(const scenes::mesh::Polyhedron& polyhedron_)
    : shape(Shape::polyhedron),
      half_extents_m(Vector3d::Zero()),
      bounding_radius_m(0.0),
      polyhedron(polyhedron_),
      bullet(bullet_shape(polyhedron_)) {
  for (const Vector3d& corner : polyhedron.corners) {
    half_extents_m = half_extents_m.cwiseMax(corner.cwiseAbs());
    bounding_radius_m = std::max(bounding_radius_m, corner.norm());
  }
  for (const auto& [a, b, c] : polyhedron.faces) {
    const Vector3d& from = polyhedron.corners[a];
    normals_S.push_back((polyhedron.corners[b] - from).cross(polyhedron.corners[c] - from).normalized());
  }
  if (polyhedron.faces.size() == 1) normals_S.push_back(-normals_S.front());
}

Eigen::Vector3d ConvexBody::nearest(const Eigen::Vector3d& p_S) const {
  if (shape == Shape::box) return p_S.cwiseMax(-half_extents_m).cwiseMin(half_extents_m);
  if (shape == Shape::sphere) {
    const double from_center_m = p_S.norm(), radius_m = half_extents_m.x();
    return from_center_m > radius_m ? Vector3d(radius_m / from_center_m * p_S) : p_S;
  }
  if (shape == Shape::polyhedron) {
    // The nearest point is on a face visible from p_S. From inside, no face is visible.
    const bool is_closed = polyhedron.faces.size() > 1;
    Vector3d best = p_S;
    double best_m2 = kInfinity;
    for (size_t k = 0; k < polyhedron.faces.size(); ++k) {
      const auto& [a, b, c] = polyhedron.faces[k];
      if (is_closed && normals_S[k].dot(p_S - polyhedron.corners[a]) <= 0.0) continue;
      const Vector3d q = nearest_on_triangle(p_S, polyhedron.corners[a], polyhedron.corners[b], polyhedron.corners[c]);
      const double m2 = (q - p_S).squaredNorm();
      if (m2 < best_m2) {
        best_m2 = m2;
        best = q;
      }
    }
    return best;
  }
  Eigen::Vector3d q = p_S;
  const double radius_m = half_extents_m.x(), off_axis_m = std::hypot(p_S.x(), p_S.y());
  if (off_axis_m > radius_m) q.head<2>() *= radius_m / off_axis_m;
  q.z() = std::clamp(p_S.z(), -half_extents_m.z(), half_extents_m.z());
  return q;
}

Eigen::Vector3d ConvexBody::support(const Eigen::Vector3d& direction_S) const {
  if (shape == Shape::sphere) return half_extents_m.x() * direction_S.normalized();
  if (shape == Shape::polyhedron) {
    return *std::ranges::max_element(polyhedron.corners, {}, [&](const Vector3d& p) { return direction_S.dot(p); });
  }
  Eigen::Vector3d q = half_extents_m;
  for (int axis = 0; axis < 3; ++axis) q[axis] = std::copysign(q[axis], direction_S[axis]);
  const double off_axis = std::hypot(direction_S.x(), direction_S.y());
  if (shape == Shape::cylinder && off_axis > 0.0) q.head<2>() = half_extents_m.x() / off_axis * direction_S.head<2>();
  return q;
}

double ConvexBody::depth_m(const Eigen::Vector3d& p_S) const {
  switch (shape) {
    case Shape::box:
      return (half_extents_m - p_S.cwiseAbs()).minCoeff();
    case Shape::cylinder:
      return std::min(half_extents_m.x() - std::hypot(p_S.x(), p_S.y()), half_extents_m.z() - std::abs(p_S.z()));
    case Shape::sphere:
      return half_extents_m.x() - p_S.norm();
    case Shape::polyhedron:
      break;
  }
  if (polyhedron.faces.size() == 1) return 0.0;
  double depth = kInfinity;
  for (size_t k = 0; k < polyhedron.faces.size(); ++k) {
    depth = std::min(depth, normals_S[k].dot(polyhedron.corners[polyhedron.faces[k][0]] - p_S));
  }
  return depth;
}

double ConvexBody::ray_length(const Eigen::Vector3d& p_S, const Eigen::Vector3d& ray_S) const {
  RayInterval inside;
  switch (shape) {
    case Shape::box:
      for (int axis = 0; axis < 3; ++axis) inside.clip_slab(p_S[axis], ray_S[axis], half_extents_m[axis]);
      break;
    case Shape::cylinder:
      inside.clip_slab(p_S.z(), ray_S.z(), half_extents_m.z());
      inside.clip_round(Eigen::Vector2d(p_S.head<2>()), Eigen::Vector2d(ray_S.head<2>()), half_extents_m.x());
      break;
    case Shape::sphere:
      inside.clip_round(p_S, ray_S, half_extents_m.x());
      break;
    case Shape::polyhedron:
      if (polyhedron.faces.size() == 1) {
        const auto& [a, b, c] = polyhedron.faces.front();
        return ray_to_triangle(p_S, ray_S, polyhedron.corners[a], polyhedron.corners[b], polyhedron.corners[c]);
      }
      for (size_t k = 0; k < polyhedron.faces.size(); ++k) {
        const Vector3d& on_face = polyhedron.corners[polyhedron.faces[k][0]];
        inside.clip_plane(normals_S[k].dot(p_S - on_face), normals_S[k].dot(ray_S));
      }
      break;
  }
  return inside.length();
}

PlacedBody::PlacedBody(const ConvexBody& body_, const Eigen::Isometry3d& X)
    : body(&body_), X_WS(X), X_SW(X.inverse()), bullet_X_WS(to_bullet_transform(X)) {}

double PlacedBody::extent(const Eigen::Vector3d& direction_W) const {
  return direction_W.dot(X_WS * body->support(X_SW.linear() * direction_W));
}

Eigen::Vector3d PlacedBody::half_size_W() const {
  if (body->shape == Shape::sphere) return body->half_extents_m;
  return X_WS.linear().cwiseAbs() * body->half_extents_m;
}

}  // namespace hedgehop::sim
