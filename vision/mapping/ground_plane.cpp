#include "vision/mapping/ground_plane.h"

#include <Eigen/LU>
#include <vector>

#include "sim/fields/order_statistics.h"

namespace hedgehop::vision::mapping {
namespace {

struct GroundPoint {
  Eigen::Vector3d ray_C;
  double disparity16;
};

}  // namespace

Eigen::Vector3d lower_border_ray(const stereo::StereoGeometry& geometry, int row, int col) {
  return geometry.ray_at_unit_depth({col * DepthBlocks::kBlockPx + DepthBlocks::kBlockPx / 2,
                                     row * DepthBlocks::kBlockPx + DepthBlocks::kBlockPx - 1});
}

std::optional<GroundPlane> fit_ground(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C,
                                      const UprightColumns& columns) {
  constexpr double kBelow = -0.05;                         // sine of the elevation of points used
  constexpr double kTiltSigma = 0.02;                      // of the normal from the attitude, rad
  constexpr double kMatchSigma16 = 8.0;                    // of a disparity
  constexpr double kFirst16 = 2 * GroundPlane::kWithin16;  // before the normal is corrected
  constexpr size_t kMinPoints = 20;
  std::vector<GroundPoint> points;
  std::vector<double> lowest;
  for (const UprightColumn& column : columns.all()) {
    const int bottom = column.lowest();
    bool first = true;
    for (int row = bottom, seen = bottom + 1; row >= 0 && column.in_image(row) && column.elevation(row) < kBelow;
         --row) {
      const DepthBlock& block = column.at(row);
      if (seen - row > GroundPlane::kMaxGap + 1) break;
      if (block.kind == DepthBlock::Kind::unknown || block.near16 <= 0) continue;
      points.push_back({lower_border_ray(geometry, row, column.col(row)), static_cast<double>(block.near16)});
      if (first) lowest.push_back(points.back().disparity16 / down_C.dot(points.back().ray_C));
      first = false;
      seen = row;
    }
  }
  if (points.size() < kMinPoints || lowest.empty()) return std::nullopt;
  const double level = upper_median(lowest);
  if (level <= 0.0) return std::nullopt;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - down_C * down_C.transpose();
  const Eigen::Matrix3d prior = across / std::pow(level * kTiltSigma, 2);
  GroundPlane plane{level * down_C};
  for (const double within16 : {kFirst16, GroundPlane::kWithin16, GroundPlane::kWithin16}) {
    Eigen::Matrix3d information = prior;
    Eigen::Vector3d weighted = Eigen::Vector3d::Zero();  // `prior` times level * down_C is zero
    size_t count = 0;
    for (const GroundPoint& point : points) {
      if (std::abs(point.disparity16 - plane.disparity16(point.ray_C)) > within16) continue;
      information += point.ray_C * point.ray_C.transpose() / (kMatchSigma16 * kMatchSigma16);
      weighted += point.ray_C * point.disparity16 / (kMatchSigma16 * kMatchSigma16);
      ++count;
    }
    if (count < kMinPoints) return std::nullopt;
    plane.slope_C = information.inverse() * weighted;
  }
  return plane;
}

}  // namespace hedgehop::vision::mapping
