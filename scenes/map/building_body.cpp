#include "scenes/map/building_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenes/map/footprint_shape.h"
#include "sim/fields/quantities.h"

namespace hedgehop::scenes::map {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Face = std::array<uint32_t, 3>;

constexpr double kMinTriangleM2 = 1e-4;  // thinner parts of a concave footprint do not collide

Vector3d raised(const Vector2d& p_NE, double height_m) { return {p_NE.x(), p_NE.y(), -height_m}; }

/// A convex body over a ring: corner i of the bottom has index i, that of the top n + i; roof corners follow.
class ConvexBuilder {
 public:
  /// @param tops_m  heights of the top corners.
  ConvexBuilder(const PlanRing& ring, double bottom_m, const std::vector<double>& tops_m)
      : count_(static_cast<uint32_t>(ring.size())) {
    for (const Vector2d& p : ring) body_.corners.push_back(raised(p, bottom_m));
    for (size_t i = 0; i < ring.size(); ++i) body_.corners.push_back(raised(ring[i], tops_m[i]));
    for (uint32_t i = 0; i < count_; ++i) {
      const uint32_t next = (i + 1) % count_;
      body_.faces.push_back({top(next), next, i});
      body_.faces.push_back({top(next), i, top(i)});
      if (i >= 2) body_.faces.push_back({0, i - 1, i});
    }
  }

  uint32_t top(uint32_t i) const { return count_ + i % count_; }
  uint32_t add_corner(const Vector3d& p) {
    body_.corners.push_back(p);
    return static_cast<uint32_t>(body_.corners.size() - 1);
  }

  void add(const Face& face, std::vector<BuildingBody::Triangle>& drawn) {
    body_.faces.push_back(face);
    drawn.push_back({body_.corners[face[0]], body_.corners[face[1]], body_.corners[face[2]]});
  }
  /// Adds a face of four corners, divided such that the body is convex if they are not in a plane.
  void add_quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d, std::vector<BuildingBody::Triangle>& drawn) {
    const auto& p = body_.corners;
    if ((p[b] - p[a]).cross(p[c] - p[a]).dot(p[d] - p[a]) <= 0.0) {
      add({a, b, c}, drawn);
      add({a, c, d}, drawn);
    } else {
      add({a, b, d}, drawn);
      add({b, c, d}, drawn);
    }
  }
  void add_flat_top(std::vector<BuildingBody::Triangle>& drawn) {
    for (uint32_t i = 2; i < count_; ++i) add({top(0), top(i), top(i - 1)}, drawn);
  }

  mesh::Polyhedron finish() { return std::move(body_); }

 private:
  uint32_t count_;
  mesh::Polyhedron body_;
};

Vector2d centroid(const PlanRing& ring) {
  Vector2d sum = Vector2d::Zero();
  double weight = 0.0;
  for (size_t i = 1; i + 1 < ring.size(); ++i) {
    const Vector2d a = ring[i] - ring[0], b = ring[i + 1] - ring[0];
    const double twice_m2 = a.x() * b.y() - a.y() * b.x();
    sum += twice_m2 * (a + b) / 3.0;
    weight += twice_m2;
  }
  return ring[0] + sum / weight;
}

std::vector<double> tops_of_skillion(const PlanRing& ring, const MapBuilding& building) {
  size_t longest = 0;
  const auto side = [&](size_t i) -> Vector2d { return ring[(i + 1) % ring.size()] - ring[i]; };
  for (size_t i = 1; i < ring.size(); ++i) {
    if (side(i).norm() > side(longest).norm()) longest = i;
  }
  Vector2d up(side(longest).y(), -side(longest).x());
  if (building.slope_to_rad) up = -Vector2d(std::cos(*building.slope_to_rad), std::sin(*building.slope_to_rad));
  double low = kInfinity, high = -kInfinity;
  for (const Vector2d& p : ring) {
    low = std::min(low, up.dot(p));
    high = std::max(high, up.dot(p));
  }
  std::vector<double> tops_m;
  for (const Vector2d& p : ring)
    tops_m.push_back(building.eaves_m() + building.roof_height_m * (up.dot(p) - low) / (high - low));
  return tops_m;
}

void add_skillion(const PlanRing& ring, const MapBuilding& building, BuildingBody& body) {
  const std::vector<double> tops_m = tops_of_skillion(ring, building);
  ConvexBuilder builder(ring, building.min_height_m, tops_m);
  builder.add_flat_top(body.roof);
  body.hulls.push_back(builder.finish());
  for (size_t i = 0; i < ring.size(); ++i) {
    const size_t next = (i + 1) % ring.size();
    const Vector3d left = raised(ring[next], tops_m[next]), right = raised(ring[i], tops_m[i]),
                   low_left = raised(ring[next], building.eaves_m()), low_right = raised(ring[i], building.eaves_m());
    if (left != low_left) body.gables.push_back({left, low_left, low_right});
    if (right != low_right) body.gables.push_back({left, low_right, right});
  }
}

void add_pyramid(const PlanRing& ring, const MapBuilding& building, BuildingBody& body) {
  ConvexBuilder builder(ring, building.min_height_m, std::vector<double>(ring.size(), building.eaves_m()));
  const uint32_t apex = builder.add_corner(raised(centroid(ring), building.height_m));
  for (uint32_t i = 0; i < ring.size(); ++i) builder.add({builder.top(i + 1), builder.top(i), apex}, body.roof);
  body.hulls.push_back(builder.finish());
}

/// Adds a roof with a ridge, over four corners.
void add_ridge(const PlanRing& ring, const MapBuilding& building, BuildingBody& body) {
  const auto side_m = [&](size_t i) { return (ring[(i + 1) % 4] - ring[i]).norm(); };
  // Sides `end` and end + 2 are those that the ridge runs to.
  const bool first_is_shorter = side_m(0) + side_m(2) < side_m(1) + side_m(3);
  const uint32_t end = first_is_shorter != building.ridge_across ? 0 : 1;
  const auto middle = [&](uint32_t i) -> Vector2d { return 0.5 * (ring[i % 4] + ring[(i + 1) % 4]); };
  Vector2d from = middle(end), to = middle(end + 2);
  const bool hipped = building.roof == RoofShape::hipped;
  if (hipped) {
    constexpr double kMaxInset = 0.45;  // of the ridge, at each end
    const Vector2d along = to - from;
    const double half_width_m = 0.25 * (side_m(end) + side_m(end + 2));
    const double inset = std::min(half_width_m / along.norm(), kMaxInset);
    from += inset * along;
    to -= inset * along;
  }
  ConvexBuilder builder(ring, building.min_height_m, std::vector<double>(4, building.eaves_m()));
  const uint32_t first = builder.add_corner(raised(from, building.height_m)),
                 last = builder.add_corner(raised(to, building.height_m));
  const auto top = [&](uint32_t i) { return builder.top(end + i); };
  builder.add({top(1), top(0), first}, hipped ? body.roof : body.gables);
  builder.add({top(3), top(2), last}, hipped ? body.roof : body.gables);
  builder.add_quad(top(2), top(1), first, last, body.roof);
  builder.add_quad(top(0), top(3), last, first, body.roof);
  body.hulls.push_back(builder.finish());
}

/// Returns whether the roof covers the footprint.
bool add_flat(const Footprint& footprint, bool convex, double bottom_m, double top_m, BuildingBody& body) {
  if (convex) {
    ConvexBuilder builder(footprint.outer, bottom_m, std::vector<double>(footprint.outer.size(), top_m));
    builder.add_flat_top(body.roof);
    body.hulls.push_back(builder.finish());
    return true;
  }
  double covered_m2 = 0.0;
  const FootprintTriangles parts = triangles_of(footprint);
  for (const auto& [a, b, c] : parts.triangles) {
    const PlanRing triangle{parts.corners[a], parts.corners[b], parts.corners[c]};
    const double own_m2 = area_m2({triangle, {}});
    covered_m2 += std::abs(own_m2);
    if (own_m2 < kMinTriangleM2 || !is_convex(triangle)) continue;
    ConvexBuilder builder(triangle, bottom_m, {top_m, top_m, top_m});
    builder.add_flat_top(body.roof);
    body.hulls.push_back(builder.finish());
  }
  constexpr double kMaxErrorShare = 1e-3;
  const double whole_m2 = area_m2(footprint);
  return std::abs(covered_m2 - whole_m2) <= kMaxErrorShare * whole_m2;
}

size_t corner_count(const Footprint& footprint) {
  size_t count = footprint.outer.size();
  for (const PlanRing& hole : footprint.holes) count += hole.size();
  return count;
}

/// Returns whether the outline permits the building's roof.
bool fits(RoofShape roof, const PlanRing& outline, bool convex) {
  if (roof == RoofShape::gabled || roof == RoofShape::hipped) return convex && outline.size() == 4;
  return convex;
}

}  // namespace

BuildingBody body_of(const Footprint& footprint, const MapBuilding& building, std::vector<std::string>& faults) {
  BuildingBody body;
  constexpr size_t kMaxCorners = 5000, kMaxHoles = 100;  // the cost of triangles is quadratic
  if (corner_count(footprint) > kMaxCorners || footprint.holes.size() > kMaxHoles) {
    faults.push_back(building.name + ": left out, since its outline has more than " + std::to_string(kMaxCorners) +
                     " corners or " + std::to_string(kMaxHoles) + " courtyards");
    return body;
  }
  body.middle_NE = footprint.outer.empty() ? Vector2d::Zero() : footprint.outer.front();
  const auto relative = [&](PlanRing ring) {
    for (Vector2d& p : ring) p -= body.middle_NE;
    return simplified(ring);
  };
  Footprint own{relative(footprint.outer), {}};
  if (own.outer.empty()) {
    faults.push_back(building.name + ": left out, since its outline has no area");
    return body;
  }
  for (const PlanRing& hole : footprint.holes) {
    if (PlanRing ring = relative(hole); !ring.empty()) own.holes.push_back(std::move(ring));
  }
  body.walls = own.holes;
  body.walls.insert(body.walls.begin(), own.outer);

  const bool convex = own.holes.empty() && is_convex(own.outer);
  const bool is_flat = building.roof == RoofShape::flat || building.roof_height_m <= 0.0;
  const bool drawn_flat = is_flat || !fits(building.roof, own.outer, convex);
  if (drawn_flat && !is_flat) faults.push_back(building.name + ": its outline does not fit its roof:shape; drawn flat");
  body.eaves_m = drawn_flat ? building.height_m : building.eaves_m();
  if (drawn_flat) {
    if (!add_flat(own, convex, building.min_height_m, building.height_m, body))
      faults.push_back(building.name + ": its outline touches itself, so its roof is not complete");
  } else if (building.roof == RoofShape::skillion) {
    add_skillion(own.outer, building, body);
  } else if (building.roof == RoofShape::pyramidal) {
    add_pyramid(own.outer, building, body);
  } else {
    add_ridge(own.outer, building, body);
  }
  if (building.min_height_m > 0.0) {
    const FootprintTriangles parts = triangles_of(own);
    for (const auto& face : parts.triangles) {
      BuildingBody::Triangle& drawn = body.bottom.emplace_back();
      for (size_t k = 0; k < 3; ++k) drawn[k] = raised(parts.corners[face[k]], building.min_height_m);
    }
  }
  return body;
}

}  // namespace hedgehop::scenes::map
