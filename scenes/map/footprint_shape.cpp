#include "scenes/map/footprint_shape.h"

#include <algorithm>
#include <limits>

#include "scenes/mesh/polygon.h"

namespace hedgehop::scenes::map {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Returns whether the interiors of two segments cross.
bool cross_each_other(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const double ac = cross(b - a, c - a), ad = cross(b - a, d - a), ca = cross(d - c, a - c), cb = cross(d - c, b - c);
  return ((ac > 0.0) != (ad > 0.0)) && ((ca > 0.0) != (cb > 0.0));
}

bool crosses(const PlanRing& ring, const Vector2d& a, const Vector2d& b) {
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector2d &c = ring[i], &d = ring[(i + 1) % ring.size()];
    if (c == a || c == b || d == a || d == b) continue;
    if (cross_each_other(a, b, c, d)) return true;
  }
  return false;
}

/// Returns whether the direction to a point leads into the ring's interior at a corner.
bool leads_inside(const PlanRing& ring, size_t corner, const Vector2d& to) {
  const Vector2d &p = ring[corner], &next = ring[(corner + 1) % ring.size()],
                 &before = ring[(corner + ring.size() - 1) % ring.size()];
  const bool after_next = cross(next - p, to - p) > 0.0, before_last = cross(to - p, before - p) > 0.0;
  return cross(next - p, before - p) > 0.0 ? after_next && before_last : after_next || before_last;
}

/// Inserts a hole into a ring by a bridge from the northernmost corner of the hole.
void bridge(const PlanRing& hole, const std::vector<PlanRing>& others, PlanRing& ring) {
  const auto northmost = std::ranges::max_element(hole, {}, [](const Vector2d& p) { return p.x(); });
  size_t nearest = ring.size();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < ring.size(); ++i) {
    const double distance_m = (ring[i] - *northmost).norm();
    if (distance_m >= nearest_m || !leads_inside(ring, i, *northmost) || crosses(ring, ring[i], *northmost)) continue;
    if (std::ranges::any_of(others, [&](const PlanRing& other) { return crosses(other, ring[i], *northmost); }))
      continue;
    nearest = i;
    nearest_m = distance_m;
  }
  if (nearest == ring.size()) return;  // the hole lies outside
  PlanRing inserted{ring[nearest]};
  inserted.insert(inserted.end(), northmost, hole.end());
  inserted.insert(inserted.end(), hole.begin(), northmost + 1);
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(nearest), inserted.begin(), inserted.end());
}

}  // namespace

PlanRing simplified(const PlanRing& ring) {
  constexpr double kOffLineM = 1e-3;
  PlanRing kept = ring;
  for (size_t i = 0; kept.size() >= 3 && i < kept.size();) {
    const Vector2d &before = kept[(i + kept.size() - 1) % kept.size()], &after = kept[(i + 1) % kept.size()];
    const Vector2d across = after - before;
    const bool is_on_line = std::abs(cross(across, kept[i] - before)) <= kOffLineM * across.norm();
    if (is_on_line || (kept[i] - before).norm() <= kOffLineM) {
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
      i = i > 0 ? i - 1 : 0;
    } else {
      ++i;
    }
  }
  return kept.size() >= 3 ? kept : PlanRing();
}

bool is_convex(const PlanRing& ring) {
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()], &c = ring[(i + 2) % ring.size()];
    if (!(cross(b - a, c - b) > 0.0)) return false;
  }
  return ring.size() >= 3;
}

FootprintTriangles triangles_of(const Footprint& footprint) {
  std::vector<PlanRing> holes = footprint.holes;
  const auto north_m = [](const PlanRing& ring) {
    return std::ranges::max(ring, {}, [](const Vector2d& p) { return p.x(); }).x();
  };
  std::ranges::stable_sort(holes, {}, north_m);
  FootprintTriangles result{footprint.outer, {}};
  while (!holes.empty()) {  // from north to south, so that a bridge meets only holes that are connected
    const PlanRing hole = std::move(holes.back());
    holes.pop_back();
    bridge(hole, holes, result.corners);
  }
  std::vector<Eigen::Vector3d> corners;
  for (const Vector2d& p : result.corners) corners.emplace_back(p.x(), p.y(), 0.0);
  result.triangles = mesh::triangles_of_polygon(corners);
  return result;
}

}  // namespace hedgehop::scenes::map
