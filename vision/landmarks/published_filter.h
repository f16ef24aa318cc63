#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "vision/landmarks/landmark.h"

namespace hedgehop::vision::landmarks {

/// What the thesis's filter needs and does not print.
struct PublishedFilter {
  double bearing_sigma = 0.0;  ///< of a measured bearing, per axis, at focal length 1, > 0
  double drift_m_rt_s = 0.0;   ///< process noise Q: growth of a point's standard deviation, m / sqrt(s), >= 0
  double gate = 0.0;           ///< largest Z value of a match, > 0
  int misses = 0;              ///< N: a point is deleted after so many consecutive images without it, >= 1
};

/// One image of the thesis's modeling algorithm: predicts the database, matches it by the Z-test, corrects what is
/// matched, begins new points on the ground, and deletes points that were missed N times.
/// @param bearings_meas  at focal length 1. @param pose  of the camera, estimated. @param dt_s  since the last image,
/// s,
/// >= 0. @param database  the points so far, in W; changed. @param next_id  of the next new point; raised.
/// @return for each bearing the id of its point, new or known.
/// Source: [Shah2009] ch. 4, fig. 4.4, eq. (4.5) to (4.24), equation by equation. Differs: the Jacobian carries the
/// rotation L_bv, which eq. (4.19) and (4.20) leave out; the gain's sign is that of the projection's Jacobian, as eq.
/// (4.16) with eq. (4.18) would push a point away from its measurement. R, Q, N, the first covariance and the gate are
/// not printed: R is a corner's noise and the pose's, as seen at the point.
std::vector<int64_t> update_as_published(const PublishedFilter& filter, std::span<const Eigen::Vector2d> bearings_meas,
                                         const CameraPose& pose, double dt_s, std::vector<MappedLandmark>& database,
                                         int64_t& next_id);

}  // namespace hedgehop::vision::landmarks
