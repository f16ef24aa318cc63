#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "vision/landmarks/landmark.h"

namespace hedgehop::vision::landmarks {

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
