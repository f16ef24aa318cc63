#include "vision/stereo/flight_corridor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {

namespace {

void halve(const cv::Mat& fine, cv::Mat& coarse) {
  coarse.create(fine.rows / 2, fine.cols / 2, CV_16SC1);
  for (int v = 0; v < coarse.rows; ++v) {
    const auto* const upper = fine.ptr<int16_t>(2 * v);
    const auto* const lower = fine.ptr<int16_t>(2 * v + 1);
    auto* const out = coarse.ptr<int16_t>(v);
    for (int u = 0; u < coarse.cols; ++u) {
      out[u] = std::max(std::max(upper[2 * u], upper[2 * u + 1]), std::max(lower[2 * u], lower[2 * u + 1]));
    }
  }
}

}  // namespace

void DepthPyramid::build(const cv::Mat& disparity16, int top) {
  if (disparity16.type() != CV_16SC1) throw std::invalid_argument("a disparity image must be CV_16SC1");
  if (top < 0 || top > 15) throw std::invalid_argument("a pyramid's coarsest level lies in [0, 15]");
  image_ = disparity16.size();
  levels_.resize(static_cast<size_t>(top) + 1);
  const int block = 1 << top;
  const auto whole_blocks = [&](int pixels) { return (pixels + block - 1) / block * block; };
  levels_[0].create(whole_blocks(image_.height), whole_blocks(image_.width), CV_16SC1);
  levels_[0].setTo(kNoDisparity);
  disparity16.copyTo(levels_[0](cv::Rect({}, image_)));
  for (size_t n = 1; n < levels_.size(); ++n) halve(levels_[n - 1], levels_[n]);
}

namespace {

/// With z = 16 b f / d, [Andert2007] eq. (9) to (11) become
///   dx^2 / (f^2 + (x_path - x_0)^2) + dy^2 / (f^2 + (y_path - y_0)^2)  <=  (r d / (16 b f))^2 ,
/// so the offset from the path on the left determines the disparities d of points inside the corridor.
class CorridorDescent {
 public:
  CorridorDescent(const DepthPyramid& pyramid, const StereoGeometry& geometry, const cv::Point& path, double radius_m,
                  double target_m)
      : pyramid_(pyramid), path_(path) {
    const double f2 = geometry.focal_px * geometry.focal_px;
    const double x = path.x - geometry.center_u_px, y = path.y - geometry.center_v_px;
    weight_x_ = 1.0 / (f2 + x * x);
    weight_y_ = 1.0 / (f2 + y * y);
    reach_ = radius_m / (kDisparityUnits * geometry.baseline_m * geometry.focal_px);
    blocking_ = target_m > 0.0 ? geometry.disparity16(target_m) : std::numeric_limits<double>::infinity();
  }

  Corridor run(const StereoGeometry& geometry) {
    const int top = pyramid_.top();
    for (int row = 0; row < pyramid_.level(top).rows; ++row) {
      for (int col = 0; col < pyramid_.level(top).cols; ++col) descend(top, row, col);
    }
    Corridor found;
    found.tests = tests_;
    if (nearest_ < 0) return found;
    found.z_m = geometry.z_m(nearest_);
    found.state = blocked() ? Corridor::State::blocked : Corridor::State::free;
    return found;
  }

 private:
  bool blocked() const { return nearest_ >= blocking_; }
  bool inside(double dx, double dy, int disparity16) const {
    const double reach = reach_ * disparity16;
    return weight_x_ * dx * dx + weight_y_ * dy * dy <= reach * reach;
  }

  void descend(int level, int row, int col) {
    if (blocked()) return;
    const int d = pyramid_.disparity16(level, row, col);
    if (d <= nearest_) return;  // no closer point here; unknown is below all disparities
    ++tests_;
    const int size = 1 << level;
    const int first_x = col * size - path_.x, last_x = first_x + size - 1;
    const int first_y = row * size - path_.y, last_y = first_y + size - 1;
    const double near_x = std::max({0, first_x, -last_x}), near_y = std::max({0, first_y, -last_y});
    if (!inside(near_x, near_y, d)) return;
    const double far_x = std::max(std::abs(first_x), std::abs(last_x));
    const double far_y = std::max(std::abs(first_y), std::abs(last_y));
    if (inside(far_x, far_y, d)) {
      nearest_ = d;
      return;
    }
    for (int child = 0; child < 4; ++child) descend(level - 1, 2 * row + child / 2, 2 * col + child % 2);
  }

  const DepthPyramid& pyramid_;
  cv::Point path_;
  double weight_x_, weight_y_;
  double reach_;     ///< r / (16 b f)
  double blocking_;  ///< minimum disparity x 16 that blocks the corridor
  int nearest_ = kNoDisparity;
  int tests_ = 0;
};

}  // namespace

Corridor examine_corridor(const DepthPyramid& pyramid, const StereoGeometry& geometry, const cv::Point& path,
                          double radius_m, double target_m) {
  return CorridorDescent(pyramid, geometry, path, radius_m, target_m).run(geometry);
}

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

/// Returns the points of a square lattice around `center` with inner^2 < distance^2 <= outer^2.
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
