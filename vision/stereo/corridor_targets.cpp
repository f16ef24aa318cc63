#include "vision/stereo/corridor_targets.h"

#include <cmath>

namespace hedgehop::vision::stereo {
namespace {

void divide(const DepthPyramid& pyramid, double far_disparity16, int level, int row, int col, int finest,
            std::vector<cv::Point>& targets) {
  const int d = pyramid.disparity16(level, row, col);
  if (d < 0) return;
  if (d < far_disparity16) {
    const int size = 1 << level;
    const cv::Point center(col * size + size / 2, row * size + size / 2);
    if (cv::Rect({}, pyramid.image()).contains(center)) targets.push_back(center);
    return;
  }
  if (level == finest) return;
  for (int child = 0; child < 4; ++child) {
    divide(pyramid, far_disparity16, level - 1, 2 * row + child / 2, 2 * col + child % 2, finest, targets);
  }
}

/// Points of a square lattice round `center` with inner^2 < distance^2 <= outer^2.
std::vector<cv::Point> ring(const cv::Point& center, int step, int inner2, int outer) {
  std::vector<cv::Point> points;
  const int steps = outer / step;
  for (int j = -steps; j <= steps; ++j) {
    for (int i = -steps; i <= steps; ++i) {
      const int distance2 = step * step * (i * i + j * j);
      if (distance2 > inner2 && distance2 <= outer * outer)
        points.emplace_back(center.x + step * i, center.y + step * j);
    }
  }
  return points;
}

double azimuth_rad(const Eigen::Vector3d& p_C) { return std::atan2(p_C.x(), p_C.z()); }
double elevation_rad(const Eigen::Vector3d& p_C) { return std::atan2(p_C.y(), std::hypot(p_C.x(), p_C.z())); }

}  // namespace

std::vector<cv::Point> quadtree_targets(const DepthPyramid& pyramid, double far_disparity16, int coarsest, int finest) {
  std::vector<cv::Point> targets;
  const cv::Mat& start = pyramid.level(coarsest);
  for (int row = 0; row < start.rows; ++row) {
    for (int col = 0; col < start.cols; ++col) {
      divide(pyramid, far_disparity16, coarsest, row, col, finest, targets);
    }
  }
  return targets;
}

std::vector<cv::Point> fine_targets(const cv::Point& last, const NearbyLattice& lattice) {
  constexpr int kCenterToo = -1;
  return ring(last, lattice.fine_step_px, kCenterToo, lattice.fine_radius_px);
}

std::vector<cv::Point> coarse_targets(const cv::Point& last, const NearbyLattice& lattice) {
  return ring(last, lattice.coarse_step_px, lattice.fine_radius_px * lattice.fine_radius_px, lattice.coarse_radius_px);
}

double target_cost(const TargetCost& cost, const Eigen::Vector3d& p_C, const Eigen::Vector3d& reference_C) {
  const double depth = cost.depth_per_m != 0.0 ? cost.depth_per_m * p_C.z() : 0.0;  // z may be infinite
  return depth + cost.azimuth_per_rad * std::abs(azimuth_rad(p_C) - azimuth_rad(reference_C)) +
         cost.elevation_per_rad * std::abs(elevation_rad(p_C) - elevation_rad(reference_C));
}

}  // namespace hedgehop::vision::stereo
