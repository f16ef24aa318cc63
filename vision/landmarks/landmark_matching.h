#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "vision/landmarks/landmark.h"

namespace hedgehop::vision::landmarks {

/// Error of a camera pose: translation, m, and small rotation, rad, both along the axes of C.
using CameraError = Eigen::Matrix<double, 6, 1>;

/// Returns the error of the camera's estimated pose that brings the maximum number of landmarks close to a measured
/// bearing; zero without landmarks or bearings. All landmarks of an image share this error, so matching must not
/// attribute it to the landmarks: at 60 m, 0.5 m shifts an image of 30 degrees by many pixels. Each close pair of a
/// well-known landmark and a bearing is a hypothesis; the one with maximum support is refined by least squares.
/// This step is not part of [Shah2009] ch. 4.
/// @param prior  covariance of the error. @param bearing_sigma  of a measured bearing, per axis, > 0.
CameraError common_error(std::span<const std::optional<PredictedBearing>> predicted,
                         std::span<const Eigen::Vector2d> bearings_meas, const Eigen::Matrix<double, 6, 6>& prior,
                         double bearing_sigma);

/// Returns a pose corrected by an error; its 1-sigma uncertainty is unchanged.
CameraPose corrected(const CameraPose& pose, const CameraError& error);

/// Returns a prediction for a camera of known pose. The residual's covariance is that of the landmark plus that of a
/// measurement.
PredictedBearing with_known_pose(const PredictedBearing& seen, double bearing_sigma);

/// Returns the one-to-one matches of measured bearings to landmarks: the pairs with Z values below the gate, in
/// increasing order of their Z value.
/// @param predicted  std::nullopt for landmarks that are not visible. @param bearings_meas  at focal length 1.
/// @param gate  > 0; residuals of n standard deviations have the Z value n^2 / 4.
/// @return for each bearing an index into `predicted`, or std::nullopt.
/// Source: [Shah2009] sec. "Z-test for Correspondence". Differs: the gate, which the thesis does not give; pairs that
/// are too far apart for the gate are skipped.
std::vector<std::optional<size_t>> match_landmarks(std::span<const std::optional<PredictedBearing>> predicted,
                                                   std::span<const Eigen::Vector2d> bearings_meas, double gate);

}  // namespace hedgehop::vision::landmarks
