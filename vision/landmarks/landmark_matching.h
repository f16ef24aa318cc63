#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "vision/landmarks/landmark.h"

namespace hedgehop::vision::landmarks {

/// A camera's error: shift of its position, m, and small rotation, rad, both along the axes of C.
using CameraError = Eigen::Matrix<double, 6, 1>;

/// Returns the error of the camera's estimated pose that brings most landmarks close to a measured bearing each; zero
/// without landmarks or bearings. All landmarks of an image share it, so it must not be mistaken for their own errors
/// when they are matched: 0.5 m at 60 m shift an image of 30 degrees by many pixels. Each close pair of a few
/// well-known landmarks is a guess; the guess with most support is refined by least squares.
/// A step that [Shah2009] ch. 4 does not have.
/// @param prior  covariance of the error. @param bearing_sigma  of a measured bearing, per axis, > 0.
CameraError common_error(std::span<const std::optional<PredictedBearing>> predicted,
                         std::span<const Eigen::Vector2d> bearings_meas, const Eigen::Matrix<double, 6, 6>& prior,
                         double bearing_sigma);

/// Returns a pose without an error; its 1-sigma uncertainty stays.
CameraPose corrected(const CameraPose& pose, const CameraError& error);

/// Returns a prediction for a camera of known pose: the residual's covariance is the landmark's own and a
/// measurement's.
PredictedBearing with_known_pose(const PredictedBearing& seen, double bearing_sigma);

/// Returns for each measured bearing the landmark it belongs to, one to one: of all pairs whose Z value lies below the
/// gate the one with the least is matched first, then the least of those that are left.
/// @param predicted  none for landmarks that cannot be seen. @param bearings_meas  at focal length 1.
/// @param gate  > 0; residuals of n standard deviations have the Z value n^2 / 4.
/// @return as many as bearings: an index into `predicted`, or none.
/// Source: [Shah2009] sec. "Z-test for Correspondence". Differs: the gate, which the thesis does not print; and pairs
/// too far apart to pass it are not tried.
std::vector<std::optional<size_t>> match_landmarks(std::span<const std::optional<PredictedBearing>> predicted,
                                                   std::span<const Eigen::Vector2d> bearings_meas, double gate);

}  // namespace hedgehop::vision::landmarks
