#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/disparity.h"

namespace hedgehop::vision::stereo {

/// A disparity image (vision/stereo/disparity.h) and coarser ones above it: each pixel of level n + 1 holds the
/// largest, that is nearest, disparity of a 2 x 2 block of level n; edges are padded with unknown. Level 0 is the image
/// itself, padded to multiples of 2^top. Keeps its memory from image to image. Source: [Andert2007] sec. 4.2.
class DepthPyramid {
 public:
  /// @param disparity16  CV_16SC1. @param top  the coarsest level, in [0, 15]. Throws std::invalid_argument otherwise.
  void build(const cv::Mat& disparity16, int top);

  int top() const { return static_cast<int>(levels_.size()) - 1; }
  const cv::Mat& level(int n) const { return levels_[static_cast<size_t>(n)]; }
  int disparity16(int n, int row, int col) const { return level(n).at<int16_t>(row, col); }
  /// Of the image it was built from.
  cv::Size image() const { return image_; }

 private:
  cv::Size image_;
  std::vector<cv::Mat> levels_;
};

/// How far a cylinder around a pixel's ray is free of observed points.
struct Corridor {
  enum class State { free, blocked, unknown };
  State state = State::unknown;  ///< unknown: no depth inside
  double z_m = 0.0;  ///< nearest depth inside, z in C, +infinity for sky; when blocked, any one inside that blocks
  int tests = 0;     ///< pixels and blocks examined
};

/// Examines the flight corridor of radius `radius_m` (> 0) around the ray of `path`, a pixel of the image: blocked
/// when anything inside lies no farther than `target_m` (z in C, >= 0; 0: returns the nearest depth).
/// Descends the pyramid from its top: a block all outside the corridor at its nearest depth is dropped, one all inside
/// ends there. The answer is that of a test of every pixel.
/// Source: [Andert2007] sec. 4.2, eq. (9) to (11).
Corridor examine_corridor(const DepthPyramid& pyramid, const StereoGeometry& geometry, const cv::Point& path,
                          double radius_m, double target_m);

/// Centers of the pyramid's blocks whose nearest point is farther than `far_disparity16`: a far block is taken as a
/// whole, a near one divided, down to level `finest`; blocks without any depth are left out.
/// @param coarsest  level to begin with, in [finest, top]. @param finest  >= 0.
/// Source: [Andert2007] sec. 4.3.1.
std::vector<cv::Point> quadtree_targets(const DepthPyramid& pyramid, double far_disparity16, int coarsest, int finest);

/// Candidates near the last target: a fine square lattice within a circle, a coarser one in the ring round it.
struct NearbyLattice {
  int fine_step_px = 2, coarse_step_px = 4;       ///< d_1, d_2, at least 1
  int fine_radius_px = 5, coarse_radius_px = 19;  ///< r_1 <= r_2
};
/// Candidates of the circle, [Andert2007] eq. (16). Differs: the print has steps d_1 and d_2; its fig. 11 shows d_1 in
/// both directions. They may lie outside the image.
std::vector<cv::Point> fine_targets(const cv::Point& last, const NearbyLattice& lattice);
/// Candidates of the ring, [Andert2007] eq. (17).
std::vector<cv::Point> coarse_targets(const cv::Point& last, const NearbyLattice& lattice);

/// Weights of a change of direction. [Andert2007] eq. (12).
struct TargetCost {
  double depth_per_m = 0.0;        ///< c_z <= 0 prefers what is far
  double azimuth_per_rad = 1.0;    ///< c_x
  double elevation_per_rad = 1.0;  ///< c_y
};
/// Cost of flying to a point instead of along a reference. @param p_C, reference_C  in C, m, not both coordinates x and
/// z zero; of the reference only the direction counts. [Andert2007] eq. (12) to (14).
double target_cost(const TargetCost& cost, const Eigen::Vector3d& p_C, const Eigen::Vector3d& reference_C);

}  // namespace hedgehop::vision::stereo
