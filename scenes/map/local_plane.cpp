#include "scenes/map/local_plane.h"

#include <cmath>

#include "sim/fields/quantities.h"

namespace hedgehop::scenes::map {
namespace {

constexpr double kEquatorRadiusM = 6378137.0, kFlattening = 1.0 / 298.257223563;  // [WGS84] table 3.1

Eigen::Vector3d geocentric_m(const GeoPoint& place) {
  const double latitude = place.latitude_deg * kRadPerDeg, longitude = place.longitude_deg * kRadPerDeg;
  const double square_eccentricity = kFlattening * (2.0 - kFlattening), s = std::sin(latitude);
  const double normal_m = kEquatorRadiusM / std::sqrt(1.0 - square_eccentricity * s * s);
  return {normal_m * std::cos(latitude) * std::cos(longitude), normal_m * std::cos(latitude) * std::sin(longitude),
          normal_m * (1.0 - square_eccentricity) * s};
}

}  // namespace

LocalPlane::LocalPlane(const GeoPoint& origin) : origin_(origin), center_m_(geocentric_m(origin)) {
  const double latitude = origin.latitude_deg * kRadPerDeg, longitude = origin.longitude_deg * kRadPerDeg;
  axes_ << -std::sin(latitude) * std::cos(longitude), -std::sin(latitude) * std::sin(longitude), std::cos(latitude),
      -std::sin(longitude), std::cos(longitude), 0.0;
}

Eigen::Vector2d LocalPlane::p_NE(const GeoPoint& place) const {
  constexpr double kMaxDistanceM = 1e6;
  const Eigen::Vector3d from_origin_m = geocentric_m(place) - center_m_;
  if (from_origin_m.norm() > kMaxDistanceM) return {kMaxDistanceM, kMaxDistanceM};
  return axes_ * from_origin_m;
}

GeoBounds LocalPlane::bounds(double radius_m) const {
  constexpr double kMarginShare = 1.02;  // a degree is up to 1 % shorter than at the equator
  const double north_deg = kMarginShare * radius_m / kEquatorRadiusM / kRadPerDeg;
  const double cosine = std::cos((std::abs(origin_.latitude_deg) + north_deg) * kRadPerDeg);
  const double east_deg = north_deg / cosine;
  return {{origin_.latitude_deg - north_deg, origin_.longitude_deg - east_deg},
          {origin_.latitude_deg + north_deg, origin_.longitude_deg + east_deg}};
}

}  // namespace hedgehop::scenes::map
