#include "sim/collision/ray_cast.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include <algorithm>
#include <cmath>

namespace hedgehop::sim {
namespace {

/// Keeps the nearest of the hits that Bullet reports.
struct NearestHit : btCollisionWorld::RayResultCallback {
  btScalar addSingleResult(btCollisionWorld::LocalRayResult& hit, bool) override {
    m_closestHitFraction = hit.m_hitFraction;
    met = true;
    return hit.m_hitFraction;
  }
  bool met = false;
};

btTransform at(const Eigen::Vector3d& p_W) {
  return btTransform(btMatrix3x3::getIdentity(), btVector3(p_W.x(), p_W.y(), p_W.z()));
}

/// Bullet's own answer.
std::optional<double> cast(const btCollisionObjectWrapper& placed, const Eigen::Vector3d& from_W,
                           const Eigen::Vector3d& to_W) {
  NearestHit hit;
  btCollisionWorld::rayTestSingleInternal(at(from_W), at(to_W), &placed, hit);
  if (!hit.met) return std::nullopt;
  return hit.m_closestHitFraction;
}

}  // namespace

std::optional<double> ray_fraction(const btCollisionShape& shape, const btTransform& X_WS,
                                   const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W) {
  constexpr int kWhole = -1;  // not a part of a compound
  const btCollisionObjectWrapper placed(nullptr, &shape, nullptr, X_WS, kWhole, kWhole);
  const double length_m = (to_W - from_W).norm();
  const Eigen::Vector3d direction_W = (to_W - from_W) / length_m;

  // About one segment in four thousand that passes a convex shape is said to meet it, up to metres beside it. A hit is
  // believed when a short segment across it meets the shape at the same place; else the search goes on behind it.
  constexpr double kAcross_m = 0.02, kSame_m = 1e-3;
  constexpr int kMostFalseHits = 8;
  double begin_m = 0.0;
  for (int i = 0; i <= kMostFalseHits && begin_m < length_m; ++i) {
    const std::optional<double> hit = cast(placed, from_W + begin_m * direction_W, to_W);
    if (!hit) return std::nullopt;
    const double hit_m = begin_m + *hit * (length_m - begin_m);
    const double before_m = std::max(begin_m, hit_m - kAcross_m), behind_m = hit_m + kAcross_m;
    const std::optional<double> again = cast(placed, from_W + before_m * direction_W, from_W + behind_m * direction_W);
    if (again && std::abs(before_m + *again * (behind_m - before_m) - hit_m) < kSame_m) return hit_m / length_m;
    begin_m = behind_m;
  }
  return std::nullopt;
}

}  // namespace hedgehop::sim
