#include "vision/stereo/flight_corridor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hedgehop::vision::stereo {
namespace {

/// With z = 16 b f / d, [Andert2007] eq. (9) to (11) come to
///   dx^2 / (f^2 + (x_path - x_0)^2) + dy^2 / (f^2 + (y_path - y_0)^2)  <=  (r d / (16 b f))^2 ,
/// so the offset from the path on the left determines which disparities d put a point inside the corridor.
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
    if (d <= nearest_) return;  // nothing nearer here than what is known; unknown is below all
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
  double blocking_;  ///< disparity x 16 from which on the corridor is blocked
  int nearest_ = kNoDisparity;
  int tests_ = 0;
};

}  // namespace

Corridor examine_corridor(const DepthPyramid& pyramid, const StereoGeometry& geometry, const cv::Point& path,
                          double radius_m, double target_m) {
  return CorridorDescent(pyramid, geometry, path, radius_m, target_m).run(geometry);
}

}  // namespace hedgehop::vision::stereo
