#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "vision/landmarks/landmark.h"

namespace hedgehop::vision::landmarks {

/// Parameters of the thesis's filter for which the thesis gives no values.
struct PublishedFilter {
  double bearing_sigma = 0.0;  ///< of a measured bearing, per axis, at focal length 1, > 0
  double drift_m_rt_s = 0.0;   ///< process noise Q: growth of a point's standard deviation, m / sqrt(s), >= 0
  double gate = 0.0;           ///< maximum Z value of a match, > 0
  int misses = 0;              ///< N: consecutive images without a match after which a point is deleted, >= 1
};

/// Processes one image by the thesis's modeling algorithm: predicts the database, matches it by the Z-test, corrects
/// matched points, initializes new points on the ground, and deletes points that were missed N times.
/// @param bearings_meas  at focal length 1. @param pose  estimated pose of the camera. @param dt_s  time since the
/// previous image, s, >= 0. @param database  current points in W; updated. @param next_id  id of the next new point;
/// updated.
/// @return for each bearing the id of its point, new or existing.
/// Source: [Shah2009] ch. 4, fig. 4.4, eq. (4.5) to (4.24), equation by equation. Differs: the Jacobian includes the
/// rotation L_bv, which eq. (4.19) and (4.20) omit; the gain has the sign of the projection's Jacobian, because eq.
/// (4.16) with eq. (4.18) would move a point away from its measurement. R, Q, N, the initial covariance and the gate
/// are not given in the thesis; here R combines the noise of a corner and of the pose at the point's distance.
std::vector<int64_t> update_as_published(const PublishedFilter& filter, std::span<const Eigen::Vector2d> bearings_meas,
                                         const CameraPose& pose, double dt_s, std::vector<MappedLandmark>& database,
                                         int64_t& next_id);

}  // namespace hedgehop::vision::landmarks
