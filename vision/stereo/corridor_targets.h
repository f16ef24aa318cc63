#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/depth_pyramid.h"

namespace hedgehop::vision::stereo {

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
