#include "avoidance/local_map/seen_face.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kRememberedS = 2.0;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The convex hull, turning from x to y: Andrew's monotone chain.
std::vector<Eigen::Vector2d> hull_of(std::vector<Eigen::Vector2d> points) {
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::ranges::sort(points, before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> hull;
  const auto chain = [&](auto first, auto last) {
    const size_t begin = hull.size();
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= begin + 2 && cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();  // the other chain's first
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

}  // namespace

void SeenFace::move(const Eigen::Vector2d& by_W) {
  for (Corner& corner : corners_) corner.p_W += by_W;
}

void SeenFace::see(double t_s, std::span<const Eigen::Vector2d> points_W) {
  std::erase_if(corners_, [&](const Corner& corner) { return corner.t_s < t_s - kRememberedS; });
  for (const Eigen::Vector2d& p_W : hull_of({points_W.begin(), points_W.end()})) corners_.push_back({p_W, t_s});
}

std::vector<Eigen::Vector2d> SeenFace::hull_W() const {
  std::vector<Eigen::Vector2d> points;
  points.reserve(corners_.size());
  for (const Corner& corner : corners_) points.push_back(corner.p_W);
  return hull_of(std::move(points));
}

double away_m(std::span<const Eigen::Vector2d> convex, const Eigen::Vector2d& p) {
  double least_m = (p - convex.front()).norm();
  bool inside = convex.size() > 2;
  for (size_t i = 0; i < convex.size(); ++i) {
    const Eigen::Vector2d& a = convex[i];
    const Eigen::Vector2d along = convex[(i + 1) % convex.size()] - a;
    const double length_m2 = along.squaredNorm();
    if (length_m2 == 0.0) continue;
    const double share = std::clamp((p - a).dot(along) / length_m2, 0.0, 1.0);
    least_m = std::min(least_m, (p - a - share * along).norm());
    inside &= cross(along, p - a) >= 0.0;
  }
  return inside ? 0.0 : least_m;
}

}  // namespace hedgehop::avoidance::local_map
