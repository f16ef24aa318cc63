#include "sim/collision/placed_hull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "sim/collision/solid_bodies.h"
#include "sim/fields/quantities.h"

namespace hedgehop::sim {

PlacedHull::PlacedHull(const std::vector<dynamics::HullPart>& hull) {
  if (hull.empty()) throw std::invalid_argument("the hull has no parts");
  for (const dynamics::HullPart& part : hull) {
    parts_.push_back({make_body(part, "hull part " + std::to_string(parts_.size())), part.center_B_m});
  }
}

void PlacedHull::place(const Eigen::Isometry3d& X_WB) {
  placed_.clear();
  box_W_.setEmpty();
  Eigen::Isometry3d X_WS = X_WB;
  for (const Part& part : parts_) {
    X_WS.translation() = X_WB * part.center_B_m;
    placed_.emplace_back(part.body, X_WS);
    const Eigen::Vector3d half_m = placed_.back().half_size_W();
    box_W_.extend(Eigen::AlignedBox3d(X_WS.translation() - half_m, X_WS.translation() + half_m));
  }
}

double PlacedHull::ground_clearance_m() const {
  double lowest_z = -kInfinity;
  for (const PlacedBody& part : placed_) lowest_z = std::max(lowest_z, part.extent(Eigen::Vector3d::UnitZ()));
  return -lowest_z;
}

double PlacedHull::min_distance_m(const Eigen::AlignedBox3d& box_W, double reach_m) const {
  const double boxes_m = box_W_.exteriorDistance(box_W);
  if (boxes_m > reach_m) return boxes_m;
  // A plane between the hull's center and the nearest point of the box separates the box from the hull.
  const Eigen::Vector3d center_W = box_W_.center();
  const Eigen::Vector3d nearest_W = center_W.cwiseMax(box_W.min()).cwiseMin(box_W.max());
  const Eigen::Vector3d out = (nearest_W - center_W).normalized();
  if (out.isZero(0.0)) return boxes_m;
  double extent_m = -std::numeric_limits<double>::infinity();
  for (const PlacedBody& part : placed_) {
    const Eigen::Vector3d out_S = part.X_SW.linear() * out, half_m = part.body->half_extents_m;
    const double around_m = part.body->shape == ConvexBody::Shape::cylinder
                                ? out_S.head<2>().norm() * half_m.x() + std::abs(out_S.z()) * half_m.z()
                                : out_S.cwiseAbs().dot(half_m);
    extent_m = std::max(extent_m, out.dot(part.X_WS.translation()) + around_m);
  }
  return std::max(boxes_m, out.dot(nearest_W) - extent_m);
}

}  // namespace hedgehop::sim
