#pragma once

#include <Eigen/Core>

#include "scenes/map/elevation.h"

namespace hedgehop::scenes::map {

/// The plane that touches the WGS 84 ellipsoid at W's origin: the north and east axes of W. Heights are independent of
/// it, so W's altitudes are heights above the origin's, without the drop of the Earth's surface below the plane.
class LocalPlane {
 public:
  /// @param origin  latitude within +-85 degrees.
  explicit LocalPlane(const GeoPoint& origin);

  /// Returns the place of a point of the ellipsoid in the plane: north and east, m. Lengths of 5 km from the origin
  /// shrink by 3e-7 of their size. Places beyond the horizon of 1000 km are returned as one point far away, since the
  /// plane would show them in front of it.
  /// Source: [WGS84] sec. 4.2, geocentric coordinates. Differs: rotated into the north and east of the origin.
  Eigen::Vector2d p_NE(const GeoPoint& place) const;

  /// Returns a rectangle of the ellipsoid that contains all points within `radius_m` north, south, east and west.
  GeoBounds bounds(double radius_m) const;

 private:
  GeoPoint origin_;
  Eigen::Vector3d center_m_;          ///< geocentric
  Eigen::Matrix<double, 2, 3> axes_;  ///< rows: north and east, geocentric
};

}  // namespace hedgehop::scenes::map
