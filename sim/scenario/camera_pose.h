#pragma once

#include <Eigen/Geometry>
#include <string_view>
#include <vector>

#include "sim/scenario/rig.h"

/// The keys of a camera that state its pose: a matrix, or a position with angles or a quaternion.
namespace hedgehop::sim {

/// Returns the pose of a 4 x 4 matrix, row by row. Throws fields::InvalidField with `key` if it is none.
Eigen::Isometry3d pose_of(const std::vector<double>& numbers, std::string_view key);
/// Returns the 4 x 4 matrix, row by row.
std::vector<double> numbers_of(const Eigen::Isometry3d& X);

/// Returns whether a matrix is set.
bool has_matrix(const CameraConfig& camera);
/// Returns whether position, angles or quaternion are set.
bool has_mounting(const CameraConfig& camera);
/// Clears the matrices except that relative to the previous camera.
void clear_matrices(CameraConfig& camera);

}  // namespace hedgehop::sim
