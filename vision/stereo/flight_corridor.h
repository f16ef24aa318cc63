#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {

/// A pyramid of disparity images (vision/stereo/disparity.h). Each pixel of level n + 1 holds the maximum disparity,
/// that of the nearest point, of a 2 x 2 block of level n. Level 0 is the image, padded with unknown pixels to
/// multiples of 2^top. Reuses its memory. Source: [Andert2007] sec. 4.2.
class DepthPyramid {
 public:
  /// Builds the levels. @param disparity16  CV_16SC1. @param top  the coarsest level, in [0, 15]. Throws
  /// std::invalid_argument otherwise.
  void build(const cv::Mat& disparity16, int top);

  int top() const { return static_cast<int>(levels_.size()) - 1; }
  const cv::Mat& level(int n) const { return levels_[static_cast<size_t>(n)]; }
  int disparity16(int n, int row, int col) const { return level(n).at<int16_t>(row, col); }
  /// Returns the size of the original image.
  cv::Size image() const { return image_; }

 private:
  cv::Size image_;
  std::vector<cv::Mat> levels_;
};

/// The free length of a cylinder around a pixel's ray.
struct Corridor {
  enum class State { free, blocked, unknown };
  State state = State::unknown;  ///< unknown: no depth inside the cylinder
  double z_m = 0.0;              ///< minimum depth inside, z in C, +infinity for sky; if blocked, any blocking depth
  int tests = 0;                 ///< number of pixels and blocks examined
};

/// Returns the state of the flight corridor of radius `radius_m` (> 0) around the ray of pixel `path`. It is blocked if
/// a point inside is at most `target_m` away (z in C, >= 0; 0: find the minimum depth). The search descends from the
/// top of the pyramid. Blocks completely outside the corridor at their minimum depth are skipped, and blocks completely
/// inside need no division. The result equals that of testing every pixel. Source: [Andert2007] sec. 4.2, eq. (9) to
/// (11).
Corridor examine_corridor(const DepthPyramid& pyramid, const StereoGeometry& geometry, const cv::Point& path,
                          double radius_m, double target_m);

/// Returns the centers of the pyramid's blocks whose nearest point is beyond `far_disparity16`. A nearer block is
/// divided, down to level `finest`. Blocks without depth are ignored.
/// @param coarsest  initial level, in [finest, top]. @param finest  >= 0.
/// Source: [Andert2007] sec. 4.3.1.
std::vector<cv::Point> quadtree_targets(const DepthPyramid& pyramid, double far_disparity16, int coarsest, int finest);

/// Candidates near the last target: a fine square lattice within a circle, a coarse one in the ring around it.
struct NearbyLattice {
  int fine_step_px = 2, coarse_step_px = 4;       ///< d_1, d_2, at least 1
  int fine_radius_px = 5, coarse_radius_px = 19;  ///< r_1 <= r_2
};
/// Returns the candidates in the circle, [Andert2007] eq. (16), possibly outside the image. Differs: the printed
/// equation has steps d_1 and d_2; ours has d_1 in both directions, as in fig. 11.
std::vector<cv::Point> fine_targets(const cv::Point& last, const NearbyLattice& lattice);
/// Returns the candidates in the ring, [Andert2007] eq. (17).
std::vector<cv::Point> coarse_targets(const cv::Point& last, const NearbyLattice& lattice);

/// Weights for a change of direction. [Andert2007] eq. (12).
struct TargetCost {
  double depth_per_m = 0.0;        ///< c_z; <= 0 prefers distant targets
  double azimuth_per_rad = 1.0;    ///< c_x
  double elevation_per_rad = 1.0;  ///< c_y
};
/// Returns the cost of a target relative to a reference direction. @param p_C, reference_C  in C, m, with x and z not
/// both zero; only the direction of the reference matters. [Andert2007] eq. (12) to (14).
double target_cost(const TargetCost& cost, const Eigen::Vector3d& p_C, const Eigen::Vector3d& reference_C);

}  // namespace hedgehop::vision::stereo
