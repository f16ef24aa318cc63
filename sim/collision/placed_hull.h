#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "dynamics/hull.h"
#include "sim/collision/convex_body.h"

namespace hedgehop::sim {

/// The hull of a vehicle as convex bodies, at one pose at a time.
class PlacedHull {
 public:
  /// Throws std::invalid_argument if the hull is empty, or as make_body().
  explicit PlacedHull(const std::vector<dynamics::HullPart>& hull);
  PlacedHull(const PlacedHull&) = delete;  // the placed bodies refer to the parts
  PlacedHull& operator=(const PlacedHull&) = delete;

  /// Moves the hull. @param X_WB  pose of the vehicle, finite.
  void place(const Eigen::Isometry3d& X_WB);

  /// The parts at the last pose; none before place().
  const std::vector<PlacedBody>& parts() const { return placed_; }
  /// Returns the box along W's axes around all parts, m; empty before place().
  const Eigen::AlignedBox3d& box_W() const { return box_W_; }
  /// Returns a lower bound of the distance of all parts from a box, m; <= 0 if they may overlap.
  /// @param reach_m  a larger bound need not be tight.
  double min_distance_m(const Eigen::AlignedBox3d& box_W, double reach_m) const;
  /// Returns the height of the lowest point above the plane z = 0 of W, m; < 0 below it.
  double ground_clearance_m() const;

 private:
  struct Part {
    ConvexBody body;
    Eigen::Vector3d center_B_m;
  };
  std::vector<Part> parts_;
  std::vector<PlacedBody> placed_;
  Eigen::AlignedBox3d box_W_;
};

}  // namespace hedgehop::sim
